// The scene: arms and things in space, above a floor.

import {drawFlange, drawRods, drawShadow, drawStood, stood} from "./arm_picture.js";
import {camera} from "./camera.js";
import {
  clear,
  colors,
  font,
  ink,
  polygon,
  prepared,
  stroke,
  tiled,
  upright,
  write,
} from "./canvas.js";
import {frames, origin} from "./kinematics.js";
import {kinds} from "./kinds.js";
import {placeLabels} from "./labels.js";
import {compass} from "./triad.js";

/** @import {PageLink, PageScene, PageThing, Unit} from "./page.js" */
/** @import {Box, Context, Point, Ring} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Label} from "./labels.js" */
/** @import {Now} from "./recordings.js" */

/**
 * The state of a scene in one picture, and the unit of length on the page.
 * @typedef {Omit<PageScene, "things"> & {things: Now<PageThing>[], unit: Unit}} Scene
 */
/** @typedef {(g: Context, cam: Camera) => void} Draw */
/** @typedef {{at: Point, along?: Point[], apart?: Point[]}} Places  of a label, in space */
/**
 * @typedef {object} Shown  an arm as it is drawn
 * @property {string} name
 * @property {PageLink[]} chain
 * @property {number[]} q  radians and metres
 * @property {(?Point)[]} [trace]  the tool's places, null at breaks; `tail`: those passed so far
 * @property {(?Point)[]} [tail]
 * @property {boolean} [faded]  whether there is no solution
 * @property {string} [nowhere]  the words for this, if not "no solution"
 * @property {?{place: Point, text: string}} [near]  where the path is nearest to "via"
 * @property {{q: number[], past: boolean}[]} [ghosts]  other postures, faint; dashed if they
 *   exceed a limit (`past`)
 * @property {boolean} [framed]  whether to show the frame of every link
 * @property {boolean} [glass]  whether to draw it translucent
 * @property {number[]} [past]  the joints that exceed a limit
 * @property {string} [row]  the row of `ik` to which the posture belongs
 * @property {(Omit<Label, keyof Places> & Places)[]} [labels]
 *   labels at points, bold unless they say otherwise
 * @property {Draw} [under]  draws anything else below the arm
 * @property {Draw} [over]  draws anything else above it
 * @property {(cam: Camera) => Point[]} [around]  points, besides those of the arm, that a growing
 *   scene must show
 * @property {(cam: Camera) => Ring[]} [handles]  the boxes of its handles, which no label covers
 */
/** @typedef {ReturnType<typeof surroundings>} Space  the fixed surroundings of a scene */
/**
 * The data for drawing a picture: canvas, camera, scene and surroundings.
 * @typedef {{g: Context, cam: Camera, scene: Scene, space: Space}} Pen
 */
/**
 * How one kind of thing is drawn. T is its page data. `below` and `above` are called once, with all
 * things of the kind.
 *
 * seen   points that a growing scene must show
 * below  draws the parts below the arms
 * above  draws the parts above the arms, and adds labels
 *
 * @template T
 * @typedef {{
 *   seen(thing: Now<T>): Point[],
 *   below(pen: Pen, things: Now<T>[]): void,
 *   above(pen: Pen & Pick<Shown, "near">, things: Now<T>[], labels: Label[]): void,
 * }} Kind
 */

/** @type {Record<string, Kind<PageThing>>} */
const KINDS = kinds;

/**
 * The scene of a page before things are added.
 * @param {{scene: PageScene, unit: Unit}} page
 * @returns {Scene}
 */
export const sceneOf = ({scene, unit}) => ({...scene, things: [], unit});

