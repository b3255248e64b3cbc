// The scene: arms, targets and marks in space, above a floor.

import {dot, distance, frames, origin, plus, polyline, turned} from "./kinematics.js";
import {
  clear,
  colors,
  font,
  hit,
  jointColor,
  polygon,
  prepared,
  shape,
  spot,
  stroke,
  tiled,
  words,
} from "./canvas.js";
import {camera, movedTo} from "./camera.js";

/** @import {PageLink, PageMark, PageScene, PageTarget, Unit, With} from "./page.js" */
/** @import {Box, Context, Pixel, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */

/** @typedef {PageScene & {unit: Unit}} SceneData  a scene, and the unit of the page */
/**
 * The same at the moment of a picture: all that moves has its place.
 * @typedef {Omit<SceneData, "targets" | "marks"> & {
 *   targets: With<PageTarget, "pose">[],
 *   marks: With<PageMark, "at">[],
 * }} Scene
 */
/** @typedef {(g: Context, cam: Camera) => void} Draw */
/**
 * @typedef {object} Shown  an arm as a picture shows it
 * @property {string} name
 * @property {PageLink[]} chain
 * @property {number[]} q  radians and metres
 * @property {(?Point)[]} [trace]  places of the tool, null where they break; `tail`: those behind
 *   it
 * @property {(?Point)[]} [tail]
 * @property {boolean} [faded]  there is no solution here
 * @property {?{place: Point, text: string}} [near]  where the path passes "via"
 * @property {{q: number[], past: boolean}[]} [ghosts]  other postures, faint; broken lines where
 *   `past` a limit
 * @property {boolean} [framed]  show the frame of every link
 * @property {Draw} [under]  draws what else there is, below the arm
 * @property {Draw} [over]  the same above it
 */
/** @typedef {ReturnType<typeof surroundings>} Space  what stands still */
/** @typedef {{g: Context, cam: Camera, scene: Scene, space: Space}} Pen  on what, how seen, what */
/** @typedef {ReturnType<typeof stood>} Stood  an arm in its place, and the pen that draws it */
/** @typedef {[from: Point, to: Point, rod: boolean]} Limb  `rod`: of a prismatic joint */
/** @typedef {{text: string, at: Pixel, color: string, weight?: string}} Label */

/** The axes of a frame; their colours have the same names. */
export const AXES = /** @type {const} */ (["x", "y", "z"]);

/**
 * Draws arms in space.
 *
 * draw(view, arms, clock)   one picture: view [azimuth, elevation], arms Shown[], words for the
 *                           right upper corner.
 *                           Returns whether there was room for one
 * cameras()                 those of the last picture, one for each arm, or one for all where they
 *                           stand together in one: `to` projects a point to CSS pixels
 * hold(on)                  while on, the cameras of the last picture stay: for as long as
 *                           something is dragged
 * height(count, width)      how high a canvas of this width is well filled by so many arms
 *
 * @param {HTMLCanvasElement} canvas
 * @param {SceneData} scene  `targets` and `marks` may be exchanged between two pictures; in each
 *   all have a `pose` or `at`
 */
export function sceneView(canvas, scene) {
  const space = surroundings(scene);
  /** @type {Camera[]} */
  let cameras = [],
    held = false;

  /** @type {(view: number[], arms: Shown[], clock: string) => boolean} */
  function draw(view, arms, clock) {
    const ready = prepared(canvas);
    if (!ready) return false;
    const pictures = scene.bases ? [arms] : arms.map(arm => [arm]);
    const [g, w, h] = ready,
      [columns, rows] = tiled(pictures.length, w),
      cw = w / columns,
      ch = h / rows;
    cameras = pictures.map((shown, i) => {
      /** @type {Box} */
      const cell = [(i % columns) * cw, Math.floor(i / columns) * ch, cw, ch];
      const now = /** @type {Scene} */ (scene);
      const corners = scene.grows ? [...space.corners, ...reached(now, shown[0])] : space.corners;
      const cam = (held && cameras[i]) || camera(view, corners, inside(cell));
      g.save();
      g.beginPath();
      g.rect(...cell);
      g.clip();
      drawSpace({g, cam, scene: now, space}, shown, cell, pictures.length > 1);
      g.restore();
      if (i % columns)
        stroke(
          g,
          [
            [cell[0], cell[1] + 10],
            [cell[0], cell[1] + ch - 10],
          ],
          colors.grid,
          1,
        );
      return cam;
    });
    words(g, clock, w - 10, 18, colors.ink, 13, "right", "600");
    words(
      g,
      `grid ${+(scene.grid / scene.unit.size).toPrecision(6)} ${scene.unit.name}`,
      10,
      h - 8,
      colors.soft,
      12,
    );
    return true;
  }

  /** @type {(count: number, width: number) => number} */
  function height(count, width) {
    const [columns, rows] = tiled(count, width),
      [, , w] = inside([0, 0, width / columns, 1000]);
    const {to} = camera(scene.view, space.corners, [0, 0, w, 1e6]),
      ys = space.corners.map(p => to(p)[1]);
    return rows * (Math.max(...ys) - Math.min(...ys) + 1000 - inside([0, 0, w, 1000])[3]);
  }

  return {
    draw,
    height,
    cameras: () => cameras,
    /** @type {(on: boolean) => void} */
    hold: on => {
      held = on;
    },
  };
}

