// The explorer of plans: the reader drags start, target and obstacle, a kernel plans (live.js), and
// the answer is drawn in the plane and in the cube of postures. The text comes from Python
// (plan_explorer.py).

import {fill} from "./blanks.js";
import {copyButton} from "./copy.js";
import {control, element, waiting} from "./elements.js";
import {letterHandle} from "./letters.js";
import {fk, origin} from "./kinematics.js";
import {least} from "./levers.js";
import {kernelOf, joinArrays} from "./live.js";
import {cubeView, facesOf} from "./plan_cube.js";
import {armAt} from "./plan_picture.js";
import {range} from "./sliders.js";
import {menu, slider, stageOf, tick} from "./stage.js";
import {point} from "./mark.js";

/** @import {PlanPage, With} from "./page.js" */
/** @import {Color, Point} from "./canvas.js" */
/** @import {Handle} from "./handles.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Values} from "./live.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {With<PlanPage, "question" | "first"> & {arm: ThreeLeverArm}} PlanExplorer */
/**
 * A question. `way` is the index in `branches`; `sides` says whether to show the quadrilaterals,
 * too.
 * @typedef {object} Question
 * @property {number[]} posture
 * @property {number[]} target  x, y
 * @property {number[]} obstacle  x, y
 * @property {number} distance
 * @property {number} way
 * @property {boolean} sides
 */
/**
 * Python's answer: see `_answer` in plan_explorer.py.
 * @typedef {object} Answer
 * @property {string} result
 * @property {string} words
 * @property {boolean} kept
 * @property {Values} moments
 * @property {number[][]} via
 * @property {[place: number[], text: string]} nearest
 * @property {?{quadrilaterals: number[][][], says: string}} direct
 * @property {Values} cube
 * @property {number} most
 * @property {Values} curve
 */
/** @typedef {ReturnType<typeof read>} Shown  an answer as it is drawn */
/** @typedef {{q: number[], target: Point, obstacle: Point, distance: number, way: number}} State */
/**
 * The state shown: the step of the search and the time in the motion.
 * @typedef {object} Now
 * @property {Shown} shown
 * @property {number} wave
 * @property {number} moment
 * @property {boolean} playing
 * @property {number} before  time of the last step, ms
 */

const SEARCH = 5, // seconds: a search from its first step to its last
  MOMENTS = 16; // moments of the motion per second

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {PlanExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => planExplorer(stageOf(root, data), root, id, data));

/**
 * @param {Stage} stage
 * @param {HTMLElement} root
 * @param {string} id
 * @param {PlanExplorer} data
 */
function planExplorer(stage, root, id, data) {
  const {words: says, arm} = data,
    first = /** @type {Question} */ (data.question);
  const state = opened(first),
    shown = read(data, /** @type {Answer} */ (joinArrays(data.first)), first);
  /** @type {Now} */
  const now = {shown, wave: shown.most, moment: 0, playing: false, before: 0};
  let asked = JSON.stringify(first),
    slept = false;
  const inputs = inputsOf(stage, data, state),
    result = element("p", {class: "rk-result"});
  const cube = cubeView(says.cube, stage.changed),
    times = timesOf(stage, data, now, cube.canvas);
  stage.title.after(result);
  stage.below.append(stage.says);
  stage.handles.set(marks(data, state));

  function tell() {
    times.reach();
    result.textContent = now.shown.result;
    result.classList.toggle("rk-past", !now.shown.kept);
    stage.changed();
  }
  tell();
  const stirred = (/** @type {boolean} */ sleeps) => () => {
    slept = sleeps;
    if (!sleeps) asked = JSON.stringify(now.shown.about);
    stage.changed();
  };
  root.addEventListener("robokin-slept", stirred(true));
  root.addEventListener("robokin-wake", stirred(false));
  /** @type {(answer: Answer, about: Question) => void} */
  const hear = (answer, about) => {
    take(now, read(data, answer, about));
    tell();
  };
  const live = kernelOf(root, id, says, hear);
  stage.run(
    () => {
      // without Python, the letters go back to where they were in the result that is shown
      if (slept) Object.assign(state, opened(now.shown.about));
      const question = inputs.question(),
        text = JSON.stringify(question);
      if (text !== asked) live.ask(question);
      asked = text;
      if (now.playing) pass(now);
      inputs.tell();
      times.tell();
      const {words, direct} = now.shown;
      stage.say([state.way ? "" : words, direct?.says || ""].join(" ").trim());
      stage.scene.things = thingsOf(state, now.shown);
      return [armAt(arm, state, now)];
    },
    [cube.canvas],
    () => {
      cube.draw(now, state.q);
      if (now.playing) stage.changed();
    },
  );
}

/**
 * @param {Now} now
 * @param {Now["shown"]} next  the result to show from now on
 */
function take(now, next) {
  const whole = now.wave >= now.shown.most;
  now.shown = next;
  now.wave = whole ? next.most : Math.min(now.wave, next.most);
  now.moment = Math.min(now.moment, lastOf(now));
}

/**
 * The target, the obstacle, the via points and the nearest point of a lever. The target and the
 * obstacle have no label here, since their handles have letters.
 * @param {State} state
 * @param {Shown} shown
 */
const thingsOf = ({target, obstacle}, {via, nearest: [at, text]}) => [
  point("", target),
  point("", obstacle),
  ...via.map((place, k) => point(`K${k + 2}`, [...place, 0])),
  point(text, [...at, 0]),
];

/** @type {(first: Question) => State} */
const opened = ({posture, target, obstacle, distance, way}) => ({
  q: [...posture],
  target: [...target, 0],
  obstacle: [...obstacle, 0],
  distance,
  way,
});

