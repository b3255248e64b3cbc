// The explorer of an arm that reaches a point in a family of postures: the point is taken by the
// hand, the free angle chosen on the curve of what it costs, and levers of different lengths by
// sliders. What is said, and every number of the arm, comes from Python (page.py: PageExplorer).

import {plus} from "./kinematics.js";
import {alpha_range, family, least, withLevers} from "./levers.js";
import {fill} from "./blanks.js";
import {colors, number, prepared, spot, stroke, upright, words} from "./canvas.js";
import {copyButton} from "./copy.js";
import {control, element, waiting} from "./elements.js";
import {inScreen} from "./handles.js";
import {slider, stageOf} from "./stage.js";
import {degrees, inCode, lengths, plain, radians} from "./turns.js";

/** @import {PageExplorer, With} from "./page.js" */
/** @import {Pixel} from "./canvas.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {With<PageExplorer, "arm" | "q" | "target"> & {arm: ThreeLeverArm}} LeversExplorer */
/**
 * What the free angle alpha costs: its range, where it is, the best one, and the cost `at` any.
 * @typedef {object} Costs
 * @property {number} low
 * @property {number} high
 * @property {number} alpha
 * @property {number} best
 * @property {(alpha: number) => number} at
 */

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {LeversExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => leversExplorer(stageOf(root, data), data));

/**
 * @param {Stage} stage
 * @param {LeversExplorer} data
 */
function leversExplorer(stage, data) {
  const {words: says, unit} = data,
    home = [...data.target.place];
  /** @type {ThreeLeverArm} */
  let arm = data.arm;
  const state = {place: [...home], before: [...data.q], alpha: data.q[2]};
  const sliders = data.controls.map((spec, k) =>
    slider(spec, value => {
      if (k < 2) state.place[k] = value * unit.size;
      else if (k === 2) state.alpha = radians(value);
      else
        arm = withLevers(
          arm,
          arm.geometry.levers.map((old, i) => (i === k - 3 ? value * unit.size : old)),
        );
      stage.changed();
    }),
  );
  /** @type {(q: number[]) => number} */
  const cost = q => q.reduce((sum, x, j) => sum + Math.abs(x - state.before[j]), 0);
  /** @type {(text: string, act: () => void) => HTMLElement} */
  const button = (text, act) => {
    const node = control("button", {type: "button", class: "rk-word"}, text);
    node.addEventListener("click", () => {
      act();
      stage.changed();
    });
    return node;
  };
  const canvas = element("canvas", {class: "rk-curves", role: "img", "aria-label": says.costs});
  /** @type {ReturnType<typeof drawCosts>} */
  let shown = null;
  stage.side.append(
    ...sliders.map(s => s.row),
    element(
      "div",
      {class: "rk-row"},
      button(says.least, () => {
        state.alpha = least(arm, state, state.before)[2];
      }),
      button(says.begin, () => {
        if (shown) state.before = family(arm, state, state.alpha);
      }),
      copyButton(says, () =>
        fill(data.code, {
          ...inCode({place: state.place}, unit),
          alpha: plain(degrees(state.alpha), 3),
          levers: lengths(arm.geometry.levers, {size: 1}).join(", "),
        }),
      ),
    ),
    canvas,
    stage.says,
  );
  /** @type {(event: PointerEvent) => void} */
  const pick = event => {
    if (shown) state.alpha = shown.alphaAt(event.offsetX);
    stage.changed();
  };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pick(event);
  });
  canvas.addEventListener("pointermove", event => {
    if (canvas.hasPointerCapture(event.pointerId)) pick(event);
  });

  const fine = 5e-3;
  stage.handles.set([
    {
      id: "free",
      name: says.takeFree,
      look: "rk-free",
      at: () => state.place,
      value: () =>
        `${state.place
          .slice(0, 2)
          .map(x => number(x / unit.size, 1))
          .join(", ")} ${unit.name}`,
      grab(camera) {
        const from = state.place,
          to = inScreen(camera, from);
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
    },
  ]);

  /** @type {?Costs} */
  let costs = null;
  stage.run(
    () => {
      const [low, high] = alpha_range(arm, state),
        exists = !Number.isNaN(low);
      if (exists) state.alpha = Math.min(Math.max(state.alpha, low), high);
      const q = exists ? family(arm, state, state.alpha) : state.before;
      /** @type {(x: number) => number} */
      const inUnit = x => x / unit.size;
      const values = [
        ...state.place.slice(0, 2).map(inUnit),
        degrees(state.alpha),
        ...arm.geometry.levers.map(inUnit),
      ];
      sliders.forEach((each, k) => each.set(values[k]));
      const best = exists ? least(arm, state, state.before) : null;
      costs = best
        ? {
            low,
            high,
            alpha: state.alpha,
            best: best[2],
            at: alpha => cost(family(arm, state, alpha)),
          }
        : null;
      stage.say(
        best
          ? fill(says.costSays, {
              gamma: number(degrees(q[0]), 1),
              beta: number(degrees(q[1]), 1),
              alpha: number(degrees(q[2]), 1),
              S: number(degrees(cost(q)), 1),
              best: number(degrees(best[2]), 1),
              least: number(degrees(cost(best)), 1),
            })
          : says.outside,
      );
      stage.scene.marks = [{name: says.target, at: state.place, radius: 0}];
      const ghosts = exists
        ? [0, 1, 2, 3, 4].map(k => ({
            q: family(arm, state, low + ((high - low) * k) / 4),
            past: false,
          }))
        : [];
      return [
        {
          name: arm.name,
          chain: arm.chain,
          q,
          faded: !exists,
          ghosts: [...ghosts, {q: state.before, past: true}],
        },
      ];
    },
    [canvas],
    () => {
      shown = drawCosts(canvas, says, costs);
    },
  );
}

