// The target explorer: a target to drag, and all branches that reach it. All text and the arm data
// come from Python (explorer_page.py: TargetPage).

import {wrapped} from "./angles.js";
import {distance_from_singularity} from "./dexterity.js";
import {ik, singularities} from "./geometries.js";
import {explain, nearest, nearestLimit, representative, within} from "./branches.js";
import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {ellipsoidMenu} from "./ellipsoid_menu.js";
import {point} from "./mark.js";
import {matrix} from "./rotations.js";
import {menu, slider, stageOf, tick} from "./stage.js";
import {table} from "./table.js";
import {frame} from "./target.js";
import {targetHandles} from "./target_handles.js";
import {degrees, inCode, radians, rotationOf} from "./turns.js";

/** @import {ArmData, BranchTask, PageThing, TargetPage, With} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {ClosedFormArm} from "./kinematics.js" */
/** @import {Now} from "./recordings.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {TargetPage & {arm: ClosedFormArm}} TargetExplorer */
/**
 * A target. `rotation` and its `turns` (roll, pitch, yaw) belong to a transform, `angle` belongs to
 * a ScaraPose.
 * @typedef {{place: Point, turns: number[], rotation?: number[], angle?: number}} Target
 */
/**
 * The current target, the posture of the arm, the branch that the reader wants (-1 for the nearest
 * one) and the branch shown.
 * @typedef {Target & {q: number[], wanted: number, chosen: number}} State
 */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {TargetExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => targetExplorer(stageOf(root, data), data));

/**
 * Builds the handles of the target, and a table with a row for every branch.
 * @param {Stage} stage
 * @param {TargetExplorer} data
 */
function targetExplorer(stage, data) {
  const {arm, words, unit} = data;
  /** @type {Target} */
  const home = {...data.target, turns: data.turns};
  /** @type {State} */
  const state = {...structuredClone(home), q: [...data.q], wanted: -1, chosen: 0};
  if (arm.target === "Transform") state.rotation = rotationOf(state.turns);
  if (data.watched.length) stage.space.classList.add("rk-close");

  /** @type {(k: number) => void} */
  const want = k => {
    state.wanted = k;
    stage.changed();
  };
  const sliders = slidersOf(stage, data, state),
    choice = menu(words.branch, [words.nearest, ...data.branches], k => want(k - 1));
  const more = ellipsoidMenu(data, stage.changed),
    axes = tick(words.axes, stage.changed),
    copy = copyButton(words, () => fill(data.code, {...inCode(state, unit), row: state.chosen}));
  stage.side.append(
    ...sliders.map(s => s.row),
    choice.row,
    more.row,
    element("div", {class: "rk-row"}, axes.row, copy),
    stage.says,
  );
  const one = data.heads.slice(1).map(() => 1),
    rows = table(data.branches, data.heads, one, want),
    count = counter(stage, words);
  stage.below.append(rows.node);
  stage.handles.set(targetHandles(stage, state, home, data));

  stage.run(() => {
    const found = foundAt(data, state),
      {exists, usable, chosen} = found;
    state.chosen = chosen;
    if (exists[chosen]) state.q = found.rows[chosen];
    const values = valuesOf(data, state);
    sliders.forEach((s, k) => s.set(values[k]));
    choice.set(state.wanted + 1);
    rows.set(cells(data, found), exists[chosen] ? chosen : -1, exists);
    count(usable);
    const {ellipsoid, speeds} = more.at(state.q),
      why = told(data.task, found.rows, exists),
      room = usable[chosen] ? roomLeft(data, found.rows[chosen]) : "",
      says = why + summary(arm, words, state, usable, chosen) + room + speeds;
    stage.say(says);
    stage.name(fill(words.scene, {name: arm.name, values: inWords(data, values), says}));
    markTarget(stage, state, data);
    return [{...posed(arm, found, state.q), axes: axes.on(), ellipsoid}];
  });
}

/**
 * @param {Stage} stage
 * @param {TargetExplorer} data
 * @param {State} state
 */
const slidersOf = (stage, {arm, controls, unit}, state) =>
  controls.map((spec, k) =>
    slider(spec, value => {
      if (k < 3) state.place[k] = value * unit.size;
      else if (arm.target === "Transform") {
        state.turns[k - 3] = radians(value);
        state.rotation = rotationOf(state.turns);
      } else state.angle = radians(value);
      stage.changed();
    }),
  );

/**
 * Puts the number of usable branches next to the title, and returns a function that updates it.
 * @param {Stage} stage
 * @param {Record<string, string>} words
 */
function counter(stage, words) {
  const number = element("b"),
    node = element("span", {class: "rk-count"}, number, ` ${words.usable}`);
  stage.title.append(node);
  /** @param {boolean[]} usable */
  return usable => {
    const count = usable.filter(Boolean).length;
    number.textContent = fill(words.count, {count, all: usable.length});
    node.classList.toggle("rk-all", count === usable.length);
  };
}

/**
 * The values of the sliders.
 * @param {TargetExplorer} data
 * @param {State} state
 */
const valuesOf = ({controls, unit}, {place, angle, turns}) =>
  controls.map((_, k) => (k < 3 ? place[k] / unit.size : degrees(angle ?? turns[k - 3])));

/**
 * The values of the sliders as text.
 * @param {TargetExplorer} data
 * @param {number[]} values
 */