/** @type {(now: Now) => number} */
const lastOf = ({shown}) => shown.moments.length - 1;

/** Advances the time: the search first, then the motion. @param {Now} now */
function pass(now) {
  const {most} = now.shown,
    time = performance.now(),
    passed = Math.min(0.2, (time - now.before) / 1000);
  now.before = time;
  if (now.wave < most) now.wave = Math.min(most, now.wave + (most / SEARCH) * passed);
  else now.moment = Math.min(lastOf(now), now.moment + MOMENTS * passed);
  if (now.wave >= most && now.moment >= lastOf(now)) now.playing = false;
}

/**
 * The inputs next to the scene.
 * @param {Stage} stage
 * @param {PlanExplorer} data
 * @param {State} state
 */
function inputsOf(stage, {words: says, branches, controls: [spec], code}, state) {
  const way = menu(says.way, branches, k => {
    state.way = k;
    stage.changed();
  });
  const distance = slider(spec, value => {
    state.distance = Math.min(Math.max(value, spec.low), spec.high) / 1000;
    stage.changed();
  });
  const sides = tick(says.quadrilaterals, stage.changed);
  /** @type {() => Question} */
  const question = () => ({
    posture: state.q,
    target: state.target.slice(0, 2),
    obstacle: state.obstacle.slice(0, 2),
    distance: state.distance,
    way: state.way,
    sides: sides.on(),
  });
  const copy = copyButton(says, () => {
    const {posture, target, obstacle} = question();
    return fill(code, {
      posture: posture.join(", "),
      target: target.join(", "),
      obstacle: obstacle.join(", "),
      distance: state.distance,
    });
  });
  stage.side.append(distance.row, way.row, element("div", {class: "rk-row"}, sides.row, copy));
  return {
    question,
    tell() {
      way.set(state.way);
      distance.set(state.distance * 1000);
    },
  };
}

/**
 * The clocks of search and motion, below the cube. They need no kernel, so they work while the rest
 * is inactive.
 * @param {Stage} stage
 * @param {PlanExplorer} data
 * @param {Now} now
 * @param {HTMLCanvasElement} cube
 */
function timesOf(stage, {words: says}, now, cube) {
  const play = control("button", {type: "button", class: "rk-word rk-play"}, says.play),
    wave = range(says.search, 1),
    moment = range(says.motion, 1);
  /** @type {(name: string, input: HTMLElement) => HTMLElement} */
  const row = (name, input) =>
    element("label", {class: "rk-slide"}, element("span", {}, name), input);
  const rows = element("div", {}, row(says.search, wave), row(says.motion, moment));
  stage.side.after(
    element("div", {class: "rk-own"}, cube, element("div", {class: "rk-run"}, play, rows)),
  );
  wave.addEventListener("input", () => {
    [now.playing, now.wave] = [false, +wave.value];
    stage.changed();
  });
  moment.addEventListener("input", () => {
    [now.playing, now.moment] = [false, +moment.value];
    stage.changed();
  });
  play.addEventListener("click", () => {
    now.playing = !now.playing;
    if (now.playing && now.moment >= lastOf(now)) now.wave = now.moment = 0;
    now.before = performance.now();
    stage.changed();
  });
  return {
    reach() {
      wave.max = String(now.shown.most);
      moment.max = String(lastOf(now));
    },
    tell() {
      const steps = {n: Math.floor(now.wave), most: now.shown.most},
        share = Math.round((100 * now.moment) / lastOf(now));
      wave.value = String(now.wave);
      wave.setAttribute("aria-valuetext", fill(says.steps, steps));
      moment.value = String(now.moment);
      moment.setAttribute("aria-valuetext", fill(says.share, {share}));
      play.textContent = now.playing ? says.pause : says.play;
    },
  };
}

/**
 * The handles of obstacle, target and start.
 * @param {PlanExplorer} data
 * @param {State} state
 * @returns {Handle[]}
 */
function marks({arm, words: says, unit}, state) {
  const step = (0.01 * arm.reach) / 3;
  /** @type {(letter: string, color: Color, at: () => Point, take: (p: Point) => void) => Handle} */
  const handle = (letter, color, at, take) =>
    letterHandle({letter, name: says[letter], color, unit, step}, at, take);
  /** @type {(key: "obstacle" | "target", name: string, color: Color) => Handle} */
  const point = (key, name, color) =>
    handle(
      name,
      color,
      () => state[key],
      p => {
        state[key] = p;
      },
    );
  // within the arm's reach, the start posture follows the pointer with the least movement of joints
  /** @param {Point} place */
  const follow = place => {
    const q = least(arm, {place}, state.q);
    if (q.every(Number.isFinite)) state.q = q;
  };
  return [
    point("obstacle", "H", "alarm"),
    point("target", "K1", "joint3"),
    handle("K", "path", () => origin(fk(arm.chain, state.q)), follow),
  ];
}

/**
 * An answer, with all the data needed to draw it.
 * @param {PlanExplorer} data
 * @param {Answer} answer
 * @param {Question} about
 */
const read = ({forbidden}, answer, about) => ({
  ...answer,
  about,
  moments: rows(answer.moments),
  curve: rows(answer.curve),
  faces: facesOf(answer.cube, forbidden),
});

/**
 * The rows of an array, as arrays.
 * @param {Values} array
 */
const rows = ({values, shape: [count, width]}) =>
  Array.from({length: count}, (_, k) => Array.from(values.subarray(k * width, (k + 1) * width)));
