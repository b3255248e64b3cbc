// The motion explorer: a blended motion with stations to drag, or a close-up of its corner. All
// text and the arm data come from Python (explorer_page.py: MotionPage).

import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {cornerExplorer} from "./corner_explorer.js";
import {choice, element, waiting} from "./elements.js";
import {matrix} from "./kinematics.js";
import {panelOf} from "./motion_panels.js";
import {armAt, motionParts, notes} from "./motion_parts.js";
import {decimalsOf} from "./peaks.js";
import {stageOf} from "./stage.js";
import {table} from "./table.js";
import {STATIONS, stationHandles} from "./station_handles.js";
import {scale} from "./ticks.js";
import {frame} from "./target.js";

/** @import {MotionPage, PagePose} from "./page.js" */
/** @import {Motion, Tops} from "./blended.js" */
/** @import {Drawn} from "./motion_parts.js" */
/** @import {Stage} from "./stage.js" */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {MotionPage} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => {
    if (data.close_up) cornerExplorer(root, data);
    else motionExplorer(stageOf(root, data), data);
  });

/**
 * @param {Stage} stage
 * @param {MotionPage} data
 */
function motionExplorer(stage, data) {
  const watch = choice("large panel", data.panels),
    parts = motionParts(stage, data, element("label", {}, "watch", watch)),
    {state, canvas, clock, inputs, motion} = parts,
    numbers = numberTable(data);
  stage.below.append(
    element("div", {class: "rk-columns"}, ...inputs.rows),
    numbers.node,
    element("div", {class: "rk-row"}, element("div", {}, stage.says, stage.hint), parts.copy),
  );
  watch.addEventListener("change", stage.changed);
  stage.handles.set(stationHandles(stage, state, data));
  /** @type {?Drawn} */
  let drawn = null;
  stage.run(
    now => {
      clock.pass(now);
      const found = motion.now(),
        {t, q, v, a, near} = found,
        i = parts.sample();
      inputs.tell();
      clock.tell();
      const panels = [q, v, a].map((rows, order) => panelOf(data, found, rows, order, i));
      const ticks = scale(0, state.duration);
      drawn = [{panels, large: +watch.value, names: []}, t, ticks, state.time];
      numbers.tell(motion.tops(parts.held()), found);
      const passes = near ? [fill(data.words.near, {distance: near.text})] : [];
      stage.say([...passes, ...notes(data, found)].join(" "));
      stage.scene.things = STATIONS.map(name => frame(name, poseOf(state[name])));
      return [armAt(data, found, i)];
    },
    [canvas],
    () => drawn && parts.curves.draw(...drawn),
  );
}

/**
 * The table of the greatest speeds and accelerations.
 * @param {MotionPage} data
 */
function numberTable({arm, words, units, samples}) {
  const names = [words.speed, words.acceleration];
  const rows = table(
    names,
    ["", ...units.map(({name}, j) => `q${j + 1} ${name}`)],
    units.map(() => 1),
  );
  const heads = rows.node.querySelectorAll("tbody th");
  /** @type {(order: number, value: number, j: number) => string} */
  const cell = (order, value, j) => {
    if (Number.isNaN(value)) return words.none;
    const text = number(value, decimalsOf(value));
    if (order > 0 || !arm.speed_limits) return text;
    return `${text} (${Math.round((100 * value * units[j].size) / arm.speed_limits[j])}\u00A0%)`;
  };
  return {
    node: rows.node,
    /**
     * Where the speed of a joint jumps, it has no finite acceleration.
     * @param {Tops} tops
     * @param {Motion} motion
     */
    tell({sure, values}, {jumps}) {
      const jump = units.map((_, j) => jumps.some(({joints}) => joints[j]));
      names.forEach((what, k) => {
        heads[k].textContent = sure ? what : fill(words.sampled, {what, samples});
      });
      rows.set(
        values.map((row, order) =>
          row.map((value, j) => cell(order, order > 0 && jump[j] ? NaN : value, j)),
        ),
      );
    },
  };
}

/** @type {(pose: PagePose) => number[]} */
const poseOf = ({rotation, angle = 0, place}) =>
  matrix(rotation || [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)], place);
