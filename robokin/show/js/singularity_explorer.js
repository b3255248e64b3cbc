// The singularity explorer: the reader pulls the tool along a straight line past a wrist
// singularity and sees how fast joint 4 has to turn there. All text and the arm data come from
// Python (explorer_page.py: SingularityPage).

import {TURN} from "./angles.js";
import {jointSpeeds} from "./dexterity.js";
import {plus} from "./kinematics.js";
import {ik, singularities} from "./geometries.js";
import {onward} from "./branches.js";
import {fill} from "./blanks.js";
import {colors, number, stroke} from "./canvas.js";
import {scrubbing} from "./controls.js";
import {copyButton} from "./copy.js";
import {curvesView} from "./curves.js";
import {element, waiting} from "./elements.js";
import {alongCurve} from "./handles.js";
import {drawRings, ringsOf} from "./joint_ring.js";
import {point} from "./mark.js";
import {clamp} from "./rows.js";
import {slider, stageOf} from "./stage.js";
import {scale} from "./ticks.js";
import {degrees} from "./turns.js";

/** @import {Control, SingularityPage} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Curves} from "./curves.js" */
/** @import {Handle} from "./handles.js" */
/** @import {ClosedFormArm} from "./kinematics.js" */
/** @import {Explored, Stage} from "./stage.js" */

/** @typedef {SingularityPage & {arm: ClosedFormArm}} SingularityExplorer */
/** @typedef {"arm" | "unit" | "pose" | "along" | "beside" | "row" | "speed"} LineKey */
/** @typedef {Pick<SingularityExplorer, LineKey>} Line */
/** @typedef {[place: number, miss: number]} State  in mm: along the line, and beside the pose */
/** @typedef {(k: number, value: number) => void} Change  changes the place (0) or the miss (1) */
/**
 * The posture at one place on the line, and the speed of joint 4 there in rad/s, NaN where joint 4
 * is free.
 * @typedef {{q: number[], speed: number}} Passing
 */
/**
 * The curve of joint 4's speed in turns/s for one miss, its greatest value, and the arm `at` a
 * place in mm.
 * @typedef {Curves & {most: number, at: (place: number) => Passing}} Curve
 */

const JOINT = 3, // the index of joint 4
  LARGE = 10; // the number of steps by which an arrow key moves the handle with Shift

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {SingularityExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => singularityExplorer(stageOf(root, data), data));

/**
 * @param {Stage} stage
 * @param {SingularityExplorer} data
 */
function singularityExplorer(stage, data) {
  const {words, arm, controls} = data,
    [{low, high, step}] = controls,
    places = Array.from({length: Math.round((high - low) / step) + 1}, (_, k) => low + k * step),
    curveOf = curves(data, places),
    armAt = armOf(data);
  /** @type {State} */
  const state = [low, 0];
  /** @type {Change} */
  const set = (k, value) => {
    state[k] = onStep(controls[k], value);
    stage.changed();
  };
  const sliders = controls.map((spec, k) => slider(spec, value => set(k, value))),
    [big, small] = [element("b"), element("span")],
    canvas = element("canvas", {class: "rk-curves", role: "img"}),
    view = curvesView(canvas, [[]], "mm");
  stage.side.append(
    element("p", {class: "rk-speed"}, element("span", {}, words.speed), big, small),
    ...sliders.map(each => each.row),
    canvas,
    element(
      "div",
      {class: "rk-row"},
      copyButton(words, () => fill(data.code, {place: state[0], miss: state[1]})),
    ),
    stage.says,
  );
  scrubbing(canvas, event => set(0, view.timeAt(event.offsetX)));
  stage.handles.set([toolHandle(data, state, set)]);

  stage.run(
    () => {
      const [place, miss] = state,
        {at, most, panels} = curveOf(miss),
        {q, speed} = at(place);
      sliders.forEach((each, k) => each.set(state[k]));
      panels[0].lines[0].now = Math.abs(speed) / TURN;
      const facts = {...told(words, state, q, speed), most: turns(most), name: arm.name};
      [big.textContent, small.textContent] = [facts.speed, facts.same];
      stage.say(facts.says);
      stage.name(fill(words.scene, facts));
      canvas.setAttribute("aria-label", fill(words.curve, facts));
      stage.scene.things = [point(words.singular, data.pose.place)];
      return [armAt(q, miss)];
    },
    [canvas],
    () => view.draw(curveOf(state[1]), places, scale(low, high), state[0]),
  );
}

/**
 * Returns a function that maps a posture and a miss to the arm with its line: axes 4 and 6, and the
 * ring of joint 4, whose spoke turns with the joint.
 * @param {SingularityExplorer} data
 * @returns {(q: number[], miss: number) => Explored}
 */
