// Three levers: a family of postures for one point, as in planar.py, which is the reference.
//
// The scripts decide whether a row exists with + - * / and sqrt only, in the same order as Python,
// so that both agree to the last bit. Math.hypot, ** and Math.round differ from NumPy and are not
// used.

import {fill, inWords} from "./blanks.js";
import {clamp, distance2, leastTravel, nowhere} from "./rows.js";

/** @import {ThreeLeverInverse, Tolerances} from "./page.js" */
/** @import {ArmOf} from "./kinematics.js" */

/** @typedef {ArmOf<ThreeLeverInverse>} ThreeLeverArm */

/**
 * The amount by which the sum of two sides exceeds the third, rounded in the same way for every
 * angle.
 * @param {number} a
 * @param {number} b
 * @param {number} c
 */
const spare = (a, b, c) => Math.max(a, b) - c + Math.min(a, b);

/**
 * The angle between the sides a and b of a triangle, opposite c; NaN if there is no triangle.
 * @param {number} a
 * @param {number} b
 * @param {number} c
 * @param {Tolerances} tolerances
 */
function angleOf(a, b, c, {ROUNDING}) {
  const flat = 4 * ROUNDING * ((a + b) * (a + b));
  /** @type {(part: number) => number} */
  const root = part => Math.sqrt(part < 0 && part > -flat ? 0 : part);
  const beside = spare(c, b, a) * spare(c, a, b),
    around = spare(a, b, c) * (a + b + c);
  return 2 * Math.atan2(root(beside), root(around));
}

/**
 * The third side of a triangle with the sides a and b and the angle between them.
 * @param {number} a
 * @param {number} b
 * @param {number} angle
 */
const across = (a, b, angle) => distance2(a - b, 2 * Math.sqrt(a * b) * Math.sin(angle / 2));

/**
 * The angle between the side a and the third side of the same triangle.
 * @param {number} a
 * @param {number} b
 * @param {number} angle
 */
const beside = (a, b, angle) =>
  (Math.PI - angle) / 2 + Math.atan2((b - a) * Math.cos(angle / 2), (b + a) * Math.sin(angle / 2));

/**
 * The distance KO and the direction phi of a point; NaN if it is out of reach.
 * @param {ThreeLeverArm} arm
 * @param {{place: number[]}} point
 * @returns {[number, number]}
 */
function polar({geometry: {lever, inner, reach}, tolerances: {ROUNDING}}, {place: [x, y, z]}) {
  const KO = distance2(x, y);
  const reached = KO > inner && KO <= reach * (1 + ROUNDING) && Math.abs(z) <= ROUNDING * lever;
  return reached ? [KO, Math.atan2(y, x)] : [NaN, NaN];
}

/**
 * The alpha at which O, B and A are in line, or 0 if the point is near enough to be reached with
 * alpha = 0.
 * @param {ThreeLeverArm} arm
 * @param {number} KO
 */
const lowest = (
  {
    geometry: {
      levers: [a, b, c],
    },
    tolerances,
  },
  KO,
) => (KO <= a + b - c ? 0 : angleOf(c, a + b, KO, tolerances));

/**
 * @param {ThreeLeverArm} arm
 * @param {number} KO
 * @param {number} phi
 * @param {number} alpha
 */
function leverPosture(arm, KO, phi, alpha) {
  const {
      geometry: {
        levers: [a, b, c],
      },
      tolerances,
    } = arm,
    {ROUNDING} = tolerances,
    low = lowest(arm, KO);
  if (!(alpha >= low - ROUNDING && alpha <= Math.PI + ROUNDING)) return nowhere(3);
  alpha = clamp(alpha, low, Math.PI);
  const KB = across(b, c, alpha);
  return [
    phi + angleOf(KO, a, KB, tolerances),
    angleOf(KB, a, KO, tolerances) + beside(b, c, alpha),
    alpha,
  ];
}

/**
 * The alpha for the angle KOB; NaN if there is none.
 * @param {ThreeLeverArm} arm
 * @param {number} KO
 * @param {number} gamma1
 */