const inWords = ({controls}, values) =>
  controls
    .map(({name, unit}, k) => `${name} ${number(values[k], unit === "m" ? 3 : 0)}`)
    .join(", ");

/** @typedef {ReturnType<typeof foundAt>} Found */

/**
 * The arm in the posture q, with its joints past a limit and the other branches.
 * @param {ArmData} arm
 * @param {Found} found
 * @param {number[]} q
 */
const posed = ({name, chain}, found, q) => ({
  name,
  chain,
  q,
  faded: !found.exists[found.chosen],
  past: found.exists[found.chosen]
    ? found.inside[found.chosen].flatMap((good, j) => (good ? [] : [j]))
    : [],
  ghosts: ghostsOf(found),
});

/**
 * The other branches that exist.
 * @param {Found} found
 */
const ghostsOf = ({rows, exists, usable, chosen}) =>
  rows.flatMap((q, k) => (exists[k] && k !== chosen ? [{q, past: !usable[k]}] : []));

/**
 * All branches at the target: the row, whether it exists, which of its joints are inside their
 * limits, and its travel from the last posture; and the branch to show.
 * @param {Pick<TargetExplorer, "arm" | "turning">} data
 * @param {State} state
 */
export function foundAt({arm, turning}, state) {
  const last = state.q;
  const rows = ik(arm, state).map(row => {
    const near = nearest(arm, [row], last);
    return within(arm, near).every(Boolean) ? near : representative(arm, near);
  });
  const exists = rows.map(q => q.every(Number.isFinite)),
    inside = rows.map(q => within(arm, q)),
    usable = rows.map((_, k) => exists[k] && inside[k].every(Boolean));
  const travel = rows.map(q => turning.reduce((sum, j) => sum + Math.abs(q[j] - last[j]), 0));
  const among = usable.some(Boolean) ? usable : exists;
  const shortest = travel.reduce(
    (best, x, k) => (among[k] && (best < 0 || x < travel[best]) ? k : best),
    -1,
  );
  const chosen = state.wanted >= 0 ? state.wanted : Math.max(shortest, 0);
  return {rows, exists, inside, usable, travel, chosen};
}

/**
 * The cells of the table.
 * @param {TargetExplorer} data
 * @param {Found} found
 */
const cells = ({arm, words, units}, {rows, exists, inside, travel}) =>
  rows.map((q, k) => [
    aboutRow(arm, words, q, inside[k], exists[k]),
    ...q.map((x, j) =>
      exists[k] ? {text: number(x / units[j].size, 1), past: !inside[k][j]} : words.none,
    ),
    exists[k] ? number(distance_from_singularity(arm, q), 3) : words.none,
    exists[k] ? number(degrees(travel[k]), 1) : words.none,
  ]);

/**
 * Puts the target into the scene as a frame or a point, beside the things that do not move.
 * @param {Stage} stage
 * @param {State} state
 * @param {TargetExplorer} data
 */
function markTarget({scene}, {rotation, place}, {scene: {things}, words: {target}}) {
  const mark = rotation ? frame(target, matrix(rotation, place)) : point(target, place);
  scene.things = [.../** @type {Now<PageThing>[]} */ (things), mark];
}

/**
 * Says how far the watched joint nearest to one of its limits is from this limit.
 * @param {TargetExplorer} data
 * @param {number[]} q
 */
function roomLeft({arm, words, watched}, q) {
  if (!watched.length) return "";
  const {joint, side, room} = nearestLimit(arm, q, watched),
    limit = arm.limits_in_words[joint][side];
  return ` ${fill(words.room, {joint: joint + 1, room: number(degrees(room), 1), limit})}`;
}

/**
 * @param {ArmData} arm
 * @param {Record<string, string>} words
 * @param {number[]} q
 * @param {boolean[]} inside  for each joint, whether it is inside its limits
 * @param {boolean} exists
 */
function aboutRow(arm, words, q, inside, exists) {
  if (!exists) return words.missingRow;
  const past = inside.flatMap((good, j) => (good ? [] : [`q${j + 1}`]));
  if (past.length) return fill(words.past, {joints: past.join(", ")});
  return Object.values(singularities(arm, q)).some(Boolean) ? words.usableSingular : words.usable;
}

/**
 * Says whether the task of an exercise is solved.
 * @param {?BranchTask} task
 * @param {number[][]} rows
 * @param {boolean[]} exists
 */
function told(task, rows, exists) {
  if (!task) return "";
  // at a singularity two rows may be the same posture
  /** @type {(a: number[], b: number[]) => boolean} */
  const same = (a, b) => a.every((x, j) => Math.abs(wrapped(x - b[j])) < 1e-6);
  const count = rows.filter(
    (q, k) => exists[k] && !rows.some((other, i) => i < k && exists[i] && same(q, other)),
  ).length;
  return `${fill(count === task.wanted ? task.holds : task.open, {count, wanted: task.wanted})} `;
}

/**
 * @param {ClosedFormArm} arm
 * @param {Record<string, string>} words
 * @param {State} state
 * @param {boolean[]} usable
 * @param {number} chosen
 */
function summary(arm, words, state, usable, chosen) {
  const count = usable.filter(Boolean).length,
    why = explain(arm, state, chosen);
  return fill(count ? (count === 1 ? words.oneUsable : words.someUsable) : words.noneUsable, {
    count,
    all: usable.length,
    why,
  });
}