/**
 * Room at the rims for words: names above, the scale below.
 * @param {Box} cell
 * @returns {Box}
 */
const inside = ([x, y, w, h]) => [x + 20, y + 28, Math.max(1, w - 40), Math.max(1, h - 54)];

/**
 * What stands still: the axes of the grid, a point of the floor, what the camera has to see:
 * everything and its shadow. The rest of the floor may leave the picture.
 * @param {PageScene} scene
 */
function surroundings({flat, floor: [low], seen}) {
  const normal = flat ?? 2,
    [a, b] = [0, 1, 2].filter(i => i !== normal);
  /** @type {(x: number, y: number) => Point} */
  const at = (x, y) => {
    const p = [0, 0, 0];
    p[a] = x;
    p[b] = y;
    p[normal] = flat === null ? low[2] : 0;
    return p;
  };
  const corners = flat === null ? seen.flatMap(p => [p, at(p[0], p[1])]) : seen;
  return {a, b, at, corners, spatial: flat === null};
}

/**
 * What a scene that grows has to hold besides.
 * @param {Scene} scene
 * @param {Shown} arm
 */
function reached(scene, arm) {
  const all = [arm.q, ...(arm.ghosts || []).map(({q}) => q)].flatMap(q => {
    /** @type {number[][]} */
    const joints = [];
    return [...frames(arm.chain, q, joints), ...joints];
  });
  return [
    ...[...all, ...scene.targets.map(target => target.pose)].map(origin),
    ...scene.marks.map(mark => mark.at),
  ].filter(p => p.every(Number.isFinite));
}

/**
 * Arms in one picture and all that is around them.
 * @param {Pen} pen
 * @param {Shown[]} arms
 * @param {Box} cell
 * @param {boolean} named
 */
function drawSpace(pen, arms, [x, y, w, h], named) {
  const {g, cam, scene} = pen,
    {to} = cam,
    [first] = arms,
    all = arms.map((arm, i) => stood(pen, arm, scene.bases?.[i]));
  const sunk = all.filter(one => one.dips);
  drawFloor(pen);
  for (const one of sunk) drawRods(one);
  if (sunk.length) drawFloor(pen, true);
  if (pen.space.spatial) all.forEach(drawShadow);
  drawFaces(pen);
  for (const {at, radius} of scene.marks) if (radius) ball(g, to(at), radius * cam.scale);
  drawRoute(pen);
  [...all].sort((p, q) => p.depth - q.depth).forEach(drawStood);
  const {labels, taken} = drawPlaces(pen, first.near);
  all.forEach(drawFlange);
  place(
    g,
    labels,
    [...all.flatMap(one => one.trace.filter(p => p !== null).map(one.cam.to)), ...taken],
    [x + 4, y + 24, w - 8, h - 46],
  );
  compass(g, cam, [x + w - 34, y + h - 34]);
  if (named) words(g, first.name, x + 10, y + 18, colors.ink, 13, "left", "600");
  if (arms.some(arm => arm.faded))
    words(
      g,
      "no solution here",
      x + w / 2,
      y + (named ? 40 : 22),
      colors.alarm,
      14,
      "center",
      "600",
    );
}

/**
 * An arm in its place: a pen of its own coordinates, what Shown has, its frames and limbs.
 * @param {Pen} pen
 * @param {Shown} arm
 * @param {Point} [base]
 */
