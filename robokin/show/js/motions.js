// The motions of a player: everything that changes with its slider and its switch.

import {number} from "./canvas.js";
import {fk, origin} from "./kinematics.js";
import {recording, thingsAt} from "./recordings.js";

/** @import {Page, PageArm, Unit} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Panel} from "./panel.js" */
/** @import {Recording} from "./recordings.js" */

/** @typedef {ReturnType<typeof armIn>} Track  an arm in one motion */
/** @typedef {{i: number, share: number}} Moment  a sample, and the share of the step to the next */

/**
 * choose(motion): everything that changes with slider and switch; things(motion, sample, share):
 * the things that exist at that moment.
 * @param {Page} data
 */
export function motionsOf(data) {
  const {unit, slider, times} = data;
  const count = (slider ? slider.values.length : 1) * (data.switch ? data.switch.values.length : 1);
  const recordings = data.arms.map(arm => recording(arm, count, times.length, data));
  return {
    /** @param {number} motion */
    choose(motion) {
      const arms = data.arms.map((arm, k) => armIn(motion, arm, recordings[k], times.length, unit));
      const columns = data.arms.map((arm, k) => ({
        title: arm.name,
        panels: data.panels.map((_, order) =>
          panelOf(data, k, order, motion, recordings[k], arms[k].gaps),
        ),
      }));
      return {motion, arms, columns};
    },
    things: thingsAt(data.scene.things, data.nothing),
  };
}

/**
 * @param {number} motion
 * @param {PageArm} arm
 * @param {Recording} recorded
 * @param {number} samples
 * @param {Unit} unit
 */
function armIn(motion, {name, chain, gaps, via}, recorded, samples, unit) {
  const breaks = new Set(gaps[motion]),
    near = via && via[motion];
  const trace = Array.from({length: samples}, (_, i) => tipOf(chain, recorded.q(motion, i)));
  return {
    name,
    chain,
    gaps: breaks,
    places: trace,
    trace: broken(trace, breaks),
    /** @type {(i: number, share: number) => number[]} */
    q: (i, share) => recorded.q(motion, i, share),
    near: near && {
      place: near.slice(1),
      text: `${number(near[0], unit.size < 1 ? 1 : 3)} ${unit.name}`,
    },
  };
}

/** The place of the tool. @type {(chain: PageArm["chain"], q: number[]) => ?Point} */
export const tipOf = (chain, q) => (q.every(Number.isFinite) ? origin(fk(chain, q)) : null);
/** @type {(places: (?Point)[], gaps: Set<number>) => (?Point)[]} */
export const broken = (places, gaps) => places.flatMap((p, i) => (gaps.has(i) ? [p, null] : [p]));

/**
 * @param {Page} data
 * @param {number} k  the index of the arm
 * @param {number} order  0: joint values, 1: speeds, 2: accelerations
 * @param {number} motion
 * @param {Recording} recorded
 * @param {Set<number>} gaps
 * @returns {Panel}
 */
function panelOf(data, k, order, motion, recorded, gaps) {
  const {label, own, axes, near} = data.panels[order],
    arm = data.arms[k];
  return {
    label: label + (own && data.slider ? `   (scale follows ${data.slider.label})` : ""),
    axes: Object.entries(axes).map(([kind, {unit, scales, of}]) => ({
      unit,
      scale: scales[of ? of[motion] : 0],
      joints: arm.chain.flatMap((link, j) => (link.prismatic === (kind === "shift") ? [j] : [])),
    })),
    curves: recorded.quantity(order, motion),
    gaps,
    limits:
      order === 0
        ? arm.limits
        : order === 1 && arm.speedLimits
          ? [arm.speedLimits.map(x => -x), arm.speedLimits]
          : null,
    near: near[k],
    marks: [
      ...(arm.leaps[motion] || []).map(([time, text]) => ({time, text: order ? "" : text})),
      ...(arm.jumps[motion] || []).map(([time, text]) => ({time, text: order === 2 ? text : ""})),
    ],
    now: [],
  };
}
