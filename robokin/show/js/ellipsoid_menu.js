// The menu for the ellipsoid of tool velocities, and the ellipsoid that is selected in it.

import {ellipsoid} from "./dexterity.js";
import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {menu} from "./stage.js";

/** @import {ArmData, ArmPage} from "./page.js" */

/**
 * A menu with three options: no ellipsoid, the tool may turn, or its orientation is held.
 * @param {ArmPage} data
 * @param {() => void} changed
 */
export function ellipsoidMenu({arm, words, unit}, changed) {
  let chosen = 0;
  const {row} = menu(words.ellipsoid, [words.off, words.free, words.held], k => {
    chosen = k;
    changed();
  });
  return {
    row,
    /**
     * The semi-axes to draw, and their lengths as text. In the picture, the ellipsoid of a tool
     * that may turn has the same size in every posture. The ellipsoid of a tool whose orientation
     * is held is drawn to the same scale.
     * @param {number[]} q
     */
    at(q) {
      if (!chosen) return {ellipsoid: undefined, speeds: ""};
      const axes = ellipsoid(arm, q, chosen === 2),
        [longest] = ellipsoid(arm, q, false).map(norm);
      const values = axes.map(axis => number(norm(axis) / unit.size, unit.size < 1 ? 0 : 3));
      return {
        ellipsoid: axes.map(axis => axis.map(x => (x * 0.25 * arm.reach) / (longest || 1))),
        speeds: ` ${fill(words.speeds, {values: values.join(", "), unit: unit.name})}`,
      };
    },
  };
}

/** @param {number[]} v */
const norm = v => Math.sqrt(v.reduce((sum, x) => sum + x * x, 0));
