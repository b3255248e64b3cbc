// The motion explorer: a blended motion with stations to drag. All text and the arm data come from
// Python (page.py: MotionPage).

import {fill} from "./blanks.js";
import {most, motionOf, nearDecimals, topsOf} from "./blended.js";
import {number} from "./canvas.js";
import {clockRow, runningClock} from "./clock.js";
import {scrubbing} from "./controls.js";
import {copyButton} from "./copy.js";
import {curvesView} from "./curves.js";
import {choice, element, waiting} from "./elements.js";
import {matrix} from "./kinematics.js";
import {panelOf} from "./motion_panels.js";
import {decimalsOf} from "./peaks.js";
import {exists, nowhere} from "./rows.js";
import {menu, slider, stageOf} from "./stage.js";
import {table} from "./table.js";
import {STATIONS, stationHandles} from "./station_handles.js";
import {scale} from "./ticks.js";
import {lengths, plain} from "./turns.js";
import {frame} from "./target.js";

/** @import {MotionPage, PagePose, StartValues} from "./page.js" */
/** @import {Motion} from "./blended.js" */
/** @import {CurvesView} from "./curves.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {MotionPage} MotionData */
/** @typedef {Record<(typeof STATIONS)[number], PagePose>} Stations */
/** @typedef {Stations & StartValues} Asked */
/** @typedef {Asked & {time: number, playing: boolean}} State  `time` in seconds */
/**
 * The greatest speeds and accelerations of a motion. If `sure`, they include those between the
 * samples.
 * @typedef {{sure: boolean, values: number[][]}} Tops
 */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {MotionData} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => motionExplorer(stageOf(root, data), data));

const NUMBERS = /** @type {const} */ (["blend", "duration"]);
const CHOICES = /** @type {const} */ (["law", "corner", "row"]);

/**
 * @param {Stage} stage
 * @param {MotionData} data
 */
function motionExplorer(stage, data) {
  const {arm, words} = data,
    stations = structuredClone({start: data.start, via: data.via, goal: data.goal});
  /** @type {State} */
  const state = {...stations, ...data.start_values, time: 0, playing: false};
  const canvas = element("canvas", {class: "rk-curves", role: "img", "aria-label": words.curves}),
    curves = curvesView(canvas, data.dashes);
  const parts = clockRow(),
    watch = choice("large panel", data.panels);
  parts.row.append(element("label", {}, "watch", watch));
  stage.title.replaceWith(
    element("div", {class: "rk-head"}, stage.title.cloneNode(true), parts.row),
  );
  const clock = runningClock(parts, stage.frame, state, () => [0, state.duration], stage.changed);
  const inputs = inputsOf(stage, data, state),
    numbers = numberTable(data),
    copy = copyButton(words, () => inCode(data, state));
  stage.side.append(canvas);
  stage.below.append(
    element("div", {class: "rk-columns"}, ...inputs.rows),
    numbers.node,
    element("div", {class: "rk-row"}, element("div", {}, stage.says, stage.hint), copy),
  );
  scrubbing(canvas, event => clock.set(curves.timeAt(event.offsetX)));
  watch.addEventListener("change", stage.changed);
  stage.handles.set(stationHandles(stage, state, data));
  const held = holding(stage),
    motion = motions(data, state);
  /** @type {?Parameters<CurvesView["draw"]>} */
  let drawn = null;
  stage.run(
    now => {
      clock.pass(now);
      const found = motion.now(),
        {t, q, v, a} = found,
        i = Math.round((state.time / state.duration) * (data.samples - 1));
      inputs.tell();
      clock.tell();
      const panels = [q, v, a].map((rows, order) => panelOf(data, found, rows, order, i));
      const ticks = scale(0, state.duration);
      drawn = [{panels, large: +watch.value, names: []}, t, ticks, state.time];
      numbers.tell(motion.tops(held()));
      stage.say([nearWords(data, found.near), ...notes(data, found)].join(" "));
      stage.scene.things = STATIONS.map(name => frame(name, poseOf(state[name])));
      return [armAt(data, found, i)];
    },
    [canvas],
    () => drawn && curves.draw(...drawn),
  );
}

/**
 * The sliders and menus of a motion.
 * @param {Stage} stage
 * @param {MotionData} data
 * @param {State} state
 */
function inputsOf(stage, {words, unit, controls, laws, corners, branches}, state) {
  const sliders = controls.map((spec, k) =>
    slider(spec, value => {
      if (k < 3) state.via.place[k] = value * unit.size;
      else {
        const share = state.time / state.duration;
        state[NUMBERS[k - 3]] = Math.min(Math.max(value, spec.low), spec.high);
        state.time = share * state.duration;
      }
      stage.changed();
    }),
  );
  const texts = [laws, corners, branches];
  const menus = [words.law, words.corner, words.branch].map((name, m) =>
    menu(name, texts[m], k => {
      state[CHOICES[m]] = k;
      stage.changed();
    }),
  );
  return {
    rows: [...sliders, ...menus].map(each => each.row),
    tell() {
      const {via} = state;
      sliders.forEach((s, k) => s.set(k < 3 ? via.place[k] / unit.size : state[NUMBERS[k - 3]]));
      menus.forEach((m, k) => m.set(state[CHOICES[k]]));
    },
  };
}

