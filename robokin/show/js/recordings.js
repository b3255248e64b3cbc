// Converts recorded numbers from the compact data of a page (page.py: Packed, PageWay, PageArm) to
// values over time.

import {number} from "./canvas.js";
import {unpacked} from "./unpacked.js";

/** @import {Packed, Page, PageArm, PageReading, PageThing, PageWay} from "./page.js" */

/**
 * @template V
 * @typedef {V extends PageReading ? string : V extends PageWay ? number[] : V} NowValue
 */
/**
 * A thing at a moment: each PageWay is replaced by numbers, each PageReading by text.
 * @template T
 * @typedef {{[K in keyof T]: NowValue<T[K]>}} Now
 */
/**
 * @template T
 * @typedef {(motion: number, sample: number, share: number) => T} AtMoment
 */
/**
 * @typedef {object} Recording
 * @property {(k: number, motion: number) => Float64Array[]} quantity
 * @property {(motion: number, sample: number, share?: number) => number[]} q
 */

/**
 * The motions of one arm. `quantity(k, motion)` returns joint values (k = 0), speeds or
 * accelerations in the units shown, for each joint as an array over the samples. `q(motion, sample,
 * share)` returns joint values in radians and metres between two samples.
 * @param {Pick<PageArm, "chain" | "motion">} arm
 * @param {number} motions
 * @param {number} samples
 * @param {Pick<Page, "unit" | "nothing">} page
 * @returns {Recording}
 */
export function recording(arm, motions, samples, {unit, nothing}) {
  const joints = arm.chain.length,
    inner = arm.chain.map(link => (link.prismatic ? unit.size : Math.PI / 180));
  const all = arm.motion.map(packed => unpacked(packed, motions, samples, nothing));
  /** @type {(motion: number, j: number) => number} */
  const row = (motion, j) => (motion * joints + j) * samples;
  return {
    quantity: (k, motion) =>
      inner.map((_, j) => all[k].subarray(row(motion, j), row(motion, j) + samples)),
    q: (motion, i, share = 0) =>
      inner.map((size, j) => size * interpolate(all[0], row(motion, j) + i, share)),
  };
}

/**
 * The values of a number over the samples, for each motion.
 * @param {Packed} packed
 * @param {number} motions
 * @param {number} samples
 * @param {number} nothing  the integer that means "no value"
 * @returns {(motion: number) => Float64Array}
 */
export function series(packed, motions, samples, nothing) {
  const all = unpacked(packed, motions, samples, nothing);
  return motion => all.subarray(motion * samples, (motion + 1) * samples);
}

/**
 * Returns a function that maps (motion, sample, share) to the things that exist at that moment,
 * some of which may move.
 * @param {PageThing[]} things
 * @param {number} nothing  the integer that means "no value"
 * @returns {AtMoment<Now<PageThing>[]>}
 */
export function thingsAt(things, nothing) {
  const all = things.map(thing =>
    Object.entries(thing).map(
      /** @returns {[string, AtMoment<unknown>]} */
      ([key, value]) => [key, valueAt(value, nothing)],
    ),
  );
  return (motion, i, share) =>
    all
      .map(thing => thing.map(([key, at]) => [key, at(motion, i, share)]))
      .filter(thing => !thing.some(([, now]) => Array.isArray(now) && now.some(Number.isNaN)))
      .map(thing => Object.fromEntries(thing));
}

/**
 * A value of a thing. A PageWay is interpolated between two samples; a PageReading is constant
 * until the next sample.
 * @param {unknown} value
 * @param {number} nothing
 * @returns {AtMoment<unknown>}
 */
function valueAt(value, nothing) {
  if (!(value instanceof Object && "samples" in value)) return () => value;
  const way = /** @type {PageWay & Partial<PageReading>} */ (value),
    {motions, samples, name, decimals} = way,
    values = unpacked(way, motions, samples, nothing),
    columns = values.length / motions / samples;
  return (motion, i, share) => {
    const [sample, part] = samples > 1 ? [i, decimals === undefined ? share : 0] : [0, 0],
      first = (motions > 1 ? motion : 0) * columns * samples + sample;
    const now = Array.from({length: columns}, (_, k) =>
      interpolate(values, first + k * samples, part),
    );
    if (decimals === undefined) return now;
    return Number.isNaN(now[0]) ? name : `${name}: ${number(now[0], decimals)}`;
  };
}

/**
 * A value between samples i and i + 1. Exactly at sample i, a NaN at the next one has no effect.
 * @param {Float64Array} values
 * @param {number} i
 * @param {number} share
 */
const interpolate = (values, i, share) =>
  share ? values[i] + share * (values[i + 1] - values[i]) : values[i];