/**
 * The sum S of the angles' changes over the free angle.
 * @param {HTMLCanvasElement} canvas
 * @param {Record<string, string>} says
 * @param {?Costs} costs
 * @returns {?{alphaAt: (px: number) => number}}  which angle a place stands for
 */
function drawCosts(canvas, says, costs) {
  const ready = prepared(canvas);
  if (!ready) return null;
  const [g, w, h] = ready,
    left = 44,
    right = w - 12,
    top = 26,
    bottom = h - 34;
  words(g, says.costTitle, 6, 14, colors.ink, 12, "left", "600");
  if (!costs) return null;
  const {low, high, alpha, best, at} = costs,
    count = 120;
  const alphas = Array.from({length: count + 1}, (_, i) => low + ((high - low) * i) / count),
    S = alphas.map(at);
  const most = Math.max(...S, 1e-9),
    least = Math.min(...S),
    room = Math.max(most - least, 1e-9);
  /** @type {(value: number) => number} */
  const x = value => left + (right - left) * (high > low ? (value - low) / (high - low) : 0.5);
  /** @type {(value: number) => number} */
  const y = value => bottom - ((bottom - top) * (value - least + 0.05 * room)) / (1.1 * room);
  for (const value of [least, most]) {
    stroke(
      g,
      [
        [left, y(value)],
        [right, y(value)],
      ],
      colors.grid,
      1,
    );
    words(
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
  upright(g, x(best), top, bottom, colors.near, 1.4, [4, 3]);
  upright(g, x(alpha), top, bottom, colors.ink, 1.4);
  spot(g, [x(alpha), y(at(alpha))], 4.5, colors.accent);
  words(g, `${number(degrees(low), 1)}\u00B0`, left, bottom + 14, colors.soft, 11, "left");
  words(g, `${number(degrees(high), 1)}\u00B0`, right, bottom + 14, colors.soft, 11, "right");
  words(g, says.costAxis, (left + right) / 2, bottom + 28, colors.soft, 11, "center");
  return {
    alphaAt: px => low + (high - low) * Math.min(1, Math.max(0, (px - left) / (right - left))),
  };
}
