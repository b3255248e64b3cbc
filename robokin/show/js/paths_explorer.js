// The paths explorer: the reader moves the goal of a loader and sees the paths that its gripper
// takes if each motor runs at its limit, if the gripper moves in a straight line, and if all motors
// stop together. All text and the arm data come from Python (explorer_page.py: PathsPage).

import {fill} from "./blanks.js";
import {gapInWords} from "./branches.js";
import {colors, number, spot, stroke} from "./canvas.js";
import {clockRow, runningClock} from "./clock.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {fk, origin} from "./kinematics.js";
import {point} from "./mark.js";
import {exists} from "./rows.js";
import {slider, stageOf} from "./stage.js";
import {
  durationOf,
  jointMoves,
  lineOf,
  pathOf,
  postureAt,
  postures,
  pulsesOf,
  straight,
} from "./stepper_moves.js";
import {table} from "./table.js";
import {targetHandles} from "./target_handles.js";
import {lengths} from "./turns.js";

/** @import {Context, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Explored, Stage} from "./stage.js" */
/** @import {Move, PathsExplorer} from "./stepper_moves.js" */
/** @import {Target} from "./target_explorer.js" */

/** @typedef {Target & {time: number, playing: boolean, chosen: number}} State */
/** @typedef {{text: string, at: Point, color: string}} Named */
/** @typedef {{motor: number, at: Point}} Turned  where a motor reverses */
/** @typedef {Move & ReturnType<typeof pathOf> & ReturnType<typeof pulsesOf>} Run */
/** @typedef {Run & {turned: Turned[]}} Way */
/**
 * The paths to the goal in the order of the table (null if there is none), the reason why one is
 * missing, and the fraction of the straight line at which it fails.
 * @typedef {{ways: (?Way)[], gap: string, share: number}} Ways
 */

const LETTERS = "abcd",
  [B, C, D] = [1, 2, 3]; // rows of the table
/** The lines of the paths. @type {Record<string, [color: () => string, dash: number[]]>} */
const LOOKS = {
  a: [() => colors.near, [9, 4, 2, 4]],
  b: [() => colors.soft, [6, 5]],
  c: [() => colors.soft, [6, 5]],
  d: [() => colors.path, []],
};

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {PathsExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => pathsExplorer(stageOf(root, data), data));

/**
 * @param {Stage} stage
 * @param {PathsExplorer} data
 */
function pathsExplorer(stage, data) {
  const {arm, words, unit, controls} = data,
    home = {place: data.goal, turns: []},
    waysTo = remembered(data);
  /** @type {State} */
  const state = {place: [...data.goal], turns: [], time: 0, playing: false, chosen: D};
  const longest = () =>
    Math.max(...waysTo(state.place).ways.map(way => (way ? durationOf(way) : 0)));
  const sliders = controls.map((spec, k) =>
      slider(spec, value => {
        state.place[k] = value * unit.size;
        stage.changed();
      }),
    ),
    rows = pathsTable(stage, data, state),
    parts = clockRow();
  stage.title.replaceWith(
    element("div", {class: "rk-head"}, stage.title.cloneNode(true), parts.row),
  );
  const clock = runningClock(parts, stage.frame, state, () => [0, longest()], stage.changed);
  const copy = copyButton(words, () =>
    fill(data.code, {goal: lengths(state.place, unit).join(", ")}),
  );
  stage.side.append(
    ...sliders.map(each => each.row),
    stage.says,
    element("div", {class: "rk-row"}, copy),
  );
  stage.below.append(rows.node);
  stage.handles.set(targetHandles(stage, state, home, data));
  const opening = longest() / 5; // here the letters of the paths are apart
  state.time = opening;

  stage.run(now => {
    if (state.playing && state.time === opening) state.time = 0; // the first play is a whole one
    clock.pass(now);
    const found = waysTo(state.place),
      {ways} = found,
      chosen = rowOf(ways, state.chosen),
      says = told(data, found);
    if (chosen >= 0) state.time = Math.min(state.time, longest());
    clock.tell();
    sliders.forEach((each, k) => each.set(state.place[k] / unit.size));
    rows.set(
      ways.map(way => cells(data, way)),
      chosen,
      ways.map(way => way !== null),
    );
    stage.say(says);
    stage.name(fill(words.scene, {name: arm.name, ...inWords(data, state, ways), says}));
    stage.scene.things = [point(words.start, data.start), point(words.goal, state.place)];
    return [armOn(data, state, ways, chosen)];
  });
}

/**
 * The table of the paths, in which the reader chooses the one that the arm follows.
 * @param {Stage} stage
 * @param {PathsExplorer} data
 * @param {State} state
 */
const pathsTable = (stage, {paths, heads}, state) =>
  table(
    paths,
    heads,
    heads.slice(1).map(() => 1),
    k => {
      state.chosen = k;
      stage.changed();
    },
  );

/**
 * Returns a function that maps the goal to the paths there. It caches the last result, which
 * changes only with the goal.
 * @param {PathsExplorer} data
 * @returns {(goal: Point) => Ways}
 */
function remembered(data) {
  let known = "";
  /** @type {Ways} */
  let ways;
  return goal => {
    if (known !== String(goal)) [known, ways] = [String(goal), waysOf(data, goal)];
    return ways;
  };
}

/**
 * @param {PathsExplorer} data
 * @param {Point} goal
 * @returns {Ways}
 */
