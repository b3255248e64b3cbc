// The explorer of an arm that reaches a point with a family of postures. The reader drags the
// point, chooses the free angle on the curve of its cost or at the joint, and sets the lengths of
// levers with sliders. All text and the arm data come from Python (explorer_page.py: LeversPage).

import {alpha_range, family, KEPT, kinks, least, outside, withLevers} from "./levers.js";
import {drawCosts, total} from "./levers_curve.js";
import {alphaHandle, pointHandle} from "./levers_handles.js";
import {fill, plain} from "./blanks.js";
import {jointColor, number, shade} from "./canvas.js";
import {copyButton} from "./copy.js";
import {frames, origin} from "./kinematics.js";
import {scrubbing} from "./controls.js";
import {element, waiting} from "./elements.js";
import {slider, stageOf, wordButton} from "./stage.js";
import {degrees, inCode, lengths, radians} from "./turns.js";
import {point} from "./mark.js";

/** @import {LeversPage} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Costs} from "./levers_curve.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {LeversPage & {arm: ThreeLeverArm}} LeversExplorer */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {LeversExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => leversExplorer(stageOf(root, data), data));

/**
 * The reader's settings: the point, the previous posture, the free angle and the arm; also the
 * index of the target, and for all targets before it the sum of the angle changes and the sum of
 * the largest changes.
 * @typedef {object} State
 * @property {Point} place
 * @property {number[]} before
 * @property {number} alpha
 * @property {ThreeLeverArm} arm
 * @property {number} task
 * @property {number} turned
 * @property {number} longest
 */

/** The first settings, except for the arm. @param {LeversExplorer} data */
const opening = ({targets, q}) => ({
  place: [...targets[0].place],
  before: [...q],
  alpha: q[2],
  task: 0,
  turned: 0,
  longest: 0,
});

/**
 * @param {Stage} stage
 * @param {LeversExplorer} data
 */
function leversExplorer(stage, data) {
  const {words: says} = data;
  /** @type {State} */
  const state = {arm: data.arm, ...opening(data)};
  const sliders = slidersOf(stage, data, state),
    canvas = element("canvas", {class: "rk-curves", role: "img"}),
    scene = stage.space.querySelector("canvas");
  /** @type {ReturnType<typeof drawCosts>} */
  let shown = null;
  /** @type {?Costs} */
  let costs = null;
  stage.side.append(
    ...sliders.rows,
    buttons(stage, data, state, () => costs),
    canvas,
    stage.says,
  );
  scrubbing(canvas, event => {
    if (shown) state.alpha = shown.alphaAt(event.offsetX);
    stage.changed();
  });
  if (data.curve.terms.length) stage.space.parentElement?.classList.add("rk-even");
  stage.handles.set([alphaHandle(data, state), pointHandle(data, state)]);

  stage.run(
    () => {
      costs = costsOf(state);
      sliders.tell();
      const text = costs ? told(data, state, costs) : outside(says, state.arm, state.place);
      stage.say(text);
      scene?.setAttribute("aria-label", `${data.title}. ${text}`);
      canvas.setAttribute("aria-label", costs ? heard(data, costs) : text);
      const rest = data.targets.slice(state.task + 1);
      stage.scene.things = [
        point(says.target, state.place),
        ...rest.map(({place}) => point(says.nextTarget, place)),
      ];
      return [armOf(state, costs, says.nowhere)];
    },
    [canvas],
    () => {
      shown = drawCosts(canvas, data.curve, costs);
    },
  );
}

/**
 * The buttons: least S, begin here, start again, copy.
 * @param {Stage} stage
 * @param {LeversExplorer} data
 * @param {State} state
 * @param {() => ?Costs} costs  those of the last picture
 */
function buttons(stage, data, state, costs) {
  const {words: says, targets} = data;
  /** @type {(text: string, act: (now: Costs) => void) => HTMLElement} */
  const button = (text, act) =>
    wordButton(text, () => {
      const now = costs();
      if (now) act(now);
      stage.changed();
    });
  const row = element(
    "div",
    {class: "rk-row"},
    button(says.least, ({best}) => {
      state.alpha = best[2];
    }),
    button(says.begin, ({q, changes}) => {
      state.turned += total(changes);
      state.longest += Math.max(...changes);
      state.before = [...q];
      state.task += 1;
      if (state.task < targets.length) state.place = [...targets[state.task].place];
    }),
  );
  if (data.curve.terms.length)
    row.append(
      wordButton(says.again, () => {
        Object.assign(state, opening(data));
        stage.changed();
      }),
    );
  row.append(copyButton(says, () => pythonOf(data, state)));
  return row;
}

/**
 * The sliders for the point, for alpha and, if the levers are unequal, for their lengths.
 * @param {Stage} stage
 * @param {LeversExplorer} data
 * @param {State} state
 */
function slidersOf(stage, {unit, controls}, state) {
  /** @type {(x: number) => number} */
  const inUnit = x => x / unit.size;
  const sliders = controls.map((spec, k) =>
    slider(spec, value => {
      const levers = [...state.arm.geometry.levers];
      if (k < 2) state.place[k] = value * unit.size;
      else if (k === 2) state.alpha = radians(value);
      else {
        levers[k - 3] = value * unit.size;
        state.arm = withLevers(state.arm, levers);
      }
      stage.changed();
    }),
  );
  return {
    rows: sliders.map(each => each.row),
    tell() {
      const {place, alpha, arm} = state;
      const values = [
        ...place.slice(0, 2).map(inUnit),
        degrees(alpha),
        ...arm.geometry.levers.map(inUnit),
      ];
      sliders.forEach((each, k) => each.set(values[k]));
    },
  };
}