function stood(pen, arm, base = [0, 0, 0]) {
  /** @type {[number[][], number[][]]} */
  const [joints, moved] = [[], []],
    {size, solid} = pen.scene,
    all = frames(arm.chain, arm.q, joints, moved);
  const exists = arm.q.every(Number.isFinite),
    rods = exists ? limbs(all, joints, moved, size) : [];
  return {
    ...pen,
    trace: [],
    tail: [],
    ghosts: [],
    ...arm,
    cam: movedTo(pen.cam, base),
    all,
    joints,
    exists,
    rods,
    depth: dot(base, pen.cam.toward),
    thick: Math.min(15, Math.max(5, 0.045 * size * pen.cam.scale)),
    dips: solid && rods.some(ends => Math.min(ends[0][2], ends[1][2]) < -1e-9),
  };
}

/**
 * @param {Stood} one
 * @param {number} [from]  a height
 */
const drawRods = ({g, cam, chain, joints, thick, scene, rods}, from) =>
  drawArm(g, cam, chain, rods, joints, thick, scene.size, from);

/**
 * The arm, its path before and behind it.
 * @param {Stood} one
 */
function drawStood(one) {
  const {g, cam, scene, trace, tail, ghosts, rods, thick} = one,
    {to} = cam;
  stroke(
    g,
    trace.map(p => p && to(p)),
    clear(colors.path, 0.45),
    1.4,
    [1, 4],
  );
  one.under?.(g, cam);
  drawFoot(one, rods.length ? 1 : 0.4);
  for (const {q, past} of ghosts)
    stroke(
      g,
      polyline(one.chain, q).map(to),
      clear(colors.ghost, 0.42),
      Math.max(2, 0.3 * thick),
      past ? [3, 7] : [],
    );
  g.globalAlpha = one.faded ? 0.3 : 1;
  if (one.dips) drawRods({...one, rods: rods.flatMap(raised)}, 0);
  else drawRods(one);
  if (one.framed) for (const frame of one.all) triad(g, cam, frame, 0.08 * scene.size, 1.8, 1);
  g.globalAlpha = 1;
  if (tail.length > 1) {
    stroke(
      g,
      tail.map(p => p && to(p)),
      clear(colors.paper, 0.85),
      4.5,
    );
    stroke(
      g,
      tail.map(p => p && to(p)),
      colors.path,
      2.2,
    );
  }
  one.over?.(g, cam);
}

/** @param {Stood} one */
function drawFlange({g, cam, scene, faded, all, exists}) {
  if (!exists) return;
  g.globalAlpha = faded ? 0.4 : 1;
  const flange = all[all.length - 1];
  triad(g, cam, flange, 0.13 * scene.size, 3, 1, true);
  spot(g, cam.to(origin(flange)), 3.6, colors.hub, colors.path, 1.8);
  g.globalAlpha = 1;
}

/**
 * Polygons, the farther ones first.
 * @param {Pen} pen
 */
function drawFaces({g, cam, scene: {faces = []}}) {
  /** @type {(corners: Point[]) => number} */
  const depth = corners => corners.reduce((sum, p) => sum + dot(p, cam.toward), 0) / corners.length;
  for (const corners of [...faces].sort((p, q) => depth(p) - depth(q)))
    polygon(g, corners.map(cam.to), colors.foot, colors.footEdge, 1);
}

/**
 * Targets, points, and how near the path passes: their labels, and the places on the canvas that
 * labels keep off.
 * @param {Pen} pen
 * @param {Shown["near"]} near
 */
function drawPlaces({g, cam, scene}, near) {
  const {to} = cam;
  /** @type {Label[]} */
  const labels = [];
  /** @type {Pixel[]} */
  const taken = [];
  for (const {name, at, radius} of scene.marks) {
    if (!radius) spot(g, to(at), 3.5, colors.path);
    if (name) labels.push({text: name, at: to(at), color: colors.soft});
  }
  for (const {name, pose} of scene.targets) {
    const from = to(origin(pose));
    for (const tip of triad(g, cam, pose, 0.09 * scene.size, 1.8, 0.95))
      for (let k = 1; k < 8; k++)
        taken.push([
          from[0] + (k / 7) * (tip[0] - from[0]),
          from[1] + (k / 7) * (tip[1] - from[1]),
        ]);
    spot(g, from, 2.6, colors.path, colors.paper, 1);
    labels.push({text: name, at: from, color: colors.ink, weight: "600"});
  }
  const via = near && scene.targets.find(target => target.name === "via");
  if (via) {
    const p = to(origin(via.pose)),
      q = to(near.place);
    if (Math.hypot(p[0] - q[0], p[1] - q[1]) > 3) stroke(g, [p, q], colors.near, 1.6, [4, 3]);
    labels.push({text: near.text, at: [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], color: colors.near});
  }
  return {labels, taken};
}

