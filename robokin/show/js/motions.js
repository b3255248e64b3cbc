// The motions of a player: everything that changes with its slider and its switch.

import {number} from "./canvas.js";
import {fk, origin} from "./kinematics.js";
import {isPast} from "./panel.js";
import {recording, series, thingsAt} from "./recordings.js";

/** @import {Page, PageArm, Unit} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Line, Mark, Panel} from "./panel.js" */
/** @import {Recording} from "./recordings.js" */

/** @typedef {ReturnType<typeof armIn>} Track  an arm in one motion */
/**
 * A sample, and a fraction of the step to the next.
 * @typedef {{i: number, share: number}} Moment
 */

const AFTER = 0.05; // how long the clock runs on after the last change, as a share of all times

/**
 * `choose(value, choice)` returns everything that changes with slider and switch. `things(motion,
 * sample, share)` returns the things that exist at that moment.
 * @param {Page} data
 */
export function motionsOf(data) {
  const {unit, slider, times} = data,
    values = slider?.values.length ?? 1;
  const count = values * (data.switch?.values.length ?? 1);
  const recordings = data.arms.map(arm => recording(arm, count, times.length, data)),
    quantities = data.quantities.map(quantity =>
      quantity.values.map(packed => series(packed, count, times.length, data.nothing)),
    );
  const things = thingsAt(data.scene.things, data.nothing);
  /**
   * When the clock of a motion stops: soon after everything has come to rest.
   * @param {number} motion
   */
  function endOf(motion) {
    /** @type {(i: number) => string} */
    const at = i =>
      JSON.stringify([
        recordings.map(each => each.q(motion, i)),
        quantities.map(all => all.map(of => of(motion)[i])),
        things(motion, i, 0),
      ]);
    const last = times.length - 1,
      rest = at(last);
    let i = last;
    while (i > 0 && at(i - 1) === rest) i--;
    const more = AFTER * (times[last] - times[0]);
    return i ? Math.min(times[last], times[i] + more) : times[last];
  }
  return {
    /**
     * @param {number} value
     * @param {number} choice
     */
    choose(value, choice) {
      const motion = choice * values + value,
        opening = slider ? choice * values : 0;
      const arms = data.arms.map((arm, k) => armIn(motion, arm, recordings[k], times.length, unit));
      const panels = [0, 1, 2].map(order => jointPanel(data, order, motion, opening, recordings));
      data.quantities.forEach((_, k) =>
        panels.push(quantityPanel(data, k, motion, opening, quantities[k])),
      );
      return {motion, arms, panels, end: endOf(motion)};
    },
    things,
  };
}

/**
 * @param {number} motion
 * @param {PageArm} arm
 * @param {Recording} recorded
 * @param {number} samples
 * @param {Unit} unit
 */
function armIn(motion, {name, chain, gaps, via, rows}, recorded, samples, unit) {
  const breaks = new Set(gaps[motion]),
    near = via?.[motion];
  const trace = Array.from({length: samples}, (_, i) => tipOf(chain, recorded.q(motion, i)));
  return {
    name,
    chain,
    gaps: breaks,
    places: trace,
    trace: broken(trace, breaks),
    /** The row of `ik` at a sample, as text. @type {(i: number) => string} */
    row: i => rows?.[motion]?.findLast(([first]) => first <= i)?.[1] ?? "",
    /** @type {(i: number, share: number) => number[]} */
    q: (i, share) => recorded.q(motion, i, share),
    near: near && {
      place: near.slice(1),
      text: `${number(near[0], unit.size < 1 ? 1 : 3)} ${unit.name}`,
    },
  };
}

/** The position of the tool. @type {(chain: PageArm["chain"], q: number[]) => ?Point} */
export const tipOf = (chain, q) => (q.every(Number.isFinite) ? origin(fk(chain, q)) : null);
/** @type {(places: (?Point)[], gaps: Set<number>) => (?Point)[]} */
export const broken = (places, gaps) => places.flatMap((p, i) => (gaps.has(i) ? [p, null] : [p]));

/**
 * The panel of joint values (order 0), speeds or accelerations of all arms.
 * @param {Page} data
 * @param {number} order
 * @param {number} motion
 * @param {number} opening
 * @param {Recording[]} recordings
 * @returns {Panel}
 */
