// The picture of the crossing explorer: the tracks of both elbows, and the band of the formula with
// its jump. Both tracks are on the circle of radius l1 around the base; the track of the right
// elbow is drawn a little outside it, and that of the left elbow a little inside it.

import {fill} from "./blanks.js";
import {clear, colors, spot, stroke} from "./canvas.js";
import {movedTo} from "./crossing.js";
import {singularities} from "./geometries.js";
import {distance, plus} from "./kinematics.js";
import {point} from "./mark.js";
import {once} from "./once.js";
import {distance2} from "./rows.js";

/** @import {Box, Context, Pixel, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {CrossingExplorer, Found, State} from "./crossing_explorer.js" */

const SHORT = 0.01; // times the reach: a shorter jump has no label, and a smaller hole no rim
const RAIL = 6; // px: the distance of a drawn track from the circle

/**
 * The elbows and the tip with their names.
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 */
export function named({rows, words, arm}, {tip}, {rows: q, elbows, which, based}) {
  const one = q.length && singularities(arm, q[0]).elbow;
  const names = elbows.map((_, k) =>
    k === which ? fill(words.returned, {elbow: rows[k]}) : rows[k],
  );
  return [
    ...(one
      ? [point(based ? words.any : words.both, elbows[0])]
      : elbows.map((at, k) => point(names[k], at))),
    point(words.take, tip),
  ];
}

/**
 * The arm with the elbow that the formula returns. The other elbow is drawn faintly.
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 */
export function posed(data, state, found) {
  const {arm, divisor, words} = data,
    {rows, which} = found,
    chosen = divisor === null ? 0 : which;
  return {
    name: arm.name,
    chain: arm.chain,
    q: rows[chosen] ?? [NaN, NaN],
    faded: !rows.length,
    ghosts: rows.filter((_, k) => k !== chosen).map(q => ({q, past: false})),
    /** @type {(g: Context, cam: Camera) => void} */
    under: (g, cam) => drawTracks(g, cam, data, state, found),
    labels: [
      ...jumpOf(data, state, found),
      ...rimsOf(data).map(r => ({text: told(data, r), at: below(data, r)})),
      ...(divisor === null ? [] : [{text: fill(words.line, lineOf(data)), at: zeroLine(data)[0]}]),
    ].map(label => ({color: colors.soft, weight: "", ...label})),
    /** @type {(g: Context, cam: Camera) => void} */
    over: (g, cam) => drawMarks(g, cam, found),
  };
}

/**
 * The length of the jump, at the red dashes and apart from the line through the tip; nothing if
 * there is no jump.
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 */
function jumpOf(data, {tip}, {crossing: [from, to]}) {
  const {arm, divisor} = data,
    {reach} = arm.geometry,
    jump = from ? distance(from, to) : 0;
  if (jump < SHORT * reach) return [];
  const along = [0.5, 0.4, 0.6, 0.3, 0.7].map(share => plus(from, plus(to, from, -1), share)),
    apart = Array.from({length: 81}, (_, i) =>
      movedTo(arm, tip, divisor ?? 0, (i / 40 - 1) * reach),
    );
  return [{text: told(data, jump), at: along[0], along, apart, color: colors.alarm}];
}

/**
 * The radii of the rims of the reach: the outer one and, if there is a hole, the inner one.
 * @param {CrossingExplorer} data
 */
function rimsOf({arm}) {
  const {reach, l1, l2} = arm.geometry,
    inner = Math.abs(l1 - l2);
  return inner > SHORT * reach ? [reach, inner] : [reach];
}

/**
 * A length with its unit.
 * @param {CrossingExplorer} data
 * @param {number} length
 */
const told = ({unit}, length) => `${+(length / unit.size).toFixed(3)} ${unit.name}`;

/**
 * A point of a rim, below the base and to its left.
 * @param {CrossingExplorer} data
 * @param {number} r
 */
const below = ({arm: {geometry}}, r) => [geometry.base[0] - 0.6 * r, geometry.base[1] - 0.8 * r, 0];

/**
 * The name and the value of the coordinate of the tip at which the formula divides by 0.
 * @param {CrossingExplorer} data
 */
export const lineOf = ({arm, divisor, controls, unit}) => ({
  letter: controls[divisor ?? 0].name,
  value: String(+(arm.geometry.base[divisor ?? 0] / unit.size).toFixed(3)).replace("-", "\u2212"),
});

/**
 * Both ends of the line on which the formula divides by 0.
 * @param {CrossingExplorer} data
 */
function zeroLine({arm, divisor}) {
  const {base, reach} = arm.geometry,
    k = divisor ?? 0;
  return [1.05, -1.05].map(share => {
    const at = [...base, 0];
    at[1 - k] += share * reach;
    return at;
  });
}

/**
 * Draws the line through the tip, the tracks, the band of the formula and its jump.
 * @param {Context} g
 * @param {Camera} cam
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 */
function drawTracks(g, {to}, data, {tip}, {tracks, crossing}) {
  const {arm, divisor} = data,
    {base, reach} = arm.geometry,
    k = divisor ?? 0;
  for (const r of rimsOf(data)) {
    const rim = Array.from({length: 121}, (_, i) => {
      const turn = (i * Math.PI) / 60;
      return to([base[0] + r * Math.cos(turn), base[1] + r * Math.sin(turn), 0]);
    });
    stroke(g, rim, colors.rim, 1);
  }
  const line = [-reach, reach].map(u => to(movedTo(arm, tip, k, u)));
  stroke(g, line, colors.soft, 1.4, [1.5, 4]);
  if (divisor !== null) stroke(g, zeroLine(data).map(to), colors.soft, 1.2);
  /** @type {(points: Point[], side: number) => Pixel[]} */
  const rail = (points, side) => points.map(at => aside(to(at), to([...base, 0]), side * RAIL));
  for (const {right, left, which} of tracks) {
    const formula = divisor === null ? [] : [rail(right, 1), rail(left, -1)][which];
    stroke(g, formula, clear(colors.ghost, 0.35), 11);
    stroke(g, rail(right, 1), colors.accent, 2.2);
    stroke(g, once(rail(left, -1)), colors.near, 2.2, [7, 4]);
  }
  if (crossing.length) stroke(g, crossing.map(to), colors.alarm, 2.4, [5, 5]);
}

/**
 * Moves a pixel away from another one by `by`.
 * @param {Pixel} at
 * @param {Pixel} from
 * @param {number} by
 * @returns {Pixel}
 */
function aside([x, y], [x0, y0], by) {
  const share = 1 + by / distance2(x - x0, y - y0);
  return [x0 + share * (x - x0), y0 + share * (y - y0)];
}

/**
 * Draws the places where the elbows meet, and the elbow that the formula returns.
 * @param {Context} g
 * @param {Camera} cam
 * @param {Found} found
 */
function drawMarks(g, cam, {meets, formula}) {
  for (const {at} of meets) spot(g, cam.to(at), 5, colors.paper, colors.ink, 1.6);
  if (formula) spot(g, cam.to(formula), 6, colors.ink);
}