function alphaOfGamma(
  {
    geometry: {
      levers: [a, b, c],
    },
    tolerances: {ROUNDING},
  },
  KO,
  gamma1,
) {
  const KB = Math.sqrt(KO * KO + a * a - 2 * KO * a * Math.cos(gamma1)),
    gap = Math.abs(b - c);
  const half = Math.sqrt(Math.max((KB - gap) * (KB + gap), 0)) / (2 * Math.sqrt(b * c));
  if (!(half <= 1 + ROUNDING && KB >= gap && gamma1 >= 0 && gamma1 <= Math.PI)) return NaN;
  return 2 * Math.asin(Math.min(half, 1));
}

/**
 * The same arm with different lengths (m) of the levers OB, BA and AK, as in planar.py.
 * @param {ThreeLeverArm} arm
 * @param {number[]} levers
 * @returns {ThreeLeverArm}
 */
export function withLevers(arm, levers) {
  const [a, b, c] = levers,
    reach = a + b + c,
    [first, ...chain] = structuredClone(arm.chain);
  chain[0].before[3] = a; // the rows of [R | p]: this is x of p
  chain[1].before[3] = b;
  chain[1].after[3] = c;
  /** @type {ThreeLeverInverse} */
  const geometry = {
    ...arm.geometry,
    levers: [a, b, c],
    lever: reach / 3,
    inner: Math.abs(a - b) + c,
    reach,
  };
  return {...arm, chain: [first, ...chain], reach, geometry};
}

/**
 * The lowest and the highest alpha with which the arm reaches a point; NaN if there is none. With
 * `limited`, gamma also stays within 0 to 180 degrees.
 * @param {ThreeLeverArm} arm
 * @param {{place: number[]}} point
 * @param {boolean} [limited]
 * @returns {[number, number]}
 */
export function alpha_range(arm, point, limited = true) {
  const {
      geometry: {
        levers: [a, b, c],
      },
      tolerances,
    } = arm,
    [KO, phi] = polar(arm, point);
  /** @type {(alpha: number) => number} */
  const gamma = alpha => phi + angleOf(KO, a, across(b, c, alpha), tolerances);
  let low = lowest(arm, KO),
    high = Number.isNaN(KO) ? NaN : Math.PI;
  if (limited) {
    if (gamma(low) < 0) low = alphaOfGamma(arm, KO, -phi);
    if (gamma(high) > Math.PI) high = alphaOfGamma(arm, KO, Math.PI - phi);
    if (!(low <= high) || gamma(low) > Math.PI + tolerances.ROUNDING) return [NaN, NaN];
  }
  return [low, high];
}

/**
 * The posture (gamma, beta, alpha) that reaches a point with the free angle alpha; NaN if there is
 * none.
 * @param {ThreeLeverArm} arm
 * @param {{place: number[]}} point
 * @param {number} alpha
 * @returns {number[]}
 */
export const family = (arm, point, alpha) => leverPosture(arm, ...polar(arm, point), alpha);

/**
 * The derivatives of beta + alpha - gamma, gamma - beta + alpha and gamma + beta - alpha with
 * respect to alpha, up to a positive factor: see planar.py.
 * @param {ThreeLeverArm} arm
 * @param {number} KO
 * @param {number} each  the value of alpha
 */
function slopes(arm, KO, each) {
  const [a, b, c] = arm.geometry.levers,
    [gamma, beta, alpha] = leverPosture(arm, KO, 0, each);
  const height = a * Math.sin(gamma);
  const changes = [
    b * c * Math.sin(alpha),
    KO * (b * Math.sin(gamma + beta) - height),
    KO * height,
  ];
  const sum = changes[0] + changes[1] + changes[2];
  return changes.map(change => sum - 2 * change);
}

/**
 * Six values of alpha: the first and the last at which each of the three sums of `slopes` is
 * stationary. (For equal levers, only the first sum has a minimum; planar.py finds it in a
 * different way, with half as many accurate digits.)
 * @param {ThreeLeverArm} arm
 * @param {number} KO
 * @param {number} low
 * @param {number} high
 */
