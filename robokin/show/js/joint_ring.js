// The rings of the joint explorer: their places and their style.

import {clear, jointColor, stroke} from "./canvas.js";
import {reachOf, squareTo} from "./handles.js";
import {IDENTITY, cross, dot, fk, frames, origin, plus, turned} from "./kinematics.js";

/** @import {PageLink} from "./page.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Context, Point} from "./canvas.js" */

/**
 * The place of a ring on its joint. Its distance from the joint along the axis is `slide` (-1, 0 or
 * 1) times a reach, less the distance `gap` (m), by which the joints are already apart. `spoke` (a
 * unit vector in the frame that the joint moves) points from the axis to the handle.
 * @typedef {{slide: number, gap: number, spoke: Point}} Ring
 */

const RADIUS = 0.47,
  SLIDE = 0.68; // fractions of the reach of a handle: see reachOf
const CROWDED = 0.2; // joints nearer than this fraction of the arm's reach are close together

/**
 * The rings of an arm. If joints are close together, as in a wrist, their rings are at different
 * places along their axes: the ring of the first joint is in front of the others, and that of the
 * last joint is behind them. The places depend only on the links, so that a ring does not jump
 * while a joint moves.
 * @param {PageLink[]} chain
 * @param {number} reach
 * @returns {Ring[]}
 */
export function ringsOf(chain, reach) {
  /** @type {[number[][], number[][]]} */
  const [joints, moved] = [[], []],
    ends = frames(
      chain,
      chain.map(() => 0),
      joints,
      moved,
    );
  const places = [IDENTITY, ...joints, ends[chain.length]].map(origin),
    ways = places.slice(1).map((place, i) => plus(place, places[i], -1));
  /** @type {(i: number) => boolean} */
  const near = i => i > 0 && i < chain.length && dot(ways[i], ways[i]) < (CROWDED * reach) ** 2;
  return chain.map((link, i) => {
    const axis = turned(joints[i], link.axis),
      next = turnedBack(moved[i], ways[i + 1]);
    const first = !near(i) && near(i + 1),
      last = near(i) && !near(i + 1);
    const slide = first ? -along(axis, ways[i]) : last ? along(axis, ways[i + 1]) : 0;
    return {
      slide,
      gap: last ? Math.max(0, slide * dot(axis, ways[i])) : 0,
      spoke: besides(link.axis, next, turnedBack(moved[i], ways[i])),
    };
  });
}

/**
 * The sign of the component of `way` along a unit vector: 0 if `way` has another direction, 1 if it
 * is zero.
 * @param {Point} axis
 * @param {Point} way
 */
function along(axis, way) {
  const part = dot(axis, way),
    long = Math.sqrt(dot(way, way));
  if (long < 1e-9) return 1;
  return Math.abs(part) > 0.9 * long ? Math.sign(part) : 0;
}

/** v in the coordinates of m. @param {number[]} m @param {Point} v @returns {Point} */
const turnedBack = (m, v) => [0, 1, 2].map(k => m[k] * v[0] + m[4 + k] * v[1] + m[8 + k] * v[2]);

/**
 * A unit vector perpendicular to an axis and, if possible, to the link that the joint moves, on the
 * side away from the link before it.
 * @param {Point} axis
 * @param {Point} link
 * @param {Point} before
 */
function besides(axis, link, before) {
  const side = cross(axis, link),
    long = (dot(side, before) < -1e-9 ? -1 : 1) * Math.sqrt(dot(side, side));
  return Math.abs(long) > 1e-9 ? side.map(x => x / long) : squareTo(axis)[0];
}

/**
 * The place of the ring of joint i: its centre, and the handle on it. A prismatic joint has its
 * handle on its axis.
 * @param {PageLink[]} chain
 * @param {Ring[]} rings
 * @param {number[]} q
 * @param {number} i
 * @param {Camera} camera
 */
export function ringAt(chain, rings, q, i, camera) {
  /** @type {[number[][], number[][]]} */
  const [joints, moved] = [[], []];
  frames(chain, q, joints, moved);
  const {slide, gap, spoke} = rings[i],
    reach = reachOf(camera);
  const axis = turned(joints[i], chain[i].axis),
    here = origin(moved[i]);
  if (chain[i].prismatic) return {centre: here, grip: plus(here, axis, 0.5 * reach), axis};
  const centre = plus(here, axis, slide * Math.max(0, SLIDE * reach - gap));
  return {centre, grip: plus(centre, turned(moved[i], spoke), RADIUS * reach), axis};
}

/**
 * Points of a ring, the first also as the last.
 * @param {ReturnType<typeof ringAt>} ring
 * @param {number} count
 */
function circle({centre, grip, axis}, count) {
  const spoke = plus(grip, centre, -1),
    across = cross(axis, spoke);
  return Array.from({length: count + 1}, (_, k) => (2 * Math.PI * k) / count).map(t =>
    plus(plus(centre, spoke, Math.cos(t)), across, Math.sin(t)),
  );
}

/**
 * The points that must be inside the picture: points on the rings whose handles are shown, and the
 * ends of the axes of the flange's frame.
 * @param {Camera} camera
 * @param {PageLink[]} chain
 * @param {Ring[]} rings
 * @param {number[]} q
 * @param {(joint: number) => boolean} shows
 * @param {number} long  the length of the flange's axes
 */
export function around(camera, chain, rings, q, shows, long) {
  const flange = fk(chain, q);
  return [
    ...rings.flatMap((_, i) => (shows(i) ? circle(ringAt(chain, rings, q, i, camera), 8) : [])),
    ...[0, 1, 2].map(k => plus(origin(flange), [flange[k], flange[4 + k], flange[8 + k]], long)),
  ];
}

/**
 * Draws the rings whose handles are shown, each with the line from its centre to its handle.
 * @param {Context} g
 * @param {Camera} camera
 * @param {PageLink[]} chain
 * @param {Ring[]} rings
 * @param {number[]} q
 * @param {(joint: number) => boolean} shows  whether the handle of a joint is shown
 */
export function drawRings(g, camera, chain, rings, q, shows) {
  rings.forEach((_, i) => {
    if (!shows(i)) return;
    const ring = ringAt(chain, rings, q, i, camera),
      {centre, grip} = ring,
      color = clear(jointColor(i), 0.7);
    if (!chain[i].prismatic) stroke(g, circle(ring, 48).map(camera.to), color, 1.6);
    stroke(g, [camera.to(centre), camera.to(grip)], color, 1.2);
  });
}
