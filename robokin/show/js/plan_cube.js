// The cube of postures of a plan, with sides of length 1.

import {camera} from "./camera.js";
import {clear, colors, polygon, prepared, spot, stroke, write} from "./canvas.js";
import {orbit} from "./controls.js";
import {control} from "./elements.js";

/** @import {Camera} from "./camera.js" */
/** @import {Context, Pixel, Point} from "./canvas.js" */
/** @import {Values} from "./live.js" */
/** @import {Now, Shown} from "./plan_explorer.js" */

/** @typedef {{depth: number, draw: () => void}} Thing */
/** @typedef {{g: Context, cam: Camera, put: (at: Point, draw: () => void) => void}} Pen */

// on opening: the target and the path are in front of the body
const SEEN = {flat: null, view: [-1.6, 0.4]};

/**
 * @param {string} name  its name for a screen reader
 * @param {() => void} ask
 */
export function cubeView(name, ask) {
  const canvas = control("canvas", {
    class: "rk-cube",
    role: "img",
    tabindex: 0,
    "aria-label": name,
  });
  const seen = {view: [...SEEN.view]};
  orbit(canvas, SEEN, seen, ask);
  let drawn = "";
  /** @type {?Shown} */
  let about = null;
  return {
    canvas,
    /** Draws the cube only if something has changed. @type {(now: Now, q: number[]) => void} */
    draw({shown, wave, moment}, q) {
      const [steps, k] = [Math.floor(wave), Math.round(moment)],
        {clientWidth, clientHeight} = canvas;
      const looks = [steps, k, q, seen.view, clientWidth, clientHeight, colors.ink].join();
      if (about !== shown || drawn !== looks)
        drawCube(canvas, seen.view, shown, steps, k ? shown.moments[k] : q);
      [about, drawn] = [shown, looks];
    },
  };
}

/**
 * The faces of the forbidden body by direction (axis and side): the cells [i, j, k] that have such
 * a face.
 * @param {Values} cube
 * @param {number} forbidden  the value of its cells
 */
export function facesOf({values, shape: [n]}, forbidden) {
  /** @type {(i: number, j: number, k: number) => boolean} */
  const within = (i, j, k) =>
    Math.min(i, j, k) >= 0 && Math.max(i, j, k) < n && values[(i * n + j) * n + k] === forbidden;
  const faces = [0, 1, 2].map(() => /** @type {number[][][]} */ ([[], []]));
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++)
      for (let k = 0; k < n; k++) {
        if (!within(i, j, k)) continue;
        for (let axis = 0; axis < 3; axis++)
          for (const side of [0, 1]) {
            /** @type {[number, number, number]} */
            const next = [i, j, k];
            next[axis] += side ? 1 : -1;
            if (!within(...next)) faces[axis][side].push([i, j, k]);
          }
      }
  return faces;
}

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map(k => [k & 1, (k >> 1) & 1, k >> 2]);
const RING = [
  [-0.5, -0.5],
  [0.5, -0.5],
  [0.5, 0.5],
  [-0.5, 0.5],
];

/** The place of a posture in the cube. @type {(q: number[]) => Point} */
const unit = q => q.map(x => x / Math.PI);

/**
 * Draws the body, the search after `steps` steps, target, path and posture.
 * @param {HTMLCanvasElement} canvas
 * @param {number[]} view
 * @param {Shown} shown
 * @param {number} steps
 * @param {number[]} q
 */
