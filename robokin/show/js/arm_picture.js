// Draws an arm in a scene: its links and joints, its path, and its shadow on the floor.

import {movedTo} from "./camera.js";
import {
  WORD,
  clear,
  colors,
  haloed,
  ink,
  jointColor,
  polygon,
  shape,
  spot,
  stroke,
} from "./canvas.js";
import {distance, dot, frames, origin, plus, polyline, turned} from "./kinematics.js";
import {triad} from "./triad.js";

/** @import {PageLink, PageScene} from "./page.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Context, Pixel, Point} from "./canvas.js" */
/** @import {Label} from "./labels.js" */
/** @import {Pen, Shown} from "./scene.js" */

/** @typedef {ReturnType<typeof stood>} Stood  an arm in its place, and the pen that draws it */
/**
 * A straight piece of an arm. `rod` says whether it is part of a prismatic joint.
 * @typedef {[from: Point, to: Point, rod: boolean]} Limb
 */

/** The length of the axes of the flange's frame, as a fraction of the scene's size. */
export const TRIAD = 0.13;

/**
 * Prepares an arm for drawing. The result contains a pen in the coordinates of the arm's base, the
 * data of Shown, and the frames and limbs of the arm.
 * @param {Pen} pen
 * @param {Shown} arm
 * @param {Point} [base]
 */
export function stood(pen, arm, base = [0, 0, 0]) {
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
 * @param {number} [from]  the height above which joints are drawn
 */
export function drawRods({g, cam, chain, joints, thick, scene, rods, past = []}, from) {
  for (const j of past)
    spot(g, cam.to(origin(joints[j])), 1.7 * thick, clear(colors.alarm, 0.3), colors.alarm, 2);
  drawArm(g, cam, chain, rods, joints, thick, scene.size, from);
}

/**
 * Draws the whole path, then the arm, and then the part of the path that has already been
 * travelled.
 * @param {Stood} one
 */
export function drawStood(one) {
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
  g.globalAlpha = one.faded || one.glass ? 0.3 : 1;
  if (one.dips) drawRods({...one, rods: rods.flatMap(raised)}, 0);
  else drawRods(one);
  g.globalAlpha = one.faded ? 0.3 : 1;
  if (one.framed) for (const frame of one.all) triad(g, cam, frame, 0.08 * scene.size, 1.8);
  g.globalAlpha = 1;
  if (tail.length > 1)
    haloed(
      g,
      tail.map(p => p && to(p)),
      colors.path,
      2.2,
    );
  one.over?.(g, cam);
}

/**
 * Whether the arms of one picture stand at different places.
 * @param {Pick<PageScene, "bases">} scene
 */
export const apart = ({bases}) => new Set(bases?.map(String)).size > 1;

/**
 * Draws the flange and its frame; returns the letters of the axes. In a row of arms, the frames
 * would hide what the arms do, and are left out.
 * @param {Stood} one
 * @returns {Label[]}
 */
export function drawFlange({g, cam, scene, faded, all, exists}) {
  if (!exists) return [];
  g.globalAlpha = faded ? 0.4 : 1;
  const flange = all[all.length - 1];
  const letters = apart(scene) ? [] : triad(g, cam, flange, TRIAD * scene.size, 3);
  spot(g, cam.to(origin(flange)), 3.6, colors.hub, colors.path, 1.8);
  g.globalAlpha = 1;
  return letters;
}

/**
 * Draws the shadow of the path and the arm on the floor.
 * @param {Stood} one
 */
export function drawShadow({g, cam: {to}, scene, trace, rods, thick}) {
  /** @type {(p: Point) => Pixel} */
  const sunk = ([x, y]) => to([x, y, scene.floor[0][2]]);
  stroke(
    g,
    trace.map(p => p && sunk(p)),
    clear(colors.soft, 0.5),
    1.5,
  );
  for (const [p, q] of rods) stroke(g, [sunk(p), sunk(q)], clear(colors.soft, 0.13), thick);
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
 * The straight pieces of an arm in a posture.
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
 * The part of a limb above the floor.
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
 * Draws links and joints, the farthest first, but only those joints that are above the height
 * `from`.
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
  haloed(g, [p, q], edge, width);
  stroke(g, [p, q], body, width - 2);
  const up = [p, q].map(/** @returns {Pixel} */ ([x, y]) => [x - 0.16 * width, y - 0.2 * width]);
  stroke(g, up, light, 0.22 * width);
}

/**
 * Draws a revolute joint as a drum around its axis, with a band in the joint's colour.
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
    side = dot(axis, cam.toward) > 0 ? 1 : -1; // `half` is half the drum's length on screen
  ink.push([[[cx, cy]], 2.4 * radius, WORD]);
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
 * Draws a prismatic joint as a square guide.
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
  ink.push([[[x, y]], 2 * radius, WORD]);
  polygon(g, corners, color, colors.edge, 1.2);
}