function level(arm, KO, low, high) {
  const alphas = Array.from({length: 257}, (_, i) => low + (high - low) * (i / 256));
  const signs = alphas.map(alpha => slopes(arm, KO, alpha).map(Math.sign));
  const turns = [0, 1, 2].map(k => alphas.slice(1).map((_, i) => signs[i][k] !== signs[i + 1][k]));
  return turns.flatMap((turn, k) =>
    [Math.max(turn.indexOf(true), 0), turn.lastIndexOf(true)].map(cell => {
      let [start, end] = cell < 0 ? [low, low] : [alphas[cell], alphas[cell + 1]];
      for (let i = 0; i < 28; i++) {
        const middle = (start + end) / 2;
        if (Math.sign(slopes(arm, KO, middle)[k]) === signs[Math.max(cell, 0)][k]) start = middle;
        else end = middle;
      }
      return (start + end) / 2;
    }),
  );
}

/**
 * The posture at a point with the smallest sum S of the absolute angle changes from `previous`. The
 * function compares the kinks, the ends and the stationary points of S as a function of alpha.
 * @param {ThreeLeverArm} arm
 * @param {{place: number[]}} point
 * @param {number[]} previous
 * @param {boolean} [limited]
 * @returns {number[]}
 */
export function least(arm, point, previous, limited = true) {
  const [KO, phi] = polar(arm, point),
    [low, high] = alpha_range(arm, point, limited);
  if (Number.isNaN(low)) return nowhere(3);
  const alphas = [
    low,
    high,
    ...keeping(arm, KO, phi, previous).map(({alpha}) => alpha),
    ...level(arm, KO, low, high),
  ];
  const rows = alphas.map(alpha =>
    leverPosture(arm, KO, phi, clamp(Number.isNaN(alpha) ? low : alpha, low, high)),
  );
  return leastTravel(rows, previous);
}

/** @typedef {{alpha: number, joint: number}} Kink  where a joint (an index) keeps its angle */

/**
 * The values of alpha at which a joint may keep its previous angle. A value is NaN if it does not
 * exist.
 * @param {ThreeLeverArm} arm
 * @param {number} KO
 * @param {number} phi
 * @param {number[]} previous
 * @returns {Kink[]}
 */
function keeping(arm, KO, phi, [gamma0, beta0, alpha0]) {
  const {
    geometry: {
      levers: [a, b, c],
    },
    tolerances,
  } = arm;
  const BAO = beside(b, a, beta0),
    atA = angleOf(across(a, b, beta0), c, KO, tolerances);
  return [
    {alpha: alpha0, joint: 2},
    {alpha: alphaOfGamma(arm, KO, gamma0 - phi), joint: 0},
    {alpha: BAO + atA, joint: 1},
    {alpha: BAO - atA, joint: 1},
  ];
}

/**
 * The kinks of S as a function of alpha.
 * @param {ThreeLeverArm} arm
 * @param {{place: number[]}} point
 * @param {number[]} previous
 * @returns {Kink[]}
 */
export function kinks(arm, point, previous) {
  const [KO, phi] = polar(arm, point),
    [low, high] = alpha_range(arm, point);
  return keeping(arm, KO, phi, previous).filter(({alpha, joint}) => {
    const q = leverPosture(arm, KO, phi, alpha);
    return alpha >= low && alpha <= high && Math.abs(q[joint] - previous[joint]) < KEPT;
  });
}
// rad: an angle that changes by less than this counts as unchanged
export const KEPT = 1e-6;

/**
 * Returns the reason why no posture reaches a point, as `out_of_reach` in planar.py does.
 * @param {Record<string, string>} says
 * @param {ThreeLeverArm} arm
 * @param {number[]} place
 */
export function outside(says, {geometry}, [x, y]) {
  const KO = distance2(x, y),
    distance = inWords(KO);
  if (KO <= geometry.inner) return fill(says.tooNear, {distance, inner: inWords(geometry.inner)});
  if (KO > geometry.reach) return fill(says.tooFar, {distance, reach: inWords(geometry.reach)});
  return says.pastGamma;
}