/**
 * The floor's grid; `over`: what is drawn already lies below it.
 * @param {Pen} pen
 * @param {boolean} [over]
 */
function drawFloor(
  {
    g,
    cam: {to},
    scene: {
      grid,
      floor: [low, high],
    },
    space: {a, b, at},
  },
  over = false,
) {
  if (over)
    polygon(
      g,
      [at(low[a], low[b]), at(high[a], low[b]), at(high[a], high[b]), at(low[a], high[b])].map(to),
      clear(colors.paper, 0.75),
      colors.line,
      1,
    );
  /** @type {(p: Point, q: Point, value: number) => void} */
  const line = (p, q, value) =>
    stroke(g, [to(p), to(q)], Math.abs(value) < grid / 9 ? colors.line : colors.grid, 1);
  for (let x = low[a]; x < high[a] + grid / 9; x += grid) line(at(x, low[b]), at(x, high[b]), x);
  for (let y = low[b]; y < high[b] + grid / 9; y += grid) line(at(low[a], y), at(high[a], y), y);
}

/**
 * The path and the arm on the floor.
 * @param {Stood} one
 */
function drawShadow({g, cam: {to}, scene, trace, rods, thick}) {
  /** @type {(p: Point) => Pixel} */
  const sunk = ([x, y]) => to([x, y, scene.floor[0][2]]);
  stroke(
    g,
    trace.map(p => p && sunk(p)),
    clear(colors.soft, 0.16),
    1.5,
  );
  for (const [p, q] of rods) stroke(g, [sunk(p), sunk(q)], clear(colors.soft, 0.13), thick);
}

/**
 * The straight way from target to target, where they are stations of one path.
 * @param {Pen} pen
 */
function drawRoute({g, cam: {to}, scene}) {
  const stations = ["start", "via", "goal"]
    .map(name => scene.targets.find(target => target.name === name))
    .filter(t => t !== undefined);
  if (stations.length > 1)
    stroke(
      g,
      stations.map(({pose}) => to(origin(pose))),
      clear(colors.soft, 0.55),
      1,
      [7, 5],
    );
}

/**
 * @param {Pen} pen
 * @param {number} alpha
 */
function drawFoot({g, cam: {to}, scene, space: {a, b, spatial}}, alpha) {
  const ring = Array.from({length: 40}, (_, i) => {
    const p = [0, 0, 0],
      t = (i * Math.PI) / 20;
    p[a] = 0.06 * scene.size * Math.cos(t);
    p[b] = 0.06 * scene.size * Math.sin(t);
    return to(p);
  });
  const depth = scene.floor[0][2];
  g.globalAlpha = alpha;
  if (spatial && depth < -1e-9) stroke(g, [to([0, 0, 0]), to([0, 0, depth])], colors.line, 6);
  polygon(g, ring, colors.foot, colors.footEdge, 1.2);
  g.globalAlpha = 1;
}

/**
 * The straight pieces of a posture.
 * @param {number[][]} all
 * @param {number[][]} joints
 * @param {number[][]} moved
 * @param {number} size
 */
function limbs(all, joints, moved, size) {
  const pieces = joints.flatMap(
    /** @returns {Limb[]} */ (joint, i) => [
      [origin(all[i]), origin(joint), false],
      [origin(joint), origin(moved[i]), true],
      [origin(moved[i]), origin(all[i + 1]), false],
    ],
  );
  return pieces.filter(([p, q]) => distance(p, q) > 1e-6 * size);
}

/**
 * What of a limb is above the floor.
 * @param {Limb} limb
 * @returns {Limb[]}
 */
function raised([p, q, rod]) {
  const [low, high] = p[2] < q[2] ? [p, q] : [q, p];
  if (low[2] >= 0) return [[p, q, rod]];
  return high[2] <= 0
    ? []
    : [[plus(high, plus(low, high, -1), high[2] / (high[2] - low[2])), high, rod]];
}

