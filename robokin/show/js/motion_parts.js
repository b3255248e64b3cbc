// The common parts of both views of a blended motion: its state, clock, curves, sliders and
// sentences.

import {fill, plain} from "./blanks.js";
import {motions} from "./blended.js";
import {number} from "./canvas.js";
import {clockRow, runningClock} from "./clock.js";
import {scrubbing} from "./controls.js";
import {copyButton} from "./copy.js";
import {curvesView} from "./curves.js";
import {element} from "./elements.js";
import {exists, nowhere} from "./rows.js";
import {menu, slider} from "./stage.js";
import {lengths} from "./turns.js";

/** @import {MotionPage, PagePose, StartValues} from "./page.js" */
/** @import {Motion} from "./blended.js" */
/** @import {Point} from "./canvas.js" */
/** @import {CurvesView} from "./curves.js" */
/** @import {Shown} from "./scene.js" */
/** @import {Stage} from "./stage.js" */
/** @import {STATIONS} from "./station_handles.js" */

/** @typedef {Record<(typeof STATIONS)[number], PagePose>} Stations */
/** @typedef {Stations & StartValues} Asked */
/** @typedef {Asked & {time: number, playing: boolean}} State  `time` in seconds */
/** @typedef {Omit<Stage, "scene" | "name" | "run">} Frame  the frame of either view */
/** @typedef {Parameters<CurvesView["draw"]>} Drawn  what the canvas of the curves shows */

const NUMBERS = /** @type {const} */ (["blend", "duration"]);
const CHOICES = /** @type {const} */ (["law", "corner", "row"]);

/**
 * Puts the clock next to the title and the curves into the column at the side.
 * @template Found
 * @param {Frame} stage
 * @param {MotionPage} data
 * @param {(motion: Motion) => ?Found} search
 * @param {...HTMLElement} more  other controls in the row of the clock
 */
export function motionParts(stage, data, search, ...more) {
  const {words, start, via, goal} = data;
  /** @type {State} */
  const state = {
    ...structuredClone({start, via, goal}),
    ...data.start_values,
    time: 0,
    playing: false,
  };
  const canvas = element("canvas", {class: "rk-curves", role: "img", "aria-label": words.curves}),
    curves = curvesView(canvas, data.dashes),
    parts = clockRow();
  parts.row.append(...more);
  stage.title.replaceWith(
    element("div", {class: "rk-head"}, stage.title.cloneNode(true), parts.row),
  );
  stage.side.append(canvas);
  const clock = runningClock(parts, stage.frame, state, () => [0, state.duration], stage.changed);
  scrubbing(canvas, event => clock.set(curves.timeAt(event.offsetX)));
  return {
    state,
    canvas,
    curves,
    clock,
    inputs: inputsOf(stage, data, state),
    copy: copyButton(words, () => inCode(data, state)),
    held: holding(stage),
    motion: motions(data, state, search, stage.changed),
    /** The sample that the clock shows. */
    sample: () => Math.round((state.time / state.duration) * (data.samples - 1)),
  };
}

/**
 * The sliders and menus of a motion. In a close-up, the stations cannot be moved.
 * @param {Frame} stage
 * @param {MotionPage} data
 * @param {State} state
 */
function inputsOf(stage, {words, unit, controls, laws, corners, branches, close_up}, state) {
  const stations = controls.length - NUMBERS.length;
  const sliders = controls.map((spec, k) =>
    slider(spec, value => {
      if (k < stations) state.via.place[k] = value * unit.size;
      else {
        const share = state.time / state.duration;
        state[NUMBERS[k - stations]] = Math.min(Math.max(value, spec.low), spec.high);
        state.time = share * state.duration;
      }
      stage.changed();
    }),
  );
  const texts = {law: laws, corner: corners, row: branches},
    names = {law: words.law, corner: words.corner, row: words.branch};
  const menus = CHOICES.filter(each => !close_up || each === "corner").map(each => {
    const made = menu(names[each], texts[each], k => {
      state[each] = k;
      stage.changed();
    });
    return {...made, each};
  });
  return {
    rows: [...sliders, ...menus].map(each => each.row),
    tell() {
      const {via} = state;
      sliders.forEach((s, k) =>
        s.set(k < stations ? via.place[k] / unit.size : state[NUMBERS[k - stations]]),
      );
      for (const {set, each} of menus) set(state[each]);
    },
  };
}

/**
 * Returns a function that says whether the reader is dragging something. During a drag, only the
 * samples are searched for the greatest values, since a search between them takes too long.
 * @param {Frame} stage
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
 * The arm at sample i. If there is no posture, the last posture before i is shown faded.
 * @param {MotionPage} data
 * @param {Motion} motion
 * @param {number} i
 * @returns {Shown}
 */
export const armAt = ({arm}, {q, missing, tool}, i) => ({
  name: arm.name,
  chain: arm.chain,
  q: q.slice(0, i + 1).findLast(exists) ?? nowhere(arm.chain.length),
  faded: missing[i],
  trace: tool,
  tail: tool.slice(0, i + 1),
});

/**
 * The flaws of the motion, as sentences.
 * @param {MotionPage} data
 * @param {Motion} motion
 */
export function notes({arm, words, units}, {q, v, missing, jumps}) {
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
 * @param {MotionPage} data
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
