// The crossing explorer of two links whose tip crosses a line: the reader drags the tip and sees
// the tracks of both elbows, and which of them a formula returns. All text and the arm data come
// from Python (explorer_page.py: CrossingPage).

import {fill, inWords} from "./blanks.js";
import {number} from "./canvas.js";
import {copyButton} from "./copy.js";
import {byRoot, elbowsAt, movedTo, nearest, onBase, rangeOf, tracksAt} from "./crossing.js";
import {drawCurves} from "./crossing_curve.js";
import {lineOf, named, posed} from "./crossing_picture.js";
import {scrubbing} from "./controls.js";
import {element, waiting} from "./elements.js";
import {geometryOf, ik, singularities} from "./geometries.js";
import {inScreen} from "./handles.js";
import {distance} from "./kinematics.js";
import {clamp, exists} from "./rows.js";
import {slider, stageOf} from "./stage.js";
import {table} from "./table.js";
import {lengths} from "./turns.js";

/** @import {CrossingPage} from "./page.js" */
/** @import {Box, Context, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {TwoLinkArm} from "./crossing.js" */
/** @import {Stage} from "./stage.js" */

const SAME = 1e-6; // times the reach: elbows that are closer together are one, apart from rounding

/** @typedef {CrossingPage & {arm: TwoLinkArm}} CrossingExplorer */
/** @typedef {{tip: Point}} State */
/** @typedef {ReturnType<typeof foundAt>} Found */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {CrossingExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => crossingExplorer(stageOf(root, data), data));

/**
 * Everything that the view shows: the rows of `ik`, the elbows, their tracks, the places where they
 * meet, the elbow that the formula returns and its index (-1 for none), both elbows where the line
 * through the tip crosses the zero of the divisor, and whether the tip is on the base.
 * @param {CrossingExplorer} data
 * @param {State} state
 */
function foundAt({arm, divisor}, {tip}) {
  const k = divisor ?? 0,
    rows = ik(arm, {place: tip}).filter(exists),
    elbows = elbowsAt(arm, tip),
    tracks = tracksAt(arm, tip, k),
    [near, far] = rangeOf(arm, tip, k);
  const meets = [near, far]
    .filter(u => tracks.length && u)
    .flatMap(u => [-u, u].map(each => movedTo(arm, tip, k, each)))
    .flatMap(each =>
      elbowsAt(arm, each)
        .slice(0, 1)
        .map(at => ({at, tip: each})),
    );
  const formula = divisor === null || !rows.length ? null : byRoot(arm, tip, k);
  return {
    rows,
    elbows,
    tracks,
    meets,
    formula,
    which: nearest(elbows, formula),
    crossing: divisor === null ? [] : elbowsAt(arm, movedTo(arm, tip, k, 0)),
    based: onBase(arm, tip),
  };
}

/**
 * @param {Stage} stage
 * @param {CrossingExplorer} data
 */
function crossingExplorer(stage, data) {
  const {words, controls, unit} = data;
  /** @type {State} */
  const state = {tip: [...data.tip, 0]};
  /** @type {(k: number, x: number) => void} */
  const set = (k, x) => {
    const {low, high, step} = controls[k];
    state.tip[k] = clamp(Math.round(x / unit.size / step) * step, low, high) * unit.size;
  };
  const sliders = controls.map((spec, k) =>
    slider(spec, value => {
      set(k, value * unit.size);
      stage.changed();
    }),
  );
  const canvas = element("canvas", {class: "rk-curves", role: "img"}),
    k = data.divisor ?? 0;
  /** @type {?Found} */
  let now = null;
  /** @type {ReturnType<typeof drawCurves>} */
  let shown = null;
  const rows = table(data.rows, data.heads, [1, 1]),
    copy = copyButton(words, () => {
      const [x, y] = lengths(state.tip, unit);
      return fill(data.code, {x, y});
    });
  stage.side.append(
    ...sliders.map(each => each.row),
    rows.node,
    stage.says,
    canvas,
    element("div", {class: "rk-row"}, copy),
  );
  scrubbing(canvas, event => {
    if (shown) set(k, shown.at(event.offsetX));
    stage.changed();
  });
  stage.handles.set([tipHandle(data, state, set)]);
  const answer = () => {
    const found = foundAt(data, state),
      says = told(data, state, found);
    sliders.forEach((each, k) => each.set(state.tip[k] / unit.size));
    rows.set(cells(data, found));
    stage.say(says);
    stage.name(`${seen(data, state, found)} ${says}`);
    stage.scene.things = named(data, state, found);
    canvas.setAttribute("aria-label", fill(words.curve, {x: controls[k].name, y: data.eliminated}));
    now = found;
    return [posed(data, state, found)];
  };
  stage.run(answer, [canvas], () => {
    shown = now && drawCurves(canvas, data, state, now);
  });
}

