// The explorer of an arm that reaches a point with a family of postures. The reader drags the
// point, chooses the free angle on the curve of its cost, and sets the lengths of levers with
// sliders. All text and the arm data come from Python (page.py: LeversPage).

import {plus} from "./kinematics.js";
import {alpha_range, family, least, withLevers} from "./levers.js";
import {fill} from "./blanks.js";
import {colors, number, prepared, spot, stroke, upright, write} from "./canvas.js";
import {copyButton} from "./copy.js";
import {scrubbing} from "./controls.js";
import {element, waiting} from "./elements.js";
import {inScreen} from "./handles.js";
import {slider, stageOf, wordButton} from "./stage.js";
import {degrees, inCode, lengths, plain, radians} from "./turns.js";
import {point} from "./mark.js";

/** @import {LeversPage} from "./page.js" */
/** @import {Pixel, Point} from "./canvas.js" */
/** @import {Handle} from "./handles.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {LeversPage & {arm: ThreeLeverArm}} LeversExplorer */
/**
 * The cost of the free angle alpha: its range, its value, the best value, the limits of its joint,
 * and a function `at` that returns the cost of any value.
 * @typedef {object} Costs
 * @property {number} low
 * @property {number} high
 * @property {number} alpha
 * @property {number} best
 * @property {number[]} limits
 * @property {(alpha: number) => number} at
 */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {LeversExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => leversExplorer(stageOf(root, data), data));

/**
 * The reader's settings: the point, the previous posture, the free angle, the arm.
 * @typedef {object} State
 * @property {Point} place
 * @property {number[]} before
 * @property {number} alpha
 * @property {ThreeLeverArm} arm
 */

/**
 * @param {Stage} stage
 * @param {LeversExplorer} data
 */
function leversExplorer(stage, data) {
  const {words: says} = data,
    home = data.target.place;
  /** @type {State} */
  const state = {place: [...home], before: [...data.q], alpha: data.q[2], arm: data.arm};
  const sliders = slidersOf(stage, data, state),
    canvas = element("canvas", {class: "rk-curves", role: "img", "aria-label": says.costs});
  /** @type {ReturnType<typeof drawCosts>} */
  let shown = null;
  /** @type {(text: string, act: () => void) => HTMLElement} */
  const button = (text, act) =>
    wordButton(text, () => {
      act();
      stage.changed();
    });
  stage.side.append(
    ...sliders.rows,
    element(
      "div",
      {class: "rk-row"},
      button(says.least, () => {
        state.alpha = least(state.arm, state, state.before)[2];
      }),
      button(says.begin, () => {
        if (shown) state.before = family(state.arm, state, state.alpha);
      }),
      copyButton(says, () => pythonOf(data, state)),
    ),
    canvas,
    stage.says,
  );
  scrubbing(canvas, event => {
    if (shown) state.alpha = shown.alphaAt(event.offsetX);
    stage.changed();
  });
  stage.handles.set([pointHandle(data, state, home)]);

  /** @type {?Costs} */
  let costs = null;
  stage.run(
    () => {
      costs = costsOf(state);
      sliders.tell();
      stage.say(costs ? told(says, state, costs) : says.outside);
      stage.scene.things = [point(says.target, state.place)];
      return [armOf(state, costs)];
    },
    [canvas],
    () => {
      shown = drawCosts(canvas, says, costs);
    },
  );
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
  return {
    low,
    high,
    alpha: state.alpha,
    best: least(arm, state, before)[2],
    limits: arm.limits[2],
    at: alpha => travel(family(arm, state, alpha), before),
  };
}

/** @type {(q: number[], from: number[]) => number} */
const travel = (q, from) => q.reduce((sum, x, j) => sum + Math.abs(x - from[j]), 0);

/**
 * @param {LeversExplorer["words"]} says
 * @param {State} state
 * @param {Costs} costs
 */
function told(says, state, {alpha, best, at}) {
  /** @type {(angle: number) => string} */
  const text = angle => number(degrees(angle), 1);
  const [gamma, beta, last] = family(state.arm, state, alpha).map(text);
  return fill(says.costSays, {
    gamma,
    beta,
    alpha: last,
    S: text(at(alpha)),
    best: text(best),
    least: text(travel(least(state.arm, state, state.before), state.before)),
  });
}

/**
 * The arm with some other postures that reach the point, and the previous posture.
 * @param {State} state
 * @param {?Costs} costs
 */
