// Chooses among the rows of `ik` and describes them, as in branches.py and explanations.py.

import {TURN, wrapped} from "./angles.js";
import {exists, leastTravel} from "./rows.js";
import {geometryOf, ik, singularities} from "./geometries.js";
import {fill, inWords, oneDecimal} from "./blanks.js";

/** @import {ArmData, PagePose} from "./page.js" */
/** @import {ClosedFormArm} from "./kinematics.js" */

/**
 * @param {ArmData} arm
 * @param {number[]} q
 * @param {number[]} previous
 */
const choose = (arm, q, previous) => geometryOf(arm).choose(arm, q, previous);

/**
 * The limits of a joint, widened by the tolerance.
 * @param {ArmData} arm
 * @param {number} j
 */
const room = ({limits, tolerances: {SLACK}}, j) => [limits[j][0] - SLACK, limits[j][1] + SLACK];

/**
 * For each joint of the posture q, whether it is within its limits. A revolute joint may be at q or
 * any number of whole turns away from it.
 * @param {ArmData} arm
 * @param {number[]} q
 * @returns {boolean[]}
 */
export const within = (arm, q) =>
  q.map((value, j) => {
    const [low, high] = room(arm, j);
    if (arm.prismatic[j]) return value >= low && value <= high;
    return value + TURN * Math.ceil((low - value) / TURN) <= high;
  });

/**
 * Returns the joint that is nearest to one of its limits, that limit (0 lower, 1 upper), and the
 * distance from it.
 * @param {ArmData} arm
 * @param {number[]} q
 * @param {number[]} joints  at least one
 */
export const nearestLimit = (arm, q, joints) =>
  joints
    .flatMap(joint =>
      arm.limits[joint].map((limit, side) => ({joint, side, room: Math.abs(limit - q[joint])})),
    )
    .reduce((least, one) => (one.room < least.room ? one : least));

/**
 * For each revolute joint the value nearest to `near` that differs from q by whole turns.
 * @param {ArmData} arm
 * @param {number[]} q
 * @param {number[]} near
 * @returns {number[]}
 */
export const unwrapped = (arm, q, near) =>
  q.map((value, j) => (arm.prismatic[j] ? value : wrapped(value, near[j])));

/**
 * Like `unwrapped`, but inside the limits if such a value exists.
 * @param {ArmData} arm
 * @param {number[]} q
 * @param {number[]} near
 */
const inside = (arm, q, near) =>
  unwrapped(arm, q, near).map((value, j) => {
    const [low, high] = room(arm, j);
    const up = value + TURN * Math.max(Math.ceil((low - value) / TURN), 0);
    const best = up - TURN * Math.max(Math.ceil((up - high) / TURN), 0);
    return best >= low && best <= high && !arm.prismatic[j] ? best : value;
  });

/**
 * The joint values to show to readers: those inside the limits that are nearest to q or, if there
 * are none, those that exceed the limits least.
 * @param {ArmData} arm
 * @param {number[]} q
 * @returns {number[]}
 */
export const representative = (arm, q) =>
  inside(arm, q, q).map((value, j) => {
    const [low, high] = arm.limits[j],
      [lowest, highest] = room(arm, j);
    if (arm.prismatic[j] || !(value < lowest || value > highest)) return value;
    const above = value - TURN * Math.floor((value - high) / TURN);
    const below = value + TURN * Math.floor((low - value) / TURN);
    return above - high <= low - below ? above : below;
  });

/**
 * The row with the least travel from q, with each joint inside its limits if possible; NaN if there
 * is no row.
 * @param {ArmData} arm
 * @param {number[][]} rows
 * @param {number[]} q
 * @returns {number[]}
 */
export const nearest = (arm, rows, q) =>
  leastTravel(
    rows.map(row => inside(arm, row, q)),
    q,
  );

