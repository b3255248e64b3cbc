// Two links whose tip moves along a straight line: the tracks of both elbows, and the elbow that a
// quadratic formula returns.

import {ik} from "./geometries.js";
import {distance, polyline} from "./kinematics.js";
import {exists} from "./rows.js";

/** @import {TwoLinkInverse} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {ArmOf, ClosedFormArm} from "./kinematics.js" */

/** @typedef {ClosedFormArm & ArmOf<TwoLinkInverse>} TwoLinkArm */
/**
 * The tracks of both elbows on one side of the base, and which of them the formula returns there: 0
 * for the right elbow, 1 for the left one. `u` contains the changing coordinate of the tip,
 * measured from the base.
 * @typedef {{u: number[], right: Point[], left: Point[], which: number}} Tracks
 */

const STEPS = 60; // of each half of a track
const TINY = 1e-9; // times the reach: a track begins this close to the zero of the divisor

/**
 * Returns the right and the left elbow, or an empty array if the tip is out of reach.
 * @param {TwoLinkArm} arm
 * @param {Point} tip
 */
export const elbowsAt = (arm, tip) =>
  ik(arm, {place: tip})
    .filter(exists)
    .map(q => polyline(arm.chain, q)[2]);

/**
 * The elbow that the quadratic formula returns if coordinate k of the elbow is eliminated and the
 * root has the plus sign; null where it divides 0 by 0.
 * @param {TwoLinkArm} arm
 * @param {Point} tip
 * @param {number} k
 * @returns {?Point}
 */
export function byRoot({geometry: {l1, l2, base}}, tip, k) {
  const u = tip[k] - base[k],
    v = tip[1 - k] - base[1 - k],
    d2 = u * u + v * v,
    half = (d2 + l1 * l1 - l2 * l2) / 2,
    // at the limit of the reach, rounding errors may make the radicand negative
    root = Math.sqrt(Math.max(u * u * (l1 * l1 * d2 - half * half), 0)),
    kept = (v * half + root) / d2,
    found = [0, 0, 0];
  found[k] = base[k] + (half - v * kept) / u;
  found[1 - k] = base[1 - k] + kept;
  return found.every(Number.isFinite) ? found : null;
}

/**
 * Returns the index of the elbow that the formula returns, or -1 if it returns none.
 * @param {Point[]} elbows
 * @param {?Point} formula
 */
export function nearest(elbows, formula) {
  if (!formula || !elbows.length) return -1;
  const [right, left] = elbows.map(elbow => distance(elbow, formula));
  return Number(left < right);
}

/**
 * Returns the tip after its coordinate k has been set to `u`, measured from the base.
 * @param {TwoLinkArm} arm
 * @param {Point} tip
 * @param {number} k
 * @param {number} u
 */
export const movedTo = ({geometry: {base}}, tip, k, u) =>
  tip.map((x, i) => (i === k ? base[k] + u : x));

/**
 * Returns whether the tip is on the base. There, with equal links, every point of the circle around
 * the base is an elbow.
 * @param {TwoLinkArm} arm
 * @param {Point} tip
 */
export const onBase = ({geometry: {base, reach}}, tip) =>
  distance(tip, [...base, 0]) < TINY * reach;

/**
 * Returns the least and the greatest distance, along coordinate k, of the tip from the base.
 * @param {TwoLinkArm} arm
 * @param {Point} tip
 * @param {number} k
 */
export const rangeOf = ({geometry: {l1, l2, base}}, tip, k) =>
  [Math.abs(l1 - l2), l1 + l2].map(r => {
    const v = tip[1 - k] - base[1 - k];
    return Math.sqrt(Math.max(r * r - v * v, 0));
  });

/**
 * The tracks of the elbows on both sides of the base while coordinate k of the tip changes. The
 * samples are densest at the limit of the reach, where the elbows move fastest.
 * @param {TwoLinkArm} arm
 * @param {Point} tip
 * @param {number} k
 * @returns {Tracks[]}
 */
export function tracksAt(arm, tip, k) {
  const [near, far] = rangeOf(arm, tip, k),
    start = near || TINY * arm.geometry.reach;
  if (!(far > start)) return [];
  return [-1, 1].map(side => {
    const samples = Array.from({length: STEPS + 1}, (_, i) => {
      const share = (1 - Math.cos((i * Math.PI) / STEPS)) / 2,
        u = side * (start + share * (far - start));
      return {u, pair: elbowsAt(arm, movedTo(arm, tip, k, u))};
    }).filter(({pair}) => pair.length); // at the ends, rounding errors may put the tip out of reach
    const middle = movedTo(arm, tip, k, (side * (start + far)) / 2);
    const pairs = samples.map(({pair}) => pair);
    return {
      u: samples.map(({u}) => u),
      right: pairs.map(pair => pair[0]),
      left: pairs.map(pair => pair[1]),
      which: nearest(elbowsAt(arm, middle), byRoot(arm, middle, k)),
    };
  });
}