/**
 * The cost of alpha at the point, with alpha clamped to its range; null if no posture reaches the
 * point.
 * @param {State} state
 * @returns {?Costs}
 */
function costsOf(state) {
  const {arm, before} = state,
    [low, high] = alpha_range(arm, state);
  if (Number.isNaN(low)) return null;
  state.alpha = Math.min(Math.max(state.alpha, low), high);
  /** @type {(q: number[]) => number[]} */
  const changed = q => q.map((x, j) => Math.abs(x - before[j]));
  const q = family(arm, state, state.alpha),
    best = least(arm, state, before);
  return {
    low,
    high,
    alpha: state.alpha,
    limits: arm.limits[2],
    q,
    changes: changed(q),
    best,
    fewest: changed(best),
    kinks: kinks(arm, state, before),
    at: alpha => changed(family(arm, state, alpha)),
  };
}

/** @type {(angle: number) => string} */
const inDegrees = angle => number(degrees(angle), 1);

/**
 * The posture and its cost, and the least cost, as text.
 * @param {LeversExplorer} data
 * @param {State} state
 * @param {Costs} costs
 */
function told({words: says, curve}, state, {q, changes, best, fewest, low, high}) {
  const [gamma, beta, alpha] = q.map(inDegrees),
    least = {best: inDegrees(best[2]), least: inDegrees(total(fewest))},
    S = inDegrees(total(changes));
  if (!curve.terms.length) return fill(says.costSays, {gamma, beta, alpha, S, ...least});
  const kept = ["gamma", "beta", "alpha"].filter((_, j) => fewest[j] < KEPT),
    ends = [low, high].some(end => Math.abs(end - best[2]) < KEPT);
  const why = kept.length
    ? fill(kept.length > 1 ? says.stay : says.stays, {names: kept.join(says.and)})
    : ends
      ? says.atEnd
      : says.isLevel;
  const shown = changes.map(inDegrees),
    terms = shown.map(text => `${text}\u00B0`).join(" + ");
  // rounded terms may add up to another value than the rounded sum
  const equals = number(total(shown.map(Number)), 1) === S ? "=" : "\u2248";
  const [all, largest] = [total(changes), Math.max(...changes)];
  const sums = {
    before: inDegrees(state.turned),
    all: inDegrees(state.turned + all),
    longest: inDegrees(state.longest + largest),
  };
  return (
    fill(says.termSays, {
      gamma,
      beta,
      alpha,
      S,
      terms,
      equals,
      longest: inDegrees(largest),
      ...least,
      why,
    }) + (state.task ? fill(says.sumSays, sums) : "")
  );
}

/**
 * A description of the curve for a screen reader.
 * @param {LeversExplorer} data
 * @param {Costs} costs
 */
function heard({words: says, curve}, {low, high, kinks, best, fewest}) {
  const names = ["gamma", "beta", "alpha"],
    ends = {low: inDegrees(low), high: inDegrees(high)};
  const places = kinks.map(({alpha, joint}) =>
    fill(says.kink, {name: names[joint], alpha: inDegrees(alpha)}),
  );
  return [
    fill(says.curveSays, {...ends, least: inDegrees(total(fewest)), best: inDegrees(best[2])}),
    ...(curve.terms.length ? places : []),
  ].join(" ");
}

/**
 * The arm with some other postures that reach the point, and the previous posture.
 * @param {State} state
 * @param {?Costs} costs
 * @param {string} nowhere  the words if none reaches it
 */
function armOf({arm, before, place}, costs, nowhere) {
  /** @type {(alpha: number) => number[]} */
  const posture = alpha => family(arm, {place}, alpha);
  const alphas = costs
    ? [0, 1, 2, 3, 4].map(k => costs.low + ((costs.high - costs.low) * k) / 4)
    : [];
  const q = costs ? posture(costs.alpha) : before;
  return {
    name: arm.name,
    chain: arm.chain,
    q,
    faded: !costs,
    nowhere,
    labels: costs ? named(arm, q) : [],
    ghosts: [...alphas.map(alpha => ({q: posture(alpha), past: false})), {q: before, past: true}],
  };
}

/**
 * The letters of gamma and beta at their joints, O and B. The handle of joint A has its own.
 * @param {ThreeLeverArm} arm
 * @param {number[]} q
 */
function named({chain}, q) {
  /** @type {number[][]} */
  const joints = [];
  frames(chain, q, joints);
  return ["\u03B3", "\u03B2"].map((text, j) => ({
    text,
    at: origin(joints[j]),
    color: shade(jointColor(j)),
  }));
}

/**
 * The Python code that finds the same posture.
 * @param {LeversExplorer} data
 * @param {State} state
 */
const pythonOf = ({code, unit}, {place, alpha, arm}) =>
  fill(code, {
    ...inCode({place}, unit),
    alpha: plain(degrees(alpha), 3),
    levers: lengths(arm.geometry.levers, {size: 1}).join(", "),
  });
