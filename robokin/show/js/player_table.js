// The table of a player: the greatest speeds and accelerations of a motion.

import {number} from "./canvas.js";
import {element} from "./elements.js";

/** @import {Page, PageArm} from "./page.js" */

/**
 * @param {Page} data
 * @param {(arm: PageArm) => string} whose
 * @param {number} motion
 */
export function numberTable(data, whose, motion) {
  const most = Math.max(...data.arms.map(arm => arm.chain.length));
  const head = element(
    "tr",
    {},
    element("th", {scope: "col"}, data.sampled),
    ...Array.from({length: most}, (_, j) => element("th", {scope: "col"}, `joint ${j + 1}`)),
  );
  const body = data.arms.flatMap(arm => lines(data, arm, whose(arm), motion));
  return element("table", {}, element("thead", {}, head), element("tbody", {}, ...body));
}

/**
 * The table rows for an arm.
 * @param {Page} data
 * @param {PageArm} arm
 * @param {string} whose
 * @param {number} motion
 */
function lines({unit, decimals}, arm, whose, motion) {
  const units = [...new Set(arm.chain.map(link => (link.prismatic ? unit.name : "\u00B0")))];
  /**
   * @param {string} name
   * @param {string} time
   * @param {boolean} limited
   * @param {(j: number) => HTMLElement} cell
   */
  const line = (name, time, limited, cell) => {
    const per = units.map(u => `${u}/${time}`).join(" or "),
      text = `${whose}${name}, ${per}${limited ? " (of limit)" : ""}`;
    const cells = arm.chain.map((_, j) => cell(j));
    return element("tr", {}, element("th", {scope: "row"}, text), ...cells);
  };
  return [
    line("greatest speed", "s", !!arm.share, j => {
      const share = arm.share ? ` (${arm.share[motion][j]}\u00A0%)` : "";
      return element("td", {}, number(arm.speed[motion][j], decimals[0]) + share);
    }),
    line("greatest acceleration", "s\u00B2", false, j => {
      const most = arm.acceleration[motion][j];
      return typeof most === "string"
        ? element("td", {class: "rk-jump"}, most)
        : element("td", {}, number(most, decimals[1]));
    }),
  ];
}