/**
 * Links and joints, the farther ones first; joints from a height on.
 * @param {Context} g
 * @param {Camera} cam
 * @param {PageLink[]} chain
 * @param {Limb[]} rods
 * @param {number[][]} joints
 * @param {number} thick
 * @param {number} size
 * @param {number} [from]
 */
function drawArm(g, cam, chain, rods, joints, thick, size, from = -Infinity) {
  const things = rods.map(([p, q, rod]) => ({
    depth: dot(plus(p, q), cam.toward) / 2,
    draw: () => limb(g, cam.to(p), cam.to(q), rod ? 0.55 * thick : thick, rod),
  }));
  if (rods.length)
    joints.forEach((joint, i) => {
      const axis = turned(joint, chain[i].axis),
        p = origin(joint);
      if (p[2] < from - 0.01 * size) return;
      const radius = thick * (joints.length > 3 && i >= joints.length - 3 ? 0.72 : 1);
      things.push({
        depth: dot(p, cam.toward) + 0.02 * size,
        draw: () =>
          chain[i].prismatic
            ? box(g, cam, p, axis, 0.8 * radius, jointColor(i))
            : drum(g, cam, p, axis, 0.72 * radius, jointColor(i)),
      });
    });
  things.sort((p, q) => p.depth - q.depth).forEach(thing => thing.draw());
}

/**
 * @param {Context} g
 * @param {Pixel} p
 * @param {Pixel} q
 * @param {number} width
 * @param {boolean} rod
 */
function limb(g, p, q, width, rod) {
  const [edge, body, light] = rod
    ? [colors.rodEdge, colors.rod, colors.rodShine]
    : [colors.edge, colors.link, colors.shine];
  /** @type {(p: Pixel) => Pixel} */
  const up = ([x, y]) => [x - 0.16 * width, y - 0.2 * width];
  stroke(g, [p, q], clear(colors.paper, 0.9), width + 3);
  stroke(g, [p, q], edge, width);
  stroke(g, [p, q], body, width - 2);
  stroke(g, [up(p), up(q)], light, 0.22 * width);
}

/**
 * A joint that turns, as a drum around its axis, with a band of the joint's colour.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Point} p
 * @param {number[]} axis
 * @param {number} radius
 * @param {string} color
 */
function drum(g, cam, p, axis, radius, color) {
  const [cx, cy] = cam.to(p),
    [dx, dy] = cam.along(axis),
    long = Math.hypot(dx, dy) / cam.scale;
  const facing = Math.abs(dot(axis, cam.toward)),
    angle = Math.atan2(dy, dx);
  const half = 0.85 * radius * long,
    side = dot(axis, cam.toward) > 0 ? 1 : -1; // half its length on the screen
  g.save();
  g.translate(cx, cy);
  g.rotate(angle);
  /** @type {(place: number, r: number, from: number, to: number) => void} */
  const arc = (place, r, from, to) =>
    g.ellipse(side * place, 0, r * facing + 1e-6, r, 0, from, to, side < 0);
  const body = () => {
    arc(half, radius, -Math.PI / 2, Math.PI / 2);
    arc(-half, radius, Math.PI / 2, -Math.PI / 2);
  };
  /** @type {(r: number) => () => void} */
  const face = r => () => g.ellipse(side * half, 0, r * facing + 1e-6, r, 0, 0, 2 * Math.PI);
  shape(g, body, color, colors.paper, 3);
  shape(g, body, color, colors.edge, 1.2);
  shape(g, face(radius), color, colors.edge, 1);
  shape(g, face(0.45 * radius), colors.hub);
  g.restore();
}

/**
 * A joint that shifts, as a square guide.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Point} p
 * @param {number[]} axis
 * @param {number} radius
 * @param {string} color
 */
function box(g, cam, p, axis, radius, color) {
  const [x, y] = cam.to(p),
    [dx, dy] = cam.along(axis),
    angle = Math.atan2(dy, dx) + Math.PI / 4,
    r = Math.SQRT2 * radius;
  const corners = [0, 1, 2, 3]
    .map(k => angle + (k * Math.PI) / 2)
    .map(/** @returns {Pixel} */ t => [x + r * Math.cos(t), y + r * Math.sin(t)]);
  polygon(g, corners, color, colors.edge, 1.2);
}