function armOf(data) {
  const {name, chain, reach} = data.arm,
    [{low, high}] = data.controls,
    rings = ringsOf(chain, reach);
  return (q, miss) => {
    const ends = [low, high].map(end => pointOn(data, end, miss));
    return {
      name,
      chain,
      q,
      axes: [JOINT, JOINT + 2],
      under: (g, {to}) => stroke(g, ends.map(to), colors.path, 1.6, [6, 4]),
      over: (g, camera) => drawRings(g, camera, chain, rings, q, j => j === JOINT),
    };
  };
}

/**
 * The step of a slider that is nearest to a value.
 * @param {Control} spec
 * @param {number} value
 */
const onStep = ({low, high, step}, value) =>
  clamp(low + step * Math.round((value - low) / step), low, high);

/**
 * A point on the line that passes the singular pose at this distance.
 * @param {Pick<Line, "unit" | "pose" | "along" | "beside">} line
 * @param {number} place  mm
 * @param {number} miss  mm
 * @returns {Point}
 */
const pointOn = ({unit: {size}, pose, along, beside}, place, miss) =>
  plus(plus(pose.place, along, place * size), beside, miss * size);

/**
 * Returns a function that maps a place on the line with this miss (both in mm) to the arm there. If
 * the miss is not zero, the arm keeps its row of `ik`. Otherwise, the line leads through the
 * singular pose, where joint 5 changes sign. After it, the arm continues with the row of the
 * other wrist flag.
 * @param {Line} data
 * @param {number} miss
 * @returns {(place: number) => Passing}
 */
export function lineOf(data, miss) {
  const {arm, row, along, speed} = data,
    velocity = [...along.map(x => x * speed), 0, 0, 0];
  /** @type {(place: number) => number[][]} */
  const rows = place => ik(arm, {...data.pose, place: pointOn(data, place, miss)});
  const near = rows(miss ? 0 : -1)[row]; // joint 4 turns by less than half a turn from here
  return place => {
    const q = onward(arm, [rows(place)[!miss && place > 0 ? row ^ 1 : row]], near),
      free = singularities(arm, q).wrist;
    return {q, speed: free ? NaN : jointSpeeds(arm.chain, q, velocity)[JOINT]};
  };
}

/**
 * Returns a function that maps a miss to its curve. It caches the last curve, which changes only
 * with the miss.
 * @param {SingularityExplorer} data
 * @param {number[]} places  mm
 * @returns {(miss: number) => Curve}
 */
function curves(data, places) {
  let known = NaN;
  /** @type {Curve} */
  let curve;
  return miss => {
    if (miss === known) return curve;
    const at = lineOf(data, (known = miss)),
      values = Float64Array.from(places, place => Math.abs(at(place).speed) / TURN),
      most = Math.max(...values.filter(Number.isFinite));
    const look = {opening: null, joint: JOINT, arm: 0, axis: 0, faint: false, limits: null},
      lines = [{...look, values, gaps: new Set(), now: NaN}],
      axes = [{unit: "", scale: scale(0, Math.max(1, most))}]; // at least one turn/s
    const label = fill(data.words.axis, {miss: number(miss, 0)}),
      panels = [{label, axes, lines, near: [], marks: []}];
    curve = {panels, large: 0, names: [], most, at};
    return curve;
  };
}

/**
 * @param {SingularityExplorer} data
 * @param {State} state
 * @param {Change} set
 * @returns {Handle}
 */
function toolHandle(data, state, set) {
  const [{low, step}] = data.controls,
    {size} = data.unit; // of one millimetre, in metres
  /** @type {(place: number) => Point} */
  const at = place => pointOn(data, place, state[1]);
  return {
    id: "tool",
    name: data.words.takeTool,
    look: "rk-free",
    at: () => at(state[0]),
    value: () => `${number(state[0], 0)} mm`,
    grab(camera) {
      const to = alongCurve(camera, metres => at(metres / size), state[0] * size, size);
      return (dx, dy) => set(0, to(dx, dy) / size);
    },
    step: (right, up, big) => set(0, state[0] + (right + up) * step * (big ? LARGE : 1)),
    home: () => set(0, low),
  };
}

/** Turns per second as text. @param {number} x */
const turns = x => number(x, x < 10 ? 2 : 1);

/**
 * The texts for this state: the speed of joint 4, the same in degrees, and a sentence that says
 * where the tool is or why joint 4 is free.
 * @param {Record<string, string>} words
 * @param {State} state
 * @param {number[]} q
 * @param {number} speed
 */
function told(words, [place, miss], q, speed) {
  const where = {place: number(place, 0), miss: number(miss, 0)};
  if (Number.isNaN(speed)) return {...where, speed: words.free, same: "", says: words.isFree};
  const size = Math.abs(speed),
    bend = Math.asin(Math.abs(Math.sin(q[JOINT + 1])));
  const distance = number(Math.sqrt(place * place + miss * miss), 0);
  return {
    ...where,
    speed: fill(words.turns, {turns: turns(size / TURN)}),
    same: fill(words.degrees, {degrees: number(degrees(size), 0)}),
    says: fill(words.near, {
      distance,
      turned: number(degrees(q[JOINT]), 0),
      bend: number(degrees(bend), 1),
    }),
  };
}