export function waysOf(data, goal) {
  const {arm, start, row, words} = data,
    low = goal[2] < -arm.tolerances.ROUNDING * arm.geometry.elbow.reach;
  if (low || !postures(data, [goal]).every(exists)) {
    const gap = low ? words.floor : gapInWords(arm, {place: goal}, row);
    return {ways: [null, null, null, null], gap, share: 1};
  }
  /** @type {(move: Move) => Way} */
  const way = move => {
    const run = {...move, ...pathOf(data, move, start, goal), ...pulsesOf(move)},
      turned = run.reversals.map(({motor, time}) => ({motor, at: toolAt(data, move, time)}));
    return {...run, turned};
  };
  const {a, d} = jointMoves(data, start, goal),
    {q, missing, share} = lineOf(data, start, goal),
    line = q && way(straight(data, q)),
    turns = !!line && line.reversing.length > 0;
  return {
    ways: [way(a), turns ? null : line, turns ? line : null, way(d)],
    gap: missing ? gapInWords(arm, {place: missing}, row) : "",
    share,
  };
}

/**
 * Returns the row of the path that the arm follows: the path that the reader has chosen. If it does
 * not exist, this is the other straight path or, if there is none, path d; -1 if there is no path.
 * @param {(?Way)[]} ways
 * @param {number} wanted
 */
function rowOf(ways, wanted) {
  const straights = wanted === B || wanted === C ? [B, C] : [];
  return [wanted, ...straights, D].find(k => ways[k]) ?? -1;
}

/**
 * The arm on its path, drawn in front of all paths. If there is no path, it is at the start.
 * @param {PathsExplorer} data
 * @param {State} state
 * @param {(?Way)[]} ways
 * @param {number} chosen
 * @returns {Explored}
 */
function armOn(data, {time}, ways, chosen) {
  const {name, chain} = data.arm,
    way = ways[chosen];
  return {
    name,
    chain,
    q: way ? postureAt(data, way, time) : postures(data, [data.start])[0],
    faded: !way,
    around: () => ways.flatMap(each => each?.path ?? []),
    under: (g, camera) =>
      ways.forEach((each, k) => each && drawPath(g, camera, each, LETTERS[k], k === chosen)),
    over: (g, {to}) =>
      ways.forEach((each, k) => {
        if (each && k !== chosen)
          spot(g, to(toolAt(data, each, time)), 5, LOOKS[LETTERS[k]][0](), colors.paper, 1.5);
      }),
    labels: [
      ...ways.flatMap((each, k) => (each ? [label(k, LETTERS[k], toolAt(data, each, time))] : [])),
      ...(way?.turned ?? []).map(({motor, at}) =>
        label(chosen, fill(data.words.one, {motors: String(motor + 1)}), at),
      ),
    ],
  };
}

/** A label in the colour of a path. @type {(k: number, text: string, at: Point) => Named} */
const label = (k, text, at) => ({text, at, color: LOOKS[LETTERS[k]][0]()});

/** @type {(data: PathsExplorer, move: Move, time: number) => Point} */
const toolAt = (data, way, time) => origin(fk(data.arm.chain, postureAt(data, way, time)));

/**
 * @param {Context} g
 * @param {Camera} camera
 * @param {Way} way
 * @param {string} letter
 * @param {boolean} bold
 */
function drawPath(g, {to}, {path, bends, turned}, letter, bold) {
  const [color, dash] = LOOKS[letter];
  stroke(g, path.map(to), color(), bold ? 3 : 2, dash);
  const marked = letter === "a" ? bends : turned.map(({at}) => at);
  for (const place of marked) spot(g, to(place), 4.5, colors.paper, color(), 2);
}

/**
 * The cells of a row of the table.
 * @param {PathsExplorer} data
 * @param {?Way} way
 */
function cells({words, unit}, way) {
  if (!way) return Array.from({length: 5}, () => words.none);
  return [
    number(durationOf(way), 2),
    lengthText(way.length, unit),
    number(way.off / unit.size, unit.size < 1 ? 1 : 3),
    number(way.sent, 0),
    motors(way) || words.nothing,
  ];
}

/** @type {(x: number, unit: PathsExplorer["unit"]) => string} */
const lengthText = (x, {size}) => number(x / size, size < 1 ? 0 : 3);

/** The motors that reverse, as text. @param {Way} way */
const motors = ({reversing}) => reversing.map(j => j + 1).join(", ");

/**
 * Sentences that state the times, and why the straight line is path b or c, or is missing.
 * @param {PathsExplorer} data
 * @param {Ways} found
 */
function told({words}, {ways, gap, share}) {
  const [a, b, c] = ways;
  if (!a) return fill(words.out, {reason: gap});
  if (!durationOf(a)) return words.near;
  const same = fill(words.same, {time: number(durationOf(a), 2)});
  if (b) return fill(words.fast, {same, slow: number(durationOf(b), 2)});
  if (!c) return fill(words.blocked, {same, share: number(100 * share, 0), reason: gap});
  const list = c.reversing.map(j => String(j + 1)).join(words.and),
    who = fill(c.reversing.length > 1 ? words.several : words.one, {motors: list});
  return fill(words.slow, {same, slow: number(durationOf(c), 2), who});
}

/**
 * The values of the sliders, and the lengths of the paths, as text.
 * @param {PathsExplorer} data
 * @param {State} state
 * @param {(?Way)[]} ways
 */
function inWords({controls, words, unit}, {place}, ways) {
  const values = controls.map(({name}, k) => `${name} ${lengthText(place[k], unit)}`).join(", ");
  const told = ways.flatMap((way, k) =>
    way
      ? [
          fill(words.length, {
            path: LETTERS[k],
            length: lengthText(way.length, unit),
            unit: unit.name,
          }),
        ]
      : [],
  );
  return {values, lengths: told.join(" ")};
}
