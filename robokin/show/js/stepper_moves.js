// Moves of stepper motors between two points, as in jobs/steppers/moves.py: the motor positions
// over time, in pulses, and the gripper's path.

import {rint, TURN, wrapped} from "./angles.js";
import {elbowRow} from "./geometries.js";
import {distance, dot, fk, origin, plus} from "./kinematics.js";
import {clamp, distance2, exists, nowhere} from "./rows.js";
import {radians} from "./turns.js";

/** @import {ElbowInverse, PathsPage} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {ArmOf, ClosedFormArm} from "./kinematics.js" */

/** @typedef {PathsPage & {arm: ClosedFormArm & ArmOf<ElbowInverse>}} PathsExplorer */
/** @typedef {Pick<PathsExplorer, "arm" | "row" | "per_degree" | "limit" | "samples">} Loader */
/**
 * The motors are at `positions` at the times `t` in seconds, and run at constant speed in between.
 * @typedef {{t: number[], positions: number[][]}} Move
 */
/** @typedef {{q: ?number[][], missing: ?Point, share: number}} Line  see `lineOf` */

const SLACK = 1e-9, // positions this close to a whole number of pulses count as that number
  SAMPLES = 240; // minimum number of samples of a path

/**
 * The postures at points along a motion, with the elbow up. Joint 1 takes the shortest turn and, on
 * the vertical axis, keeps its value.
 * @param {Loader} loader
 * @param {Point[]} places
 */
export function postures({arm, row}, places) {
  const tiny = arm.tolerances.FREE * arm.geometry.elbow.reach,
    [front, flag] = arm.branches[row];
  let before = 0;
  return places.map(place => {
    const [alpha, gamma, beta] = elbowRow(arm, place, front, flag)?.q ?? nowhere(3);
    if (distance2(place[0], place[1]) > tiny && !Number.isNaN(alpha))
      before = wrapped(alpha, before);
    return [before, gamma < -Math.PI / 2 ? gamma + TURN : gamma, Math.abs(beta)];
  });
}

/**
 * The motor positions of a posture, not rounded.
 * @param {Loader} loader
 * @param {number[]} q
 */
const pulses = ({per_degree}, q) => q.map((x, j) => x * (per_degree[j] / radians(1)));

/** @type {(loader: Loader, positions: number[]) => number[]} */
const jointValues = ({per_degree}, positions) =>
  positions.map((x, j) => (x / per_degree[j]) * radians(1));

/**
 * The moves a (each motor runs at its limit until it stops) and d (all stop together) from one
 * point to another, both in reach.
 * @param {Loader} loader
 * @param {Point} start
 * @param {Point} goal
 * @returns {{a: Move, d: Move}}
 */
export function jointMoves(loader, start, goal) {
  const [first, last] = postures(loader, [start, goal]).map(q => pulses(loader, q).map(rint)),
    way = last.map((x, j) => x - first[j]),
    ends = way.map(x => Math.abs(x) / loader.limit),
    t = [...new Set([0, ...ends])].sort((x, y) => x - y);
  /** @type {(time: number) => number[]} */
  const at = time => first.map((x, j) => x + way[j] * (ends[j] ? Math.min(time / ends[j], 1) : 1));
  const duration = t[t.length - 1];
  return {
    a: {t, positions: t.map(at)},
    d: duration ? {t: [0, duration], positions: [first, last]} : {t: [0], positions: [first]},
  };
}

/**
 * The postures on the straight line between two points. If part of the line is out of reach, there
 * are none, and `missing` is the middle of that part.
 * @param {Loader} loader
 * @param {Point} start
 * @param {Point} goal
 * @returns {Line}
 */
export function lineOf(loader, start, goal) {
  const last = loader.samples - 1,
    places = Array.from({length: last + 1}, (_, k) =>
      start.map((x, i) => (1 - k / last) * x + (k / last) * goal[i]),
    ),
    q = postures(loader, places),
    first = q.findIndex(row => !exists(row));
  if (first < 0) return {q, missing: null, share: 1};
  const middle = (first + q.findLastIndex(row => !exists(row))) >> 1;
  return {q: null, missing: places[middle], share: middle / last};
}

/**
 * The move along a straight line. At any moment, the fastest motor runs at its limit.
 * @param {Loader} loader
 * @param {number[][]} q  postures along the line
 * @returns {Move}
 */