function jointPanel(data, order, motion, opening, recordings) {
  const {label, axes, near} = data.panels[order],
    kinds = Object.keys(axes);
  /** @type {Line[]} */
  const lines = [];
  /** @type {Panel["near"]} */
  const limits = [];
  data.arms.forEach((arm, k) => {
    const first = lines.length;
    arm.chain.forEach((link, joint) =>
      lines.push({
        ...lineOf(data, k, motion, opening, of => recordings[k].quantity(order, of)[joint]),
        joint,
        axis: kinds.indexOf(link.prismatic ? "shift" : "turn"),
        faint: !!data.watch.joints && !data.watch.joints.includes(joint),
        limits: limitsOf(arm, order, joint),
      }),
    );
    for (const [joint, side] of near[k]) limits.push([first + joint, side]);
  });
  const marks = data.arms.flatMap(arm => marksOf(data, arm, order, motion));
  return {label, axes: Object.values(axes), lines, near: unlike(lines, limits), marks};
}

/**
 * The curve of a quantity that belongs to no joint.
 * @param {Page} data
 * @param {number} arm
 * @param {number} motion
 * @param {number} opening
 * @param {(motion: number) => Float64Array} of  its values
 * @returns {Line}
 */
function lineOf(data, arm, motion, opening, of) {
  /** @type {(motion: number) => Pick<Line, "values" | "gaps">} */
  const during = motion => ({values: of(motion), gaps: new Set(data.arms[arm].gaps[motion])});
  return {
    ...during(motion),
    // among the curves of more than two arms, it could not be told from them
    opening: motion === opening || data.arms.length > 2 ? null : during(opening),
    joint: -1,
    arm,
    axis: 0,
    faint: false,
    limits: null,
    now: NaN,
  };
}

/**
 * The limits, without those that an earlier arm also has.
 * @param {Line[]} lines
 * @param {Panel["near"]} limits
 * @returns {Panel["near"]}
 */
function unlike(lines, limits) {
  const seen = new Set();
  return limits.filter(([k, side]) => {
    const key = [lines[k].joint, side, lines[k].limits?.[side]].join();
    return !seen.has(key) && seen.add(key);
  });
}

/** @type {(arm: PageArm, order: number, joint: number) => ?[number, number]} */
function limitsOf({limits: [low, high], speedLimits}, order, joint) {
  if (order === 0) return [low[joint], high[joint]];
  return order === 1 && speedLimits ? [-speedLimits[joint], speedLimits[joint]] : null;
}

/**
 * The marks of an arm's jumps in position and speed. The text of each jump is in only one panel.
 * @param {Page} data
 * @param {PageArm} arm
 * @param {number} order
 * @param {number} motion
 * @returns {Mark[]}
 */
function marksOf(data, {name, leaps, jumps}, order, motion) {
  const whose = data.arms.length > 1 ? `${name}: ` : "";
  /** @type {(at: number) => (jump: [number, string]) => Mark} */
  const mark =
    at =>
    ([time, text]) => ({time, text: at === order ? whose + text : ""});
  return [...(leaps[motion] || []).map(mark(0)), ...(jumps[motion] || []).map(mark(2))];
}

/**
 * The panel of a quantity that belongs to no joint, for all arms.
 * @param {Page} data
 * @param {number} k  the index of the quantity
 * @param {number} motion
 * @param {number} opening
 * @param {((motion: number) => Float64Array)[]} of  the values of each arm
 * @returns {Panel}
 */
function quantityPanel(data, k, motion, opening, of) {
  const {label, scale, steps} = data.quantities[k];
  const lines = of.map((values, arm) => ({...lineOf(data, arm, motion, opening, values), steps}));
  return {label, axes: [{unit: "", scale}], lines, near: [], marks: []};
}

/**
 * The joints of an arm that currently exceed a position limit.
 * @param {Panel} panel  of joint values
 * @param {number} arm
 */
export const pastNow = ({lines}, arm) =>
  lines.filter(line => line.arm === arm && isPast(line, line.now)).map(({joint}) => joint);
