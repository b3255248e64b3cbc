// A blended motion, with the data for its curves and sentences.

import {follow, onward} from "./branches.js";
import {number} from "./canvas.js";
import {ik, singularities} from "./geometries.js";
import {distance, fk, origin} from "./kinematics.js";
import {blend, linear, quintic, refinedMaximum, trapezoidal} from "./motion.js";
import {peaks, timeOf} from "./peaks.js";
import {record} from "./recorded.js";

/** @import {MotionPage, PagePose} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Asked, State} from "./motion_parts.js" */
/** @import {Quantity} from "./peaks.js" */

/** @typedef {ReturnType<typeof motionOf>} Motion */
/** @typedef {{place: Point, text: string}} Near  the nearest point to via, and its distance */
const LAWS = {quintic, trapezoidal, linear};

/**
 * Computes the motion for the current settings: the findings of `record`, the times, the joint
 * values, the positions of the tool, the point of the path nearest to the via point, the samples
 * after which the curves break, a function that returns the pose at a time, and the times at which
 * an acceleration may jump.
 * @param {MotionPage} data
 * @param {Asked} state
 */
export function motionOf(data, state) {
  const {arm, laws, corners, samples} = data,
    {duration} = state;
  const law = LAWS[laws[state.law]](duration);
  const t = Array.from({length: samples}, (_, i) => (duration * i) / (samples - 1));
  /** @type {(start: PagePose, via: PagePose, goal: PagePose) => (x: number) => PagePose} */
  const between = (start, via, goal) => x =>
    blend(start, via, goal, state.blend, law(x), corners[state.corner]);
  const poseAt = between(state.start, state.via, state.goal);
  // without rotations, which take most of the time
  const [start, via, goal] = [state.start, state.via, state.goal].map(({place}) => ({place})),
    unturned = between(start, via, goal);
  const rows = t.map(x => ik(arm, poseAt(x))),
    q = follow(arm, rows, state.row),
    recorded = record(q, t, arm.prismatic, data.jumps),
    {missing} = recorded;
  const tool = q.map((row, i) => (missing[i] ? null : origin(fk(arm.chain, row))));
  const bend = timeOf(law, duration, 0.5 - state.blend),
    ramps = laws[state.law] === "trapezoidal" ? [0.25, 0.75] : [];
  const times = [0, bend, ...ramps.map(x => x * duration), duration - bend, duration];
  return {
    ...recorded,
    // a rounded corner is not a jump, however few samples it has
    jumps: state.blend > 0 ? [] : recorded.jumps,
    t,
    q,
    tool,
    gaps: new Set(recorded.gaps.flatMap((gap, i) => (gap ? [i] : []))),
    near: passing(data, via.place, x => unturned(x).place, t, tool),
    poseAt,
    times: times.sort((x, y) => x - y),
  };
}

/**
 * The greatest values of some quantities, including those between the samples. The result is null
 * if the motion is broken or passes a singularity, or if the search for one of them does not
 * converge.
 * @param {MotionPage} data
 * @param {Motion} motion
 * @param {Quantity[]} quantities
 */
export function topsOf({arm, samples}, {t, q, missing, gaps, poseAt, times}, quantities) {
  if (gaps.size || missing[0]) return null;
  const step = t[1];
  // the posture; NaN at a singularity, where free joints may have any value
  /** @type {(x: number) => number[]} */
  const posture = x => {
    const near = q[Math.min(Math.round(x / step), samples - 1)],
      row = onward(arm, ik(arm, poseAt(x)), near);
    return Object.values(singularities(arm, row)).some(Boolean) ? row.map(() => NaN) : row;
  };
  return peaks(posture, times, quantities);
}

/**
 * The greatest absolute value of joint j; NaN if there is none.
 * @type {(rows: number[][], j: number) => number}
 */
export const most = (rows, j) =>
  rows.reduce(
    (best, row) => (Number.isNaN(row[j]) || Math.abs(row[j]) <= best ? best : Math.abs(row[j])),
    NaN,
  );

/**
 * `now()` returns the motion for the current settings, and computes it again if they have changed.
 * `searched(held)` returns what `search` finds in it, or null as long as that is not known. The
 * search takes long, so it runs once for each motion, after its picture, and not while a handle is
 * held; then it calls `changed`.
 * @template Found
 * @param {MotionPage} data
 * @param {State} state
 * @param {(motion: Motion) => ?Found} search
 * @param {() => void} changed
 */
export function motions(data, state, search, changed) {
  let known = "",
    waiting = false;
  /** @type {?Motion} */
  let found = null;
  /** @type {?Found | undefined} */
  let result;
  const now = () => {
    const {time, playing, ...asked} = state, // the clock alone does not change the motion
      key = JSON.stringify(asked);
    if (!found || key !== known) [known, found, result] = [key, motionOf(data, state), undefined];
    return found;
  };
  return {
    now,
    /** @param {boolean} held */
    searched(held) {
      const motion = now();
      if (result === undefined && !held && !waiting) {
        waiting = true;
        setTimeout(() => {
          waiting = false;
          if (motion === found) result = search(motion);
          changed();
        });
      }
      return result ?? null;
    },
  };
}

/**
 * Returns the point of the path that is nearest to the via point, which may lie between samples, or
 * null if there is no path.
 * @param {MotionPage} data
 * @param {Point} via
 * @param {(x: number) => Point} placeAt
 * @param {number[]} t
 * @param {(Point|null)[]} tool
 * @returns {?Near}
 */
function passing({unit}, via, placeAt, t, tool) {
  const decimals = unit.size < 1 ? 1 : 3;
  /** @type {(place: Point) => number} */
  const from = place => distance(place, via) / unit.size;
  const far = tool.map(place => place && from(place));
  let least = Infinity,
    at = NaN;
  /** @type {{low: number, begin: number, end: number}[]} */
  const steps = [];
  for (let i = 1; i < t.length; i++) {
    const [a, b, x, y] = [tool[i - 1], tool[i], far[i - 1], far[i]];
    if (!a || !b || x === null || y === null) continue;
    if (x < least) [least, at] = [x, t[i - 1]];
    if (y < least) [least, at] = [y, t[i]];
    // a straight step comes no nearer to the via point than this
    const low = (x + y - distance(a, b) / unit.size) / 2;
    steps.push({low, begin: t[i - 1], end: t[i]});
  }
  if (!steps.length) return null;
  /** @type {typeof steps} */
  const joined = [];
  for (const step of steps.filter(({low}) => low < least)) {
    const last = joined.at(-1);
    if (last && last.end === step.begin) last.end = step.end;
    else joined.push(step);
  }
  for (const {begin, end} of joined) {
    const nearest = refinedMaximum(x => -from(placeAt(x)), begin, end, decimals);
    if (-nearest.value < least) [least, at] = [-nearest.value, nearest.at];
  }
  return {place: placeAt(at), text: `${number(least, decimals)} ${unit.name}`};
}
