// The close-up of a corner of a blended motion, in the plane of its two lines, with the via point
// on the right.

import {facing} from "./camera.js";
import {large} from "./chooser.js";
import {clear, colors, prepared, spot, stroke, upright, write} from "./canvas.js";
import {squareTo} from "./handles.js";
import {dot, plus} from "./kinematics.js";
import {placeLabels} from "./labels.js";

/** @import {MotionPage, Unit} from "./page.js" */
/** @import {Context, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Shown} from "./scene.js" */
/** @import {Picture} from "./stage.js" */

// The distance of the path's middle from via, as a fraction of blend * |start - 2 via + goal|
const CUTS = {parabola: 1 / 2, quintic: 3 / 8};
const SHOWN = 0.25; // the picture has room for the parabola of this blend

/** @typedef {keyof typeof CUTS} Corner */
/** @typedef {ReturnType<typeof cornerOf>} CornerAt */

/**
 * The corner at the via point: the directions that point right and up in its picture, the middle of
 * the path for a blend, the change of the blend per metre by which the middle moves, and the points
 * that the picture shows for a blend.
 * @param {Pick<MotionPage, "start" | "via" | "goal">} stations
 */
export function cornerOf({start, via, goal}) {
  const legs = [start, goal].map(({place}) => plus(place, via.place, -1)),
    bend = plus(legs[0], legs[1]),
    size = Math.hypot(...bend),
    right = bend.map(x => -x / size);
  const side = plus(legs[0], right, -dot(legs[0], right)),
    wide = Math.hypot(...side),
    up = wide > 1e-9 * size ? side.map(x => x / wide) : squareTo(right)[0];
  // the slopes of the two lines in the picture
  const slopes = legs.map(leg => {
    const along = -dot(leg, right),
      across = Math.abs(dot(leg, up));
    return across < 1.5 * along ? across / along : 1.5;
  });
  /** @type {(blend: number, corner: Corner) => number} */
  const cut = (blend, corner) => CUTS[corner] * blend * size;
  return {
    right,
    up,
    /** @type {(blend: number, corner: Corner) => Point} */
    middle: (blend, corner) => plus(via.place, right, -cut(blend, corner)),
    /** The change of the blend per metre. @type {(corner: Corner) => number} */
    perMetre: corner => 1 / cut(1, corner),
    /** @type {(blend: number, corner: Corner) => Point[]} */
    seen(blend, corner) {
      const deep = 1.1 * Math.max(cut(SHOWN, "parabola"), cut(blend, corner)),
        end = plus(via.place, right, -deep);
      return [via.place, plus(end, up, deep * slopes[0]), plus(end, up, -deep * slopes[1])];
    },
  };
}

/** The distance in px between the path's middle and the ring that moves it. */
export const offset = () => (large() ? 34 : 24);

/**
 * The picture of a corner.
 * @param {HTMLCanvasElement} canvas
 * @param {MotionPage} data
 * @param {CornerAt} corner
 * @param {() => Point[]} seen  the points that it shows: via, and the ends of both lines
 * @param {(camera: Camera) => Point} ring  the place of the ring
 * @returns {Picture<Shown[]>}
 */
export function cornerPicture(canvas, data, {right, up}, seen, ring) {
  /** @type {?Camera} */
  let cam = null;
  let held = false;
  return {
    canvas,
    camera: () => /** @type {Camera} */ (cam),
    hold: on => {
      held = on;
    },
    draw([arm]) {
      const ready = prepared(canvas);
      if (!ready) return false;
      const [g, w, h] = ready,
        beside = offset() + 26; // room for the ring where the path does not cut the corner
      if (!cam || !held) cam = facing(right, up, seen(), [14, 26, w - beside - 14, h - 62]);
      g.save();
      g.beginPath();
      g.rect(0, 0, w, h - 24); // the scale is drawn below
      g.clip();
      drawCorner(g, cam, data, arm);
      g.restore();
      drawScale(g, cam, data.unit, h);
      const [, first, last] = seen().map(cam.to),
        [x, y] = cam.to(ring(cam)),
        half = large() ? 22 : 13;
      const labels = [
        {text: data.words.fromStart, at: first, color: colors.soft},
        {text: data.words.toGoal, at: last, color: colors.soft},
        {text: "via", at: cam.to(data.via.place), color: colors.ink, weight: "600"},
      ];
      if (arm.near)
        labels.push({text: arm.near.text, at: cam.to(arm.near.place), color: colors.near});
      placeLabels(g, labels, [4, 4, w - 8, h - 36], [[x - half, y - half, 2 * half, 2 * half]]);
      return true;
    },
  };
}

/**
 * Draws the sharp corner, the path that rounds it, and the point of the path nearest to via.
 * @param {Context} g
 * @param {Camera} cam
 * @param {MotionPage} data
 * @param {Shown} arm
 */
function drawCorner(g, {to}, {start, via, goal}, {trace = [], tail = [], near}) {
  const at = to(via.place),
    path = trace.map(p => p && to(p)),
    tool = tail.at(-1);
  stroke(g, [to(start.place), at, to(goal.place)], clear(colors.soft, 0.8), 1.2, [7, 5]);
  stroke(g, path, clear(colors.paper, 0.85), 5);
  stroke(g, path, colors.path, 2.6);
  if (tool) spot(g, to(tool), 6, colors.hub, colors.path, 2.4);
  if (near) {
    stroke(g, [at, to(near.place)], colors.near, 2, [4, 3]);
    spot(g, to(near.place), 4.5, colors.near);
  }
  spot(g, at, 3.5, colors.ink);
}

/**
 * Draws a scale bar. Its length is 1, 2 or 5 times a power of ten.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Unit} unit
 * @param {number} height
 */
function drawScale(g, {scale}, {name, size}, height) {
  const most = 120 / (scale * size),
    power = 10 ** Math.floor(Math.log10(most)),
    length = power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1),
    right = 14 + length * size * scale,
    y = height - 10;
  for (const x of [14, right]) upright(g, x, y - 4, y + 4, colors.soft, 1.4);
  stroke(
    g,
    [
      [14, y],
      [right, y],
    ],
    colors.soft,
    1.4,
  );
  write(g, `${+length.toPrecision(1)} ${name}`, right + 8, y + 4, colors.soft, 12);
}