function drawCube(canvas, view, shown, steps, q) {
  const ready = prepared(canvas);
  if (!ready) return;
  const [g, w, h] = ready,
    cam = camera(view, CORNERS, [20, 10, w - 40, h - 34]),
    {to, toward} = cam;
  /** @type {Thing[]} */
  const things = [];
  /** @type {Pen} */
  const pen = {
    g,
    cam,
    put: (at, draw) =>
      things.push({depth: at[0] * toward[0] + at[1] * toward[1] + at[2] * toward[2], draw}),
  };
  for (const [i, a] of CORNERS.entries())
    for (const b of CORNERS.slice(i + 1))
      if (a.reduce((sum, x, k) => sum + Math.abs(x - b[k]), 0) === 1)
        stroke(g, [to(a), to(b)], colors.line, 1);
  const color = shown.kept ? colors.joint2 : colors.alarm,
    way = shown.moments.map(unit);
  putBody(pen, shown);
  putWave(pen, shown.cube, steps);
  for (let k = 1; k < way.length; k++)
    pen.put(way[k], () => stroke(g, [to(way[k - 1]), to(way[k])], color, 3));
  putTargets(pen, shown.curve.map(unit));
  things.sort((a, b) => a.depth - b.depth).forEach(thing => thing.draw());
  stroke(g, way.map(to), clear(color, 0.5), 1, [3, 3]); // including the parts behind the body
  spot(g, to(unit(q)), 5, colors.path);
  tellAngles(pen);
}

/**
 * Draws the visible faces of the forbidden body.
 * @param {Pen} pen
 * @param {Shown} shown
 */
function putBody(
  {g, cam: {to, toward}, put},
  {
    faces,
    cube: {
      shape: [n],
    },
  },
) {
  const shades = [colors.shine, colors.rod, colors.rodShine];
  for (const axis of [0, 1, 2]) {
    const side = toward[axis] > 0 ? 1 : 0,
      [a, b] = [0, 1, 2].filter(k => k !== axis);
    for (const cell of faces[axis][side]) {
      const at = [...cell];
      at[axis] += side - 0.5;
      /** @type {(ring: number[]) => Pixel} */
      const corner = ([s, t]) => {
        const p = [...at];
        p[a] += s;
        p[b] += t;
        return to(p.map(x => Math.min(1, Math.max(0, x / (n - 1)))));
      };
      put(
        at.map(x => x / (n - 1)),
        () => polygon(g, RING.map(corner), shades[axis], clear(colors.paper, 0.5), 0.5),
      );
    }
  }
}

/**
 * Draws the postures that the search reaches in `steps` steps.
 * @param {Pen} pen
 * @param {Values} cube
 * @param {number} steps
 */
function putWave({g, cam: {to, scale}, put}, {values, shape: [n]}, steps) {
  const dot = Math.max(2, (0.28 * scale) / n);
  values.forEach((value, cell) => {
    if (value !== steps) return;
    const at = [Math.floor(cell / n / n), Math.floor(cell / n) % n, cell % n].map(x => x / (n - 1));
    put(at, () => {
      const [x, y] = to(at);
      g.fillStyle = clear(colors.accent, 0.65);
      g.fillRect(x - dot / 2, y - dot / 2, dot, dot);
    });
  });
}

/** @type {(pen: Pen, places: Point[]) => void} */
function putTargets({g, cam: {to}, put}, places) {
  for (const at of places)
    put(at, () => {
      const [x, y] = to(at);
      /** @type {Pixel[]} */
      const corners = [
        [x, y - 5],
        [x + 4, y + 3],
        [x - 4, y + 3],
      ];
      polygon(g, corners, colors.joint3, colors.paper, 0.5);
    });
}

/** Writes the names of the angles at their edges. @param {Pen} pen */
function tellAngles({g, cam: {to}}) {
  /** @type {[string, Point][]} */
  const angles = [
    ["\u03B3", [0.5, 0, 0]],
    ["\u03B2", [1, 0.5, 0]],
    ["\u03B1", [0, 0, 0.5]],
  ];
  const [mx, my] = to([0.5, 0.5, 0.5]);
  for (const [name, at] of angles) {
    const [x, y] = to(at),
      far = Math.hypot(x - mx, y - my) || 1,
      [px, py] = [x + (14 * (x - mx)) / far, y + (18 * (y - my)) / far + 4];
    const align = x < mx - 40 ? "right" : x > mx + 40 ? "left" : "center";
    write(g, `${name} 0\u2013180\u00B0`, px, py, colors.soft, 12, align);
  }
}
