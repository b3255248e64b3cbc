// The picture of the rotation explorer: the axis n, the circle around it on which the tip of v
// moves, v, the vector part of q v, and q v q*.

import {fill} from "./blanks.js";
import {camera} from "./camera.js";
import {colors, number, polygon, prepared, spot, stroke, write} from "./canvas.js";
import {sceneCanvas, spoken} from "./controls.js";
import {plus} from "./kinematics.js";
import {placeLabels} from "./labels.js";
import {compass} from "./triad.js";

/** @import {RotationPage} from "./page.js" */
/** @import {Box, Context, Pixel, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Products, Seen} from "./rotation_explorer.js" */
/** @import {Picture} from "./stage.js" */

/** @typedef {{tip: Point, name: string, color: string}} Arrow */

const STEP = Math.PI / 36;

/**
 * The picture; `view` is the azimuth and the elevation of its camera.
 * @param {RotationPage} data
 * @returns {Picture<Seen> & {view: number[]}}
 */
export function rotationPicture(data) {
  const {scene, unit, words, length, decimals, axis} = data,
    canvas = sceneCanvas(scene, data.alt),
    scale = fill(words.scale, {length: number(length / unit.size, decimals), unit: unit.name}),
    [low, high] = [-0.3, 1.1].map(k => axis.map(x => k * length * x));
  /** @type {(view: number[], box: Box) => Camera} */
  const fitted = (view, box) => camera(view, scene.seen, box);
  let cam = fitted(scene.view, [0, 0, 1, 1]);
  /** @type {ReturnType<typeof rotationPicture>} */
  const picture = {
    canvas,
    view: [...scene.view],
    camera: () => cam,
    hold() {},
    draw(now) {
      const ready = prepared(canvas);
      if (!ready) return false;
      const [g, w, h] = ready;
      cam = fitted(picture.view, [14, 14, Math.max(1, w - 28), Math.max(1, h - 28)]);
      canvas.setAttribute("aria-label", spoken(scene, now.alt));
      stroke(g, [low, high].map(cam.to), colors.soft, 1.4, [8, 3, 2, 3]);
      const arrows = arrowsOf(now);
      drawCircle(g, cam, now);
      for (const arrow of arrows) drawArrow(g, cam, arrow);
      spot(g, cam.to([0, 0, 0]), 3.5, colors.ink);
      write(g, scale, 10, h - 8, colors.soft, 12);
      // a ring may have made room for the other; its letter is beside it, and q v has no ring
      const boxes = now.handles(cam),
        [whole, v] = boxes.map(([x, y, wide, high]) => [x + wide / 2, y + high / 2]),
        rings = [v, null, whole];
      const labels = [0, 2, 1].map(k => ({
        text: arrows[k].name,
        at: /** @type {Pixel} */ (rings[k] ?? cam.to(arrows[k].tip)),
        color: arrows[k].color,
      }));
      labels.push({text: "n", at: cam.to(high), color: colors.soft});
      placeLabels(g, labels, [4, 4, w - 8, h - 28], boxes);
      compass(g, cam, [0, 0, w, h]);
      return true;
    },
  };
  return picture;
}

/** @type {(now: Products) => Arrow[]} */
const arrowsOf = ({v, left, whole}) => [
  {tip: v, name: "v", color: colors.ink},
  {tip: left.slice(1), name: "q v", color: colors.near},
  {tip: whole.slice(1), name: "q v q*", color: colors.accent},
];

/**
 * The place of the tip of v after a rotation by `angle`.
 * @param {Pick<Products, "foot" | "side" | "quarter">} parts
 * @param {number} angle
 * @param {number} [share]  of the radius of its circle
 * @returns {Point}
 */
export const onCircle = ({foot, side, quarter}, angle, share = 1) =>
  plus(plus(foot, side, share * Math.cos(angle)), quarter, share * Math.sin(angle));

/**
 * Draws the circle, its radii to v, to q v q* and halfway between, the two halves of the angle, and
 * the line along the axis from the circle to q v.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Products} now
 */
function drawCircle(g, {to}, now) {
  const {angle, foot, left} = now;
  /** @type {(from: number, end: number, share: (turn: number) => number) => Pixel[]} */
  const arc = (from, end, share) => {
    const count = Math.max(1, Math.ceil((end - from) / STEP));
    return Array.from({length: count + 1}, (_, i) => from + ((end - from) * i) / count).map(turn =>
      to(onCircle(now, turn, share(turn))),
    );
  };
  /** Five places from p to q. @type {(p: Point, q: Point) => Pixel[]} */
  const line = (p, q) => [0, 1, 2, 3, 4].map(k => to(plus(p, plus(q, p, -1), k / 4)));
  const circle = arc(0, 2 * Math.PI, () => 1),
    radii = [0, angle / 2, angle].map(turn => line(foot, onCircle(now, turn))),
    drop = line(onCircle(now, angle / 2), left.slice(1));
  stroke(g, circle, colors.rim, 1.2);
  for (const radius of radii) stroke(g, radius, colors.rim, 1, [2, 3]);
  stroke(g, drop, colors.near, 1.6, [2, 3]);
  /** A spiral, so that a second turn is visible. @param {number} turn */
  const spiral = turn => 0.4 + turn / 60;
  stroke(g, arc(0, angle / 2, spiral), colors.near, 3);
  stroke(g, arc(angle / 2, angle, spiral), colors.accent, 3);
}

/**
 * Draws an arrow from the origin.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Arrow} arrow
 */
function drawArrow(g, {to}, {tip, color}) {
  const [from, end] = [to([0, 0, 0]), to(tip)],
    [dx, dy] = [end[0] - from[0], end[1] - from[1]],
    long = Math.sqrt(dx * dx + dy * dy);
  if (long < 1) return;
  const head = Math.min(12, long),
    [ux, uy] = [dx / long, dy / long];
  /** @type {(back: number, aside: number) => Pixel} */
  const point = (back, aside) => [end[0] - back * ux - aside * uy, end[1] - back * uy + aside * ux];
  stroke(g, [from, point(head, 0)], colors.paper, 5);
  stroke(g, [from, point(head, 0)], color, 3);
  polygon(g, [end, point(head, head / 2.4), point(head, -head / 2.4)], color);
}