/**
 * The first posture of a motion along one row. Joints that are free there, because the posture is
 * singular, take their values from the first sample that determines them.
 * @param {ArmData} arm
 * @param {number[][]} track
 */
function start(arm, track) {
  const first = track.find(exists) || track[0];
  const later = track.find(q => {
    const chosen = choose(
      arm,
      q,
      q.map((value, j) => value + j),
    ); // different shifts, so that no two of them cancel
    return chosen.every((value, j) => Math.abs(value - q[j]) <= 1e-12);
  });
  const q = choose(arm, first, later || first).map(value => (Number.isNaN(value) ? 0 : value));
  return inside(arm, q, q);
}

/**
 * The next posture after `before`: the row with the least travel; NaN if there is none.
 * @param {ArmData} arm
 * @param {number[][]} rows
 * @param {number[]} before
 * @returns {number[]}
 */
export const onward = (arm, rows, before) =>
  leastTravel(
    rows.map(q => choose(arm, unwrapped(arm, q, before), before)),
    before,
  );

/**
 * One continuous motion through the rows of `ik` along a path. It starts on `row`, and each further
 * sample takes the row nearest to the sample before it. Samples without rows are NaN.
 * @param {ArmData} arm
 * @param {number[][][]} samples  the rows of each sample
 * @param {number} row
 * @returns {number[][]}  the posture of each sample
 */
export function follow(arm, samples, row) {
  let before = start(
      arm,
      samples.map(rows => rows[row]),
    ),
    started = false;
  return samples.map(rows => {
    const q = onward(arm, started ? rows : [rows[row]], before);
    if (exists(q)) [before, started] = [q, true];
    return q;
  });
}

/**
 * Says by how much joint j exceeds its limit.
 * @param {ClosedFormArm} arm
 * @param {number[]} q
 * @param {number} j
 */
export function excess(arm, q, j) {
  const [low, high] = arm.limits[j],
    value = representative(arm, q)[j],
    {name, size} = arm.units[j];
  const over = value > high ? value - high : low - value;
  return fill(arm.sentences.past, {
    joint: j + 1,
    limit: arm.limits_in_words[j][value > high ? 1 : 0],
    value: oneDecimal(value / size) + name,
    over: oneDecimal(over / size) + name,
  });
}

/**
 * Says why a row of `ik` does not exist.
 * @param {ClosedFormArm} arm
 * @param {PagePose} pose
 * @param {number} row
 */
export function gapInWords(arm, pose, row) {
  const {kind, metres} = geometryOf(arm).gap(arm, pose, row);
  return fill(arm.sentences[kind], {what: arm.carried, gap: inWords(metres)});
}

/**
 * Says in one sentence whether a row of `ik` is usable and, if it is not, why. The sentences are
 * the same as in Python.
 * @param {ClosedFormArm} arm
 * @param {PagePose} pose
 * @param {number} row
 * @returns {string}
 */
export function explain(arm, pose, row) {
  const {sentences, carried: what} = arm,
    q = ik(arm, pose)[row];
  const flags = arm.branches[row].map(flag => (flag > 0 ? "+1" : "-1")).join(", ");
  if (!exists(q)) {
    const {metres} = geometryOf(arm).gap(arm, pose, row);
    const small = {...pose, place: pose.place.map(x => x / 1000)};
    const meant = metres > 10 && ik(arm, small).some(exists);
    const reason = gapInWords(arm, pose, row);
    return fill(sentences.missing, {row, flags, reason, hint: meant ? sentences.millimetres : "."});
  }
  const past = within(arm, q).flatMap((good, j) => (good ? [] : [excess(arm, q, j)]));
  const held = Object.entries(singularities(arm, q)).filter(([, holds]) => holds);
  const facts = [...past, ...held.map(([name]) => fill(sentences[name], {what}))];
  const kind = past.length ? "not usable" : facts.length ? "usable but" : "usable";
  return fill(sentences[kind], {row, flags, facts: facts.join(", and ")});
}
