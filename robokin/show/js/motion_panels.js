// The curves of a blended motion.

import {scale} from "./ticks.js";

/** @import {Motion} from "./blended.js" */
/** @import {MotionData} from "./motion_explorer.js" */
/** @import {Panel} from "./panel.js" */

/**
 * A panel of curves: joint values (order 0), speeds or accelerations.
 * @param {MotionData} data
 * @param {Motion} motion
 * @param {number[][]} rows
 * @param {number} order
 * @returns {Panel}
 */
export function panelOf({arm, panels, units}, {gaps, jumps}, rows, order) {
  const curves = units.map((u, j) => Float64Array.from(rows, row => row[j] / u.size));
  const axes = [false, true]
    .map(shifts => units.flatMap((_, j) => (arm.prismatic[j] === shifts ? [j] : [])))
    .filter(joints => joints.length)
    .map(joints => {
      const [low, high] = ends(joints.map(j => curves[j]));
      return {
        joints,
        unit: units[joints[0]].name + ["", "/s", "/s\u00B2"][order],
        scale: scale(low, high),
      };
    });
  const limits =
    order === 0
      ? [0, 1].map(side => arm.limits.map((pair, j) => pair[side] / units[j].size))
      : null;
  const near = limits
    ? curves.flatMap((curve, j) =>
        [0, 1]
          .filter(side => {
            const sign = side ? 1 : -1,
              room = 0.03 * (limits[1][j] - limits[0][j]);
            return curve.some(x => sign * (x - limits[side][j]) > -room);
          })
          .map(side => [j, side]),
      )
    : [];
  const marks = order > 0 ? jumps.map(({time}) => ({time, text: ""})) : [];
  return {
    label: `${panels[order]}, ${axes[0].unit}`,
    axes,
    curves,
    gaps,
    limits,
    near,
    marks,
    now: [],
  };
}

/** The least and greatest value of some curves. @param {Float64Array[]} curves */
function ends(curves) {
  let [low, high] = [Infinity, -Infinity];
  for (const curve of curves)
    for (const x of curve)
      if (!Number.isNaN(x)) [low, high] = [Math.min(low, x), Math.max(high, x)];
  return low > high ? [0, 0] : [low, high];
}