/**
 * @param {Context} g
 * @param {Pixel} centre
 * @param {number} radius
 */
function ball(g, [x, y], radius) {
  const shade = g.createRadialGradient(x - radius / 3, y - radius / 3, radius / 8, x, y, radius);
  shade.addColorStop(0, clear(colors.ballShine, 0.75));
  shade.addColorStop(1, clear(colors.ball, 0.75));
  spot(g, [x, y], radius, shade, colors.ballEdge, 1.2);
}

/**
 * The axes of a frame.
 * @param {Context} g
 * @param {Camera} cam
 * @param {number[]} pose  12 numbers
 * @param {number} length
 * @param {number} width
 * @param {number} alpha
 * @param {boolean} [letters]
 * @returns {Pixel[]}  their tips on the screen
 */
function triad(g, cam, pose, length, width, alpha, letters = false) {
  const p = origin(pose),
    from = cam.to(p),
    before = g.globalAlpha;
  const axes = AXES.map((name, k) => ({name, way: [pose[k], pose[4 + k], pose[8 + k]]}));
  axes.sort((m, n) => dot(m.way, cam.toward) - dot(n.way, cam.toward));
  g.globalAlpha = before * alpha;
  const tips = axes.map(({name, way}) => {
    const tip = cam.to(plus(p, way, length));
    stroke(g, [from, tip], colors.paper, width + 2);
    stroke(g, [from, tip], colors[name], width);
    return {name, tip};
  });
  if (letters)
    for (const {name, tip} of tips) {
      const d = [tip[0] - from[0], tip[1] - from[1]],
        l = Math.hypot(...d);
      if (l > 0.35 * length * cam.scale)
        words(
          g,
          name,
          tip[0] + (8 * d[0]) / l,
          tip[1] + (8 * d[1]) / l + 4,
          colors[name],
          12,
          "center",
          "600",
        );
    }
  g.globalAlpha = before;
  return tips.map(({tip}) => tip);
}

/**
 * Where x, y and z of the base point, in a corner.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Pixel} corner
 */
function compass(g, cam, [x, y]) {
  [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ].forEach((axis, k) => {
    const [dx, dy] = cam.along(axis),
      l = Math.hypot(dx, dy) / cam.scale;
    if (l < 0.1) return;
    /** @type {Pixel} */
    const tip = [x + (18 * dx) / cam.scale, y + (18 * dy) / cam.scale];
    stroke(g, [[x, y], tip], colors[AXES[k]], 1.4);
    words(
      g,
      AXES[k],
      tip[0] + (7 * dx) / cam.scale / l,
      tip[1] + (7 * dy) / cam.scale / l + 3.5,
      colors[AXES[k]],
      10,
      "center",
    );
  });
}

/**
 * Writes each label beside its point where it covers least: other labels, lines, the rim.
 * @param {Context} g
 * @param {Label[]} labels
 * @param {Pixel[]} taken
 * @param {Box} room
 */
function place(g, labels, taken, [left, top, width, height]) {
  /** @type {Box[]} */
  const done = [];
  for (const label of labels) {
    g.font = font(12, label.weight);
    const w = g.measureText(label.text).width + 4,
      h = 16,
      [px, py] = label.at;
    let best = [NaN, NaN, NaN]; // cost, left, top
    for (const gap of [5, 14, 26, 40])
      for (let k = 0; k < 12; k++) {
        const c = Math.cos((k * Math.PI) / 6),
          s = -Math.sin((k * Math.PI) / 6);
        const x = px + c * (gap + w / 2) - w / 2,
          y = py + s * (gap + h / 2) - h / 2;
        let cost = gap / 6 + (1 - c) / 2 + (1 + s) / 2;
        for (const [qx, qy] of taken)
          if (qx > x - 3 && qx < x + w + 3 && qy > y - 2 && qy < y + h + 2) cost += 3;
        if (hit([x, y, w, h], done)) cost += 100;
        cost +=
          3 *
          (Math.max(0, left - x) +
            Math.max(0, x + w - left - width) +
            Math.max(0, top - y) +
            Math.max(0, y + h - top - height));
        if (!(cost >= best[0])) best = [cost, x, y];
      }
    const [, x, y] = best;
    done.push([x, y, w, h]);
    words(g, label.text, x + 2, y + 12, label.color, 12, "left", label.weight);
  }
}
