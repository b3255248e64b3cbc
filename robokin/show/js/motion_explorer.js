// The motion explorer: a blended motion with stations to drag, or a close-up of its corner. All
// text and the arm data come from Python (explorer_page.py: MotionPage).

import {fill} from "./blanks.js";
import {most, topsOf} from "./blended.js";
import {number} from "./canvas.js";
import {cornerExplorer} from "./corner_explorer.js";
import {choice, element, waiting} from "./elements.js";
import {panelOf} from "./motion_panels.js";
import {armAt, motionParts, notes} from "./motion_parts.js";
import {decimalsOf} from "./peaks.js";
import {matrix} from "./rotations.js";
import {stageOf} from "./stage.js";
import {table} from "./table.js";
import {STATIONS, stationHandles} from "./station_handles.js";
import {scale} from "./ticks.js";
import {frame} from "./target.js";

/** @import {MotionPage, PagePose} from "./page.js" */
/** @import {Motion} from "./blended.js" */
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
    watched = element("label", {}, "watch", watch),
    parts = motionParts(stage, data, found => greatest(data, found), watched),
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
      numbers.tell(motion.searched(parts.held()), found);
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
 * The greatest speeds and accelerations at the samples.
 * @type {(data: MotionPage, motion: Motion) => number[][]}
 */
const sampled = ({units}, {v, a}) =>
  [v, a].map(rows => units.map(({size}, j) => most(rows, j) / size));

/**
 * The greatest speeds and accelerations, including those between the samples; null if they are
 * uncertain.
 * @param {MotionPage} data
 * @param {Motion} motion
 */
function greatest(data, motion) {
  const quantities = sampled(data, motion).flatMap((values, order) =>
    values.map((about, j) => ({
      of: /** @param {number[][]} slopes */ slopes =>
        Math.abs(slopes[order][j]) / data.units[j].size,
      about,
    })),
  );
  const tops = topsOf(data, motion, quantities)?.map(({value}) => value),
    joints = data.units.length;
  return tops ? [tops.slice(0, joints), tops.slice(joints)] : null;
}

/**
 * The table of the greatest speeds and accelerations.
 * @param {MotionPage} data
 */
function numberTable(data) {
  const {arm, words, units, samples} = data;
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
     * @param {?number[][]} tops
     * @param {Motion} motion
     */
    tell(tops, motion) {
      const {jumps} = motion,
        jump = units.map((_, j) => jumps.some(({joints}) => joints[j]));
      names.forEach((what, k) => {
        heads[k].textContent = tops ? what : fill(words.sampled, {what, samples});
      });
      rows.set(
        (tops ?? sampled(data, motion)).map((row, order) =>
          row.map((value, j) => cell(order, order > 0 && jump[j] ? NaN : value, j)),
        ),
      );
    },
  };
}

/** @type {(pose: PagePose) => number[]} */
const poseOf = ({rotation, angle = 0, place}) =>
  matrix(rotation || [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)], place);