/**
 * Draws arms in space.
 *
 * draw(view, arms, clock)   draws one picture: view [azimuth, elevation], arms Shown[], text for
 *                           the upper right corner. Returns whether there was room for it
 * cameras()                 the cameras of the last picture: one for each arm, or one if all arms
 *                           are in one picture; `to` projects a point to CSS pixels
 * hold(on)                  while on, the cameras of the last picture are kept, since something is
 *                           being dragged
 * height(count, width)      the height of a canvas that this many arms fill at this width
 *
 * @param {HTMLCanvasElement} canvas
 * @param {Scene} scene  `things` may be replaced between two pictures
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
    const [g, w, h] = ready,
      pictures = scene.bases ? [arms] : arms.map(arm => [arm]);
    const [columns, rows] = arranged(scene, space, pictures.length, w, h),
      cw = w / columns,
      ch = h / rows,
      many = pictures.length > 1; // several pictures have names and rows at the top
    const edge = () => {
      const {grid, unit} = scene,
        scale = `grid ${+(grid / unit.size).toPrecision(6)} ${unit.name}`;
      const row = many ? clock : arms.length > 1 ? "" : arms[0].row || "";
      g.font = font(12);
      const [wide, more] = [scale, row].map(text => g.measureText(text).width + 16);
      g.fillStyle = colors.paper; // no line goes through the words
      g.fillRect(8, h - 20, wide + (row ? more : 0) - 12, 16);
      write(g, scale, 10, h - 8, colors.soft);
      write(g, row, 10 + wide, h - 8);
      if (!many) write(g, clock, w - 10, 18, colors.ink, 13, "right", "600");
    };
    cameras = pictures.map((shown, i) => {
      /** @type {Box} */
      const cell = [(i % columns) * cw, Math.floor(i / columns) * ch, cw, ch];
      /** @type {(points: Point[]) => Camera} */
      const fit = points => camera(view, [...space.corners, ...points], inside(cell));
      const cam = (held && cameras[i]) || fit(scene.grows ? reached(scene, shown[0], fit([])) : []);
      drawSpace({g, cam, scene, space}, shown, cell, many ? null : edge);
      return cam;
    });
    if (many) edge();
    return true;
  }

  /** @type {(count: number, width: number) => number} */
  function height(count, width) {
    const [columns, rows] = tiled(count, width),
      [, , w, h] = inside([0, 0, width / columns, 1000]);
    const {to} = camera(scene.view, space.corners, [0, 0, w, 1e6]),
      ys = space.corners.map(p => to(p)[1]);
    return rows * (Math.max(...ys) - Math.min(...ys) + 1000 - h);
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
 * The numbers of columns and rows in which `count` pictures are largest.
 * @param {Scene} scene
 * @param {Space} space
 * @param {number} count
 * @param {number} width
 * @param {number} height
 * @returns {[number, number]}
 */
function arranged(scene, space, count, width, height) {
  /** @type {[number, number]} */
  let best = [1, count],
    most = 0;
  for (let columns = 1; count > 1 && columns <= count; columns++) {
    const rows = Math.ceil(count / columns),
      box = inside([0, 0, width / columns, height / rows]),
      {scale} = camera(scene.view, space.corners, box);
    if (scale > most * 1.01) [best, most] = [[columns, rows], scale];
  }
  return best;
}

/**
 * The part of a cell inside the margins for text: names above, the scale below.
 * @param {Box} cell
 * @returns {Box}
 */
const inside = ([x, y, w, h]) => [x + 20, y + 28, Math.max(1, w - 40), Math.max(1, h - 54)];

/**
 * The fixed surroundings: the coordinate axes of the grid, a function that returns a point on the
 * floor, and the points that must be visible, including their shadows. The rest of the floor may be
 * outside the picture.
 * @param {Scene} scene
 */
export function surroundings({flat, floor: [low], seen}) {
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
 * The additional points that a growing scene must show.
 * @param {Scene} scene
 * @param {Shown} arm
 * @param {Camera} fixed  the camera of the scene as it is before it grows
 */
function reached(scene, arm, fixed) {
  const all = [arm, ...(arm.ghosts || [])].flatMap(({q}) => {
    /** @type {number[][]} */
    const joints = [];
    return [...frames(arm.chain, q, joints), ...joints].map(origin);
  });
  for (const thing of scene.things) all.push(...KINDS[thing.kind].seen(thing));
  return [...all, ...(arm.around?.(fixed) || [])].filter(p => p.every(Number.isFinite));
}

/**
 * Draws arms, and everything around them, inside the cell of one picture, and a line between it and
 * the cell on its left.
 * @param {Pen} pen
 * @param {Shown[]} arms
 * @param {Box} cell
 * @param {?() => void} edge  writes the words at the edge of the only picture
 */
function drawSpace(pen, arms, cell, edge) {
  const {g, cam, scene} = pen,
    [x, y, w, h] = cell,
    [first] = arms,
    all = arms.map((arm, i) => stood(pen, arm, scene.bases?.[i]));
  /** @type {(kind: string) => Now<PageThing>[]} */
  const only = kind => scene.things.filter(thing => thing.kind === kind);
  g.save();
  g.beginPath();
  g.rect(...cell);
  g.clip();
  const sunk = all.filter(one => one.dips);
  let before = ink.length;
  drawFloor(pen);
  ink.length = before; // labels may cover the floor and the shadows
  for (const one of sunk) drawRods(one);
  before = ink.length;
  if (sunk.length) drawFloor(pen, true);
  if (pen.space.spatial) all.forEach(drawShadow);
  ink.length = before;
  for (const kind in KINDS) KINDS[kind].below(pen, only(kind));
  [...all].sort((p, q) => p.depth - q.depth).forEach(drawStood);
  /** @type {Label[]} */
  const labels = all.flatMap(({cam, joints, past = []}) =>
    past.map(j => ({
      text: `q${j + 1} past its limit`,
      at: cam.to(origin(joints[j])),
      color: colors.alarm,
      weight: "600",
    })),
  );
  for (const kind in KINDS) KINDS[kind].above({...pen, near: first.near}, only(kind), labels);
  labels.unshift(...all.flatMap(drawFlange)); // a flange is drawn over its target
  if (edge) edge();
  else {
    const {name, row = ""} = first;
    write(g, name, x + 10, y + 18, colors.ink, 13, "left", "600");
    // below the name if there is no room beside it
    if (g.measureText(`${name} ${row}`).width < w - 24)
      write(g, row, x + w - 10, y + 18, colors.ink, 12, "right");
    else write(g, row, x + 10, y + 34);
  }
  if (arms.some(arm => arm.faded)) {
    labels.push({
      text: first.nowhere ?? "no solution",
      at: [x + w / 2, y + 24],
      color: colors.alarm,
      weight: "600",
      away: [0, 1],
    });
  }
  labels.push(...all.flatMap(onCanvas));
  const room = /** @type {Box} */ ([x + 4, y + 4, w - 8, h - (edge ? 8 : 26)]);
  placeLabels(g, labels, room, first.handles?.(all[0].cam));
  compass(g, cam, cell); // last: labels need the room more
  g.restore();
  if (x) upright(g, x, y + 10, y + h - 10, colors.grid, 1);
}

/**
 * The labels of an arm on the canvas.
 * @type {(arm: Pick<Shown, "labels"> & {cam: Camera}) => Label[]}
 */
const onCanvas = ({cam, labels = []}) =>
  labels.map(({at, along = [at], apart = [], ...look}) => ({
    weight: "600",
    ...look,
    at: cam.to(at),
    along: along.map(cam.to),
    apart: apart.map(cam.to),
  }));

/**
 * Draws the floor's grid; with `over`, a translucent floor on top of what is already drawn.
 * @param {Pen} pen
 * @param {boolean} [over]
 */
export function drawFloor(
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
