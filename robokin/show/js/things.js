// What lies in a scene besides arms: polygons, points, balls and frames.

import {clear, colors, polygon, spot, stroke} from "./canvas.js";
import {dot, origin} from "./kinematics.js";
import {triad} from "./triad.js";

/** @import {Context, Pixel, Point} from "./canvas.js" */
/** @import {Label} from "./labels.js" */
/** @import {Pen, Shown} from "./scene.js" */

/**
 * Polygons, the farther ones first.
 * @param {Pen} pen
 */
export function drawFaces({g, cam, scene: {faces = []}}) {
  /** @type {(corners: Point[]) => number} */
  const depth = corners => corners.reduce((sum, p) => sum + dot(p, cam.toward), 0) / corners.length;
  for (const corners of [...faces].sort((p, q) => depth(p) - depth(q)))
    polygon(g, corners.map(cam.to), colors.foot, colors.footEdge, 1);
}

/** @param {Pen} pen */
export function drawBalls({g, cam, scene}) {
  for (const {at, radius} of scene.marks) if (radius) ball(g, cam.to(at), radius * cam.scale);
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
 * The straight way from target to target, where they are stations of one path.
 * @param {Pen} pen
 */
export function drawRoute({g, cam: {to}, scene}) {
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
 * Targets, points, and how near the path passes: their labels, and the places on the canvas that
 * labels keep off.
 * @param {Pen} pen
 * @param {Shown["near"]} near
 */
export function drawPlaces({g, cam, scene}, near) {
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