function armOf({arm, before, place}, costs) {
  /** @type {(alpha: number) => number[]} */
  const posture = alpha => family(arm, {place}, alpha);
  const alphas = costs
    ? [0, 1, 2, 3, 4].map(k => costs.low + ((costs.high - costs.low) * k) / 4)
    : [];
  return {
    name: arm.name,
    chain: arm.chain,
    q: costs ? posture(costs.alpha) : before,
    faded: !costs,
    ghosts: [...alphas.map(alpha => ({q: posture(alpha), past: false})), {q: before, past: true}],
  };
}

/**
 * @param {LeversExplorer} data
 * @param {State} state
 * @param {Point} home
 * @returns {Handle}
 */
function pointHandle({words, unit}, state, home) {
  const fine = 5e-3;
  return {
    id: "free",
    name: words.takeFree,
    look: "rk-free",
    at: () => state.place,
    value() {
      const [x, y] = state.place.map(each => number(each / unit.size, 1));
      return `${x}, ${y} ${unit.name}`;
    },
    grab(camera) {
      const to = inScreen(camera, state.place);
      return (dx, dy) => {
        state.place = [...to(dx, dy).slice(0, 2), 0];
      };
    },
    step(right, up, big) {
      state.place = plus(state.place, [right, up, 0], fine * (big ? 10 : 1));
    },
    home() {
      state.place = [...home];
    },
  };
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

/**
 * Draws the sum S of the absolute angle changes against the free angle. The axis of the angle
 * always covers the limits of its joint, so that the reader sees the range grow and shrink.
 * @param {HTMLCanvasElement} canvas
 * @param {Record<string, string>} says
 * @param {?Costs} costs
 * @returns {?{alphaAt: (px: number) => number}}  the angle at a horizontal position
 */
function drawCosts(canvas, says, costs) {
  const ready = prepared(canvas);
  if (!ready) return null;
  const [g, w, h] = ready,
    left = 44,
    right = w - 42,
    top = 26,
    bottom = h - 34;
  write(g, says.costTitle, 6, 14, colors.ink, 12, "left", "600");
  if (!costs) return null;
  const {low, high, alpha, best, at, limits} = costs,
    span = limits[1] - limits[0];
  const alphas = Array.from({length: 121}, (_, i) => low + ((high - low) * i) / 120),
    S = alphas.map(at);
  const most = Math.max(...S, 1e-9),
    least = Math.min(...S),
    room = Math.max(most - least, 1e-9);
  /** @type {(value: number) => number} */
  const x = value => left + ((right - left) * (value - limits[0])) / span;
  /** @type {(value: number) => number} */
  const y = value => bottom - ((bottom - top) * (value - least + 0.05 * room)) / (1.1 * room);
  /** @type {(py: number) => void} */
  const level = py =>
    stroke(
      g,
      [
        [left, py],
        [right, py],
      ],
      colors.grid,
      1,
    );
  for (const value of [least, most]) {
    level(y(value));
    write(
      g,
      `${number(degrees(value), 0)}\u00B0`,
      left - 5,
      y(value) + 4,
      colors.soft,
      11,
      "right",
    );
  }
  stroke(
    g,
    alphas.map(/** @returns {Pixel} */ (value, i) => [x(value), y(S[i])]),
    colors.accent,
    2,
  );
  level(bottom);
  upright(g, x(best), top, bottom, colors.near, 1.4, [4, 3]);
  upright(g, x(alpha), top, bottom, colors.ink, 1.4);
  spot(g, [x(alpha), y(at(alpha))], 4.5, colors.accent);
  drawAngles(g, costs, x, bottom + 14);
  write(g, says.costAxis, (left + right) / 2, bottom + 28, colors.soft, 11, "center");
  return {
    alphaAt: px => limits[0] + (span * (px - left)) / (right - left),
  };
}

/**
 * Writes both ends of the range of the free angle below the axis, and each limit for which there is
 * room.
 * @param {CanvasRenderingContext2D} g
 * @param {Costs} costs
 * @param {(value: number) => number} x
 * @param {number} y
 */
function drawAngles(g, {low, high, limits}, x, y) {
  /** @type {(value: number, decimals: number, color: string, gap: number) => void} */
  const name = (value, decimals, color, gap) => {
    const align = gap ? (gap < 0 ? "right" : "left") : "center";
    write(g, `${number(degrees(value), decimals)}\u00B0`, x(value) + gap, y, color, 11, align);
  };
  name(low, 1, colors.ink, -3);
  name(high, 1, colors.ink, 3);
  const room = 60; // px: the width of the text at one end, and half the width of a limit
  if (x(low) > x(limits[0]) + room) name(limits[0], 0, colors.soft, 0);
  if (x(high) < x(limits[1]) - room) name(limits[1], 0, colors.soft, 0);
}