/**
 * Returns a function that says whether the reader is dragging something. During a drag, only the
 * samples count, since values between them take too long to compute.
 * @param {Stage} stage
 */
function holding(stage) {
  let held = false;
  /** @type {(on: boolean) => void} */
  const hold = on => {
    held = on;
    stage.changed();
  };
  const {layer} = stage.handles;
  layer.addEventListener("pointerdown", () => hold(true));
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    layer.addEventListener(end, () => hold(false));
  stage.below.addEventListener("input", ({target}) =>
    hold(/** @type {HTMLInputElement} */ (target).type === "range"),
  );
  stage.below.addEventListener("change", () => hold(false));
  return () => held;
}

/**
 * `now()` returns the motion for the current settings, and computes it again if they have changed.
 * `tops(held)` returns its greatest speeds and accelerations.
 * @param {MotionData} data
 * @param {State} state
 */
function motions(data, state) {
  let known = "";
  /** @type {?Motion} */
  let found = null;
  /** @type {?number[][]} */
  let refined = null;
  const now = () => {
    const {time, playing, ...asked} = state, // the clock alone does not change the motion
      key = JSON.stringify(asked);
    if (!found || key !== known) [known, found, refined] = [key, motionOf(data, state), null];
    return found;
  };
  return {
    now,
    /** @type {(held: boolean) => Tops} */
    tops(held) {
      const motion = now(),
        {v, a} = motion,
        sampled = [v, a].map(rows => data.units.map(({size}, j) => most(rows, j) / size));
      if (!held) refined ??= topsOf(data, motion, sampled);
      return {sure: refined !== null, values: refined ?? sampled};
    },
  };
}

/**
 * The table of the greatest speeds and accelerations.
 * @param {MotionData} data
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
    /** @param {Tops} tops */
    tell({sure, values}) {
      names.forEach((what, k) => {
        heads[k].textContent = sure ? what : fill(words.sampled, {what, samples});
      });
      rows.set(values.map((row, order) => row.map((value, j) => cell(order, value, j))));
    },
  };
}

/** @type {(pose: PagePose) => number[]} */
const poseOf = ({rotation, angle = 0, place}) =>
  matrix(rotation || [Math.cos(angle / 2), 0, 0, Math.sin(angle / 2)], place);

/**
 * The arm at sample i. If there is no posture, the last posture before i is shown faded.
 * @param {MotionData} data
 * @param {Motion} motion
 * @param {number} i
 */
const armAt = ({arm}, {q, missing, tool}, i) => ({
  name: arm.name,
  chain: arm.chain,
  q: q.slice(0, i + 1).findLast(exists) ?? nowhere(arm.chain.length),
  faded: missing[i],
  trace: tool,
  tail: tool.slice(0, i + 1),
});

/**
 * @param {MotionData} data
 * @param {number} distance
 */
const nearWords = ({words, unit}, distance) =>
  Number.isFinite(distance)
    ? fill(words.near, {distance: number(distance, nearDecimals(unit))})
    : "";

/**
 * The flaws of the motion, as sentences.
 * @param {MotionData} data
 * @param {Motion} motion
 */
function notes({arm, words, units}, {q, v, missing, jumps}) {
  /** @type {string[]} */
  const said = [];
  const none = missing.filter(Boolean).length,
    fastest = arm.speed_limits;
  if (none) said.push(fill(words.missingSamples, {none, all: q.length}));
  units.forEach((_, j) => {
    const [low, high] = arm.limits[j],
      slack = arm.tolerances.SLACK;
    const past = q.filter(row => row[j] < low - slack || row[j] > high + slack).length;
    if (past) said.push(fill(words.pastSamples, {joint: j + 1, past, all: q.length}));
    const fast = fastest ? v.filter(row => Math.abs(row[j]) > fastest[j] * (1 + 1e-9)).length : 0;
    if (fast) said.push(fill(words.fastSamples, {joint: j + 1, past: fast, all: q.length}));
  });
  for (const {time} of jumps) said.push(fill(words.jump, {time: number(time, 2)}));
  return said;
}

/**
 * The Python code that makes the same motion.
 * @param {MotionData} data
 * @param {Asked} state
 */
function inCode(data, state) {
  const {unit, code, laws, corners} = data;
  /** @type {(place: Point) => string} */
  const numbers = place =>
    lengths(place, unit)
      .map(x => `${x} * ${unit.code}`)
      .join(", ");
  return fill(code, {
    start: numbers(state.start.place),
    via: numbers(state.via.place),
    goal: numbers(state.goal.place),
    law: laws[state.law],
    duration: state.duration,
    blend: plain(state.blend, 3),
    corner: corners[state.corner],
    row: state.row,
  });
}