export function straight(loader, q) {
  const due = q.map(row => pulses(loader, row)),
    last = due.length - 1;
  for (const k of [0, last]) due[k] = due[k].map(rint);
  const t = [0],
    positions = [due[0]];
  for (let k = 1, now = 0; k <= last; k++) {
    const ahead = Math.max(...due[k].map((x, j) => Math.abs(x - due[k - 1][j]))) / loader.limit;
    if (!(ahead > 0)) continue;
    t.push((now += ahead));
    positions.push(due[k]);
  }
  return {t, positions};
}

/**
 * The motor positions at a time; before and after the move, they are constant.
 * @param {Move} move
 * @param {number} time
 */
function positionsAt({t, positions}, time) {
  const k = t.findIndex(x => x > time);
  if (k < 1) return positions[k ? positions.length - 1 : 0];
  const share = (time - t[k - 1]) / (t[k] - t[k - 1]);
  return positions[k].map((x, j) => positions[k - 1][j] + share * (x - positions[k - 1][j]));
}

/**
 * The posture at a time.
 * @type {(loader: Loader, move: Move, time: number) => number[]}
 */
export const postureAt = (loader, move, time) => jointValues(loader, positionsAt(move, time));

/** The duration of a move in seconds. @param {Move} move */
export const durationOf = ({t}) => t[t.length - 1];

/**
 * The number of pulses of a move, the indices of the motors that reverse, and the times at which
 * they do. A motor receives a pulse whenever its required position is a whole pulse ahead of its
 * actual one, or behind it.
 * @param {Move} move
 */
export function pulsesOf({t, positions}) {
  let sent = 0;
  /** @type {{motor: number, time: number}[]} */
  const reversals = [];
  positions[0].forEach((first, j) => {
    let [stands, way] = [first, 0],
      far = 0; // where the motor is due farthest in the direction `way`
    positions.forEach(({[j]: due}, k) => {
      if (way * (due - positions[far][j]) > 0) far = k;
      const ahead = due - stands,
        steps = Math.sign(ahead) * Math.floor(Math.abs(ahead) + SLACK);
      if (!steps) return;
      stands += steps;
      sent += Math.abs(steps);
      if (way * steps < 0) reversals.push({motor: j, time: t[far]});
      if (way * steps <= 0) far = k;
      way = Math.sign(steps);
    });
  });
  return {sent, reversals, reversing: [...new Set(reversals.map(({motor}) => motor))]};
}

/**
 * The gripper's path during a move, the places where a motor changes its speed, the length of the
 * path, and its greatest distance from the straight line between two points, in metres.
 * @param {Loader} loader
 * @param {Move} move
 * @param {Point} start
 * @param {Point} goal
 */
export function pathOf(loader, move, start, goal) {
  const {t, positions} = move,
    duration = durationOf(move);
  /** @type {(motors: number[]) => Point} */
  const tool = motors => origin(fk(loader.arm.chain, jointValues(loader, motors)));
  const last = t.length - 1,
    stride = Math.max(1, Math.floor(last / SAMPLES)), // the straight line has more samples
    path = [tool(positions[0])],
    bends = [];
  for (let k = 0; k < last;) {
    // at both ends, the positions of the motors are rounded to whole pulses
    const next = k && k < last - 1 ? Math.min(k + stride, last - 1) : k + 1,
      pieces = Math.ceil((SAMPLES * (t[next] - t[k])) / duration);
    for (let i = 1; i < pieces && stride === 1; i++)
      path.push(tool(positionsAt(move, t[k] + (i / pieces) * (t[next] - t[k]))));
    path.push(tool(positions[next]));
    if (next < last) bends.push(path[path.length - 1]);
    k = next;
  }
  let length = 0;
  for (let k = 1; k < path.length; k++) length += distance(path[k - 1], path[k]);
  const off = Math.max(...path.map(place => away(place, start, goal)));
  return {path, bends, length, off};
}

/**
 * The distance of a point from the straight line between two others.
 * @param {Point} place
 * @param {Point} start
 * @param {Point} goal
 */
function away(place, start, goal) {
  const line = plus(goal, start, -1),
    from = plus(place, start, -1),
    square = dot(line, line);
  return distance(
    from,
    line.map(x => x * (square ? clamp(dot(from, line) / square, 0, 1) : 0)),
  );
}
