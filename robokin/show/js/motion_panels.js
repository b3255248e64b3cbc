// The curves of a blended motion.

import {scale} from "./ticks.js";

/** @import {Motion} from "./blended.js" */
/** @import {MotionPage} from "./page.js" */
/** @import {Line, Panel} from "./panel.js" */

/**
 * A panel of curves: joint values (order 0), speeds or accelerations. Its scale has room for the
 * opening motion.
 * @param {MotionPage} data
 * @param {Motion} motion
 * @param {number[][]} rows
 * @param {number} order
 * @param {number} now  a sample
 * @param {?{rows: number[][], gaps: Set<number>}} [opening]  the opening motion, if it is shown
 * @returns {Panel}
 */
export function panelOf({arm, panels, units}, {gaps, jumps}, rows, order, now, opening = null) {
  /** @type {(rows: number[][]) => Float64Array[]} */
  const shown = rows => units.map((u, j) => Float64Array.from(rows.map(row => row[j] / u.size)));
  const curves = shown(rows),
    before = opening && shown(opening.rows);
  const kinds = [false, true].filter(shifts => arm.prismatic.includes(shifts));
  const axes = kinds
    .map(shifts => units.flatMap((_, j) => (arm.prismatic[j] === shifts ? [j] : [])))
    .map(joints => {
      const [low, high] = ends(
        joints.flatMap(j => (before ? [curves[j], before[j]] : [curves[j]])),
      );
      return {
        unit: units[joints[0]].name + ["", "/s", "/s\u00B2"][order],
        scale: scale(low, high),
      };
    });
  /** @type {Line[]} */
  const lines = curves.map((values, j) => {
    const [low, high] = arm.limits[j].map(x => x / units[j].size);
    return {
      values,
      opening: opening && before && {values: before[j], gaps: opening.gaps},
      joint: j,
      arm: 0,
      axis: kinds.indexOf(arm.prismatic[j]),
      faint: false,
      gaps,
      limits: order === 0 ? [low, high] : null,
      now: values[now],
    };
  });
  const near = lines.flatMap(({limits, values}, k) => (limits ? nearOf(limits, values, k) : []));
  const marks = order > 0 ? jumps.map(({time}) => ({time, text: ""})) : [];
  return {label: `${panels[order]}, ${axes[0].unit}`, axes, lines, near, marks};
}

/**
 * The limits that a curve exceeds or comes near to.
 * @param {[number, number]} limits
 * @param {Float64Array} values
 * @param {number} line
 * @returns {Panel["near"]}
 */
function nearOf(limits, values, line) {
  const room = 0.03 * (limits[1] - limits[0]);
  return [0, 1]
    .filter(side => values.some(x => (side ? 1 : -1) * (x - limits[side]) > -room))
    .map(side => [line, side]);
}

/** The least and greatest values of the curves. @param {Float64Array[]} curves */
function ends(curves) {
  let [low, high] = [Infinity, -Infinity];
  for (const curve of curves)
    for (const x of curve)
      if (!Number.isNaN(x)) [low, high] = [Math.min(low, x), Math.max(high, x)];
  return low > high ? [0, 0] : [low, high];
}