/** A coordinate as text. @type {(data: CrossingExplorer, x: number) => string} */
const inUnit = ({unit, controls: [{decimals}]}, x) => number(x / unit.size, decimals);

/**
 * The cells of the table: the right elbow, the left one, and that of the formula.
 * @param {CrossingExplorer} data
 * @param {Found} found
 */
function cells(data, {elbows, formula, based}) {
  const {none} = data.words;
  return data.rows.map((_, k) => {
    const at = k === 2 ? formula : !based && elbows[k];
    return at ? at.slice(0, 2).map(x => inUnit(data, x)) : [none, none];
  });
}

/**
 * Sentences that state the positions of the tip and of the elbows.
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 */
function seen(data, {tip}, {elbows, meets, based}) {
  const {words, rows, unit} = data;
  /** @type {(at: Point) => {x: string, y: string, unit: string}} */
  const facts = at => ({x: inUnit(data, at[0]), y: inUnit(data, at[1]), unit: unit.name});
  const said = (based ? [] : elbows).map((at, k) =>
    fill(words.elbow, {...facts(at), elbow: rows[k][0].toUpperCase() + rows[k].slice(1)}),
  );
  return [
    fill(words.seen, facts(tip)),
    ...said,
    ...(meets.length ? [fill(words.meet, {count: meets.length})] : []),
  ].join(" ");
}

/**
 * Says which elbow the formula returns, and how far it jumps on the line through the tip. If it
 * returns none, says why.
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {Found} found
 */
function told(data, {tip}, {rows: postures, which, crossing, based}) {
  const {arm, words, rows, divisor, unit} = data,
    says = [];
  if (!postures.length) {
    const gap = geometryOf(arm).gap(arm, {place: tip}, 0);
    return fill(gap.kind === "stretched" ? words.tooFar : words.tooNear, {
      gap: inWords(gap.metres),
    });
  }
  if (based) says.push(words.onBase);
  else if (singularities(arm, postures[0]).elbow)
    says.push(Math.cos(postures[0][1]) > 0 ? words.stretched : words.folded);
  if (divisor === null) return says.join(" ");
  const line = fill(words.line, lineOf(data));
  if (which < 0) says.push(fill(words.nothing, {line}));
  else if (!says.length) says.push(fill(words.returns, {elbow: rows[which]}));
  const apart = crossing.length ? distance(crossing[0], crossing[1]) : 0,
    through = onBase(arm, movedTo(arm, tip, divisor, 0)),
    still = !crossing.length ? words.stays : through ? words.keeps : words.one,
    jump = inUnit(data, apart);
  says.push(
    fill(apart > SAME * arm.geometry.reach ? words.jumps : still, {jump, unit: unit.name, line}),
  );
  return says.join(" ");
}

/**
 * @param {CrossingExplorer} data
 * @param {State} state
 * @param {(k: number, x: number) => void} set
 * @returns {Handle}
 */
function tipHandle(data, state, set) {
  const {words, unit, controls, tip} = data,
    fine = controls[0].step * unit.size;
  /** @type {(place: number[]) => void} */
  const move = place => [0, 1].forEach(k => set(k, place[k]));
  return {
    id: "tip",
    name: words.take,
    look: "rk-free",
    at: () => state.tip,
    value: () =>
      state.tip
        .slice(0, 2)
        .map(x => inUnit(data, x))
        .join(", ") + ` ${unit.name}`,
    grab(camera) {
      const to = inScreen(camera, [...state.tip]);
      return (dx, dy) => move(to(dx, dy));
    },
    step(right, up, big) {
      const by = fine * (big ? 10 : 1);
      move([state.tip[0] + by * right, state.tip[1] + by * up]);
    },
    home: () => move(tip),
  };
}
