// Three equal levers: a family of postures for one point. As planar.py, which is the reference.
//
// Only + - * / and sqrt decide whether a row exists, in Python's order of operations: so both agree
// to the last bit. Math.hypot, ** and Math.round are not what NumPy does and do not occur.

import {between, distance2, leastTravel, nowhere} from "./rows.js";

// By how much two sides are longer than the third, rounded alike whichever angle asks.
const spare = (a, b, c) => Math.max(a, b) - c + Math.min(a, b);

// The angle between the sides a and b of a triangle, opposite c; NaN if there is no triangle.
function angleOf(a, b, c, {ROUNDING}) {
  const flat = 4 * ROUNDING * ((a + b) * (a + b));
  const root = part => Math.sqrt(part < 0 && part > -flat ? 0 : part);
  const beside = spare(c, b, a) * spare(c, a, b), around = spare(a, b, c) * (a + b + c);
  return 2 * Math.atan2(root(beside), root(around));
}

// Distance KO and direction phi of a point; NaN where it is out of reach.
function polar({geometry: {lever: L}, tolerances: {ROUNDING}}, {place: [x, y, z]}) {
  const KO = distance2(x, y);
  const reached = KO > L && KO <= 3 * L * (1 + ROUNDING) && Math.abs(z) <= ROUNDING * L;
  return reached ? [KO, Math.atan2(y, x)] : [NaN, NaN];
}

function leverPosture({geometry: {lever: L}, tolerances}, KO, phi, alpha) {
  const {ROUNDING} = tolerances, low = angleOf(L, 2 * L, KO, tolerances);
  if (!(alpha >= low - ROUNDING && alpha <= Math.PI + ROUNDING)) return nowhere(3);
  alpha = between(alpha, low, Math.PI);
  const KB = 2 * L * Math.sin(alpha / 2);
  return [phi + angleOf(KO, L, KB, tolerances),
          angleOf(KB, L, KO, tolerances) + (Math.PI - alpha) / 2, alpha];
}

// The alpha that belongs to the angle KOB; NaN where there is none.
function alphaOfGamma({geometry: {lever: L}, tolerances: {ROUNDING}}, KO, gamma1) {
  const half = Math.sqrt(KO * KO + L * L - 2 * KO * L * Math.cos(gamma1)) / (2 * L);
  if (!(half <= 1 + ROUNDING && gamma1 >= 0 && gamma1 <= Math.PI)) return NaN;
  return 2 * Math.asin(Math.min(half, 1));
}

/**
 * The lowest and the highest alpha that reach a point; NaN where none does. With `limited` gamma,
 * too, stays within 0 to 180 degrees.
 * @param {Object} arm
 * @param {{place: number[]}} point
 * @param {boolean} [limited]
 * @returns {number[]}
 */
export function alpha_range(arm, point, limited = true) {
  const {geometry: {lever: L}, tolerances} = arm, [KO, phi] = polar(arm, point);
  const gamma = alpha => phi + angleOf(KO, L, 2 * L * Math.sin(alpha / 2), tolerances);
  let low = angleOf(L, 2 * L, KO, tolerances), high = Number.isNaN(KO) ? NaN : Math.PI;
  if (limited) {
    if (gamma(low) < 0) low = alphaOfGamma(arm, KO, -phi);
    if (gamma(high) > Math.PI) high = alphaOfGamma(arm, KO, Math.PI - phi);
    if (low > high || gamma(low) > Math.PI + tolerances.ROUNDING) return [NaN, NaN];
  }
  return [low, high];
}

/**
 * The posture (gamma, beta, alpha) that reaches a point with the free angle alpha; NaN where there
 * is none.
 * @param {Object} arm
 * @param {{place: number[]}} point
 * @param {number} alpha
 * @returns {number[]}
 */
export const family = (arm, point, alpha) => leverPosture(arm, ...polar(arm, point), alpha);

// The alpha between low and high with the least alpha + beta - gamma: six times, the best of 33 and
// its neighbours.
function bottom(arm, KO, low, high) {
  for (let round = 0; round < 6; round++) {
    const alphas = Array.from({length: 33}, (_, i) => low + (high - low) * (i / 32));
    const sums = alphas.map(each => {
      const [gamma, beta, alpha] = leverPosture(arm, KO, 0, each);
      return alpha + beta - gamma;
    });
    const best = sums.indexOf(Math.min(...sums));
    [low, high] = [alphas[Math.max(best - 1, 0)], alphas[Math.min(best + 1, 32)]];
  }
  return (low + high) / 2;
}

/**
 * The posture at a point with the smallest sum S of the angles' changes from `previous`: the
 * kinks and ends of S as a function of alpha and its one minimum between them are compared.
 * @param {Object} arm
 * @param {{place: number[]}} point
 * @param {number[]} previous
 * @param {boolean} [limited]
 * @returns {number[]}
 */
export function least(arm, point, previous, limited = true) {
  const {geometry: {lever: L}, tolerances} = arm, [gamma0, beta0, alpha0] = previous;
  const [KO, phi] = polar(arm, point), [low, high] = alpha_range(arm, point, limited);
  if (Number.isNaN(low)) return nowhere(3);
  const atA = angleOf(2 * L * Math.sin(beta0 / 2), L, KO, tolerances);
  const alphas = [low, high, alpha0, alphaOfGamma(arm, KO, gamma0 - phi),
                  (Math.PI - beta0) / 2 + atA, (Math.PI - beta0) / 2 - atA,
                  bottom(arm, KO, low, high)];
  const rows = alphas.map(alpha =>
    leverPosture(arm, KO, phi, between(Number.isNaN(alpha) ? low : alpha, low, high)));
  return leastTravel(rows, previous);
}
