// The inverse kinematics of every geometry (three levers: `family`, `least`), and the choice among its rows. As arms/elbow.py,
// spherical_wrist.py, scara.py, planar.py, branches.py, which are the reference.
//
// Only + - * / and sqrt decide whether a row exists, in Python's order of operations: so both agree
// to the last bit. Math.hypot, ** and Math.round are not what NumPy does and do not occur.

import {TURN, matrix, origin, product, rint, wrapped} from "./kinematics.js";

const SIGNS = [1, -1];
const exists = q => !q.some(Number.isNaN);
const nowhere = n => new Array(n).fill(NaN);
const between = (x, low, high) => Math.min(Math.max(x, low), high);

// The length of (x, y) as Python's `distance` has it.
function length2(x, y) {
  const scale = Math.max(Math.abs(x), Math.abs(y), 1e-300);
  x /= scale;
  y /= scale;
  return scale * Math.sqrt(x * x + y * y);
}

// The pair (cosine, sine) of an angle, turned on by that of a constant angle.
const onward = ([cosine, sine], [c, s]) =>
  s === 0 && c === 1 ? [cosine, sine] : [cosine * c - sine * s, sine * c + cosine * s];

// Half a turn on, so that it stays within half a turn.
const opposite = q => (q < 0 || Object.is(q, -0) ? q + Math.PI : q - Math.PI);

// The triangle of two levers whose ends are d apart, by half angles: see `two_levers`. null: none.
function twoLevers(upper, fore, d, {ROUNDING}) {
  const slack = ROUNDING * (upper + fore), fold = d - Math.abs(upper - fore);
  let stretch = upper + fore - d;
  if (!(stretch >= -slack && fold >= -slack)) return null;
  stretch = Math.max(stretch, 0);
  const around = upper + fore + d;
  const short = Math.max(d - (upper - fore), 0), long = Math.max(d + (upper - fore), 0);
  return {ahead: 2 * Math.atan2(Math.sqrt(stretch * short), Math.sqrt(around * long)),
          turn: 2 * Math.atan2(Math.sqrt(stretch * around), Math.sqrt(short * long))};
}

// The border (name -> metres beyond it) that is passed the farthest.
function worst(borders) {
  const [kind, metres] = Object.entries(borders).reduce((a, b) => (b[1] > a[1] ? b : a));
  return {kind, metres: Math.max(metres, 0)};
}

// --- Three joints that place a point: `Elbow` ----------------------------------------------------

// For front/back and elbow, as Elbow.solve: {q, plane, ahead} or null; besides the joints the
// directions (cosine, sine) of the arm's plane and of the forearm above the horizon.
function elbowRows({geometry: {elbow: e, turns}, tolerances}, [x, y, z]) {
  const {ROUNDING, STRAIGHT, FREE} = tolerances, {upper, fore, reach, lateral: b} = e;
  const rho2 = x * x + y * y, r2 = rho2 - b * b, tiny = FREE * reach;
  if (!(r2 >= -2 * ROUNDING * Math.abs(b) * reach)) return [null, null, null, null];
  const free = rho2 <= tiny * tiny;
  return SIGNS.flatMap(front => SIGNS.map(flag => {
    const r = front * Math.sqrt(Math.max(r2, 0));
    const cos1 = free ? front : (x * r + y * b) / rho2;
    const sin1 = (free ? 0 : (y * r - x * b) / rho2) + 0;

    const u = r - e.shoulder_x, w = z - e.shoulder_z;
    const d2 = u * u + w * w, scale = 2 * upper * fore;
    let unfolded = (d2 - (upper - fore) * (upper - fore)) / scale;
    let unstretched = ((upper + fore) * (upper + fore) - d2) / scale;
    const innermost = 2 * Math.abs(upper - fore) * reach / scale;
    const outermost = 2 * (upper + fore) * reach / scale;
    if (!(unfolded >= -ROUNDING * innermost && unstretched >= -ROUNDING * outermost)) return null;
    if (unstretched <= STRAIGHT * outermost) unstretched = 0;
    if (unfolded <= STRAIGHT * innermost) unfolded = 0;
    const cosG = unfolded - 1, sinG = e.sign3 * flag * Math.sqrt(unfolded * unstretched);
    const along = upper - fore + fore * unfolded, across = fore * sinG;
    const c = along * u + across * w, s = along * w - across * u, length = Math.sqrt(c * c + s * s);
    // equal levers, folded, leave joint 2 free
    const [cosA, sinA] = length === 0 ? [1, s] : [c / length, s / length];

    const [cos2, sin2] = onward([cosA, sinA], turns.upper);
    const [cos3, sin3] = onward([cosG, sinG], turns.fore);
    return {
      q: [Math.atan2(e.sign1 * sin1, cos1), Math.atan2(e.sign2 * sin2, cos2),
          Math.atan2(e.sign3 * sin3, cos3)],
      plane: [cos1, sin1],
      ahead: [cosA * cosG - sinA * sinG, sinA * cosG + cosA * sinG],
    };
  }));
}

const bend = (e, q) => e.fore_angle - e.upper_angle + e.sign3 * q[2];

// How far in front of axis 1 the point is.
function radius(e, q) {
  const elevation = e.upper_angle + e.sign2 * q[1];
  return e.shoulder_x
    + (e.upper * Math.cos(elevation) + e.fore * Math.cos(elevation + bend(e, q)));
}

const elbowHeld = ({geometry: {elbow: e}, tolerances: {SINGULAR}}, q) => ({
  shoulder: Math.abs(radius(e, q)) < SINGULAR * e.reach,
  elbow: Math.abs(Math.sin(bend(e, q))) < SINGULAR,
});

function elbowGap({geometry: {elbow: e}, tolerances: {ROUNDING}}, [x, y, z], front) {
  const rho2 = x * x + y * y, r2 = rho2 - e.lateral * e.lateral;
  if (r2 < -2 * ROUNDING * Math.abs(e.lateral) * e.reach)
    return {kind: "axis", metres: Math.abs(e.lateral) - Math.sqrt(rho2)};
  const d = length2(front * Math.sqrt(Math.max(r2, 0)) - e.shoulder_x, z - e.shoulder_z);
  return worst({stretched: d - (e.upper + e.fore), folded: Math.abs(e.upper - e.fore) - d});
}

// --- The geometries: ik, singularities, free joints, why a row is missing -----------------------

const elbow = {
  ik: (arm, {place}) => elbowRows(arm, place).map(row => (row ? row.q : nowhere(3))),
  held: elbowHeld,
  choose({geometry: {elbow: e}, tolerances: {FREE}}, q, previous) {
    const free = e.lateral === 0 && Math.abs(radius(e, q)) < FREE * e.reach;
    return free ? [previous[0], q[1], q[2]] : q;
  },
  gap: (arm, {place}, row) => elbowGap(arm, place, arm.branches[row][0]),
};

// The wrist's own frame at the tool, as 12 numbers, its origin being the wrist centre.
function wristFrame({geometry: {wrist}}, {rotation, place}) {
  const m = matrix(product(rotation, wrist.from_flange)), [x, y, z] = wrist.centre_from_flange;
  for (let k = 0; k < 3; k++)
    m[4 * k + 3] = place[k] + m[4 * k] * x + m[4 * k + 1] * y + m[4 * k + 2] * z;
  return m;
}

const wrist = {
  ik(arm, pose) {
    const {wrist: {sign5, sign6}, turns} = arm.geometry, m = wristFrame(arm, pose);
    return elbowRows(arm, origin(m)).flatMap(row => {
      if (!row) return [nowhere(6), nowhere(6)];
      // seen from the forearm: axis 4 points ce ahead, se up
      const [cos1, sin1] = row.plane, [ce, se] = onward(row.ahead, turns.axis4);
      const ahead = k => cos1 * m[k] + sin1 * m[4 + k];
      const aside = k => sign5 * (cos1 * m[4 + k] - sin1 * m[k]);
      const below = k => sign5 * (se * ahead(k) - ce * m[8 + k]);
      const aside2 = aside(2), below2 = below(2), cos5 = ce * ahead(2) + se * m[10];
      const length = Math.sqrt(below2 * below2 + aside2 * aside2);
      const stuck = length < arm.tolerances.STUCK, sin5 = stuck ? 0 : length;
      const cos4 = stuck ? 1 : below2 / length, sin4 = stuck ? 0 : aside2 / length;
      const sin6 = sign6 * (cos4 * aside(0) - sin4 * below(0));
      const cos6 = cos4 * aside(1) - sin4 * below(1);
      const q4 = Math.atan2(sin4, cos4), q5 = Math.atan2(sin5, cos5), q6 = Math.atan2(sin6, cos6);
      const one = [...row.q, q4, q5, q6];
      return [one, stuck ? [...one] : [...row.q, opposite(q4), -q5, opposite(q6)]];
    });
  },
  held: (arm, q) =>
    ({...elbowHeld(arm, q), wrist: Math.abs(Math.sin(q[4])) < arm.tolerances.SINGULAR}),
  choose({geometry, tolerances: {NOISY}}, q, previous) {
    if (!(Math.abs(Math.sin(q[4])) < NOISY)) return q;
    const sense = geometry.wrist.sign6 * (Math.cos(q[4]) > 0 ? 1 : -1);
    const half = wrapped(q[3] - previous[3] + sense * (q[5] - previous[5])) / 2;
    return [q[0], q[1], q[2], previous[3] + half, q[4], previous[5] + sense * half];
  },
  gap: (arm, pose, row) => elbowGap(arm, origin(wristFrame(arm, pose)), arm.branches[row][0]),
};

// Equal levers that fold leave joint 1 free.
const folded = (one, two, q2, {geometry: {reach}, tolerances: {FREE}}) =>
  Math.abs(one - two) <= FREE * reach && Math.abs(Math.cos(q2 / 2)) < FREE;

const scara = {
  ik({geometry: {upper, fore, height}, tolerances}, {place: [x, y, z], angle}) {
    const levers = twoLevers(upper, fore, length2(x, y), tolerances);
    return SIGNS.map(flag => {
      if (!levers) return nowhere(4);
      const q1 = Math.atan2(y, x) - flag * levers.ahead, q2 = flag * levers.turn + 0;
      return [wrapped(q1), q2, wrapped(angle - q1 - q2), height - z];
    });
  },
  held: ({tolerances: {SINGULAR}}, q) => ({elbow: Math.abs(Math.sin(q[1])) < SINGULAR}),
  choose(arm, q, previous) {
    const {upper, fore} = arm.geometry;
    const back = folded(upper, fore, q[1], arm) ? q[0] - previous[0] : 0;
    return [q[0] - back, q[1], q[2] + back, q[3]];
  },
  gap({geometry: {upper, fore}}, {place: [x, y]}) {
    const r = length2(x, y);
    return worst({stretched: r - (upper + fore), axis: Math.abs(upper - fore) - r});
  },
};

// From the base to the tip of two links: -0 is 0, atan2 tells them apart, a point does not.
const way = ({base}, [x, y]) => [x - base[0] + 0, y - base[1] + 0];

const twoLink = {
  ik({geometry, tolerances}, {place}) {
    const {l1, l2, reach} = geometry, [x, y] = way(geometry, place);
    const levers = twoLevers(l1, l2, length2(x, y), tolerances);
    const reached = levers && Math.abs(place[2]) <= tolerances.ROUNDING * reach;
    return SIGNS.map(flag => (reached ? [wrapped(Math.atan2(y, x) - flag * levers.ahead) + 0,
                                         wrapped(flag * levers.turn) + 0] : nowhere(2)));
  },
  held: scara.held,
  choose(arm, q, previous) {
    return folded(arm.geometry.l1, arm.geometry.l2, q[1], arm) ? [previous[0], q[1]] : q;
  },
  gap({geometry}, {place}) {
    const {l1, l2} = geometry, d = length2(...way(geometry, place));
    return worst({stretched: d - (l1 + l2), base: Math.abs(l1 - l2) - d,
                  plane: Math.abs(place[2])});
  },
};

const GEOMETRIES = {elbow, wrist, scara, two_link: twoLink};
const UNKNOWN = {held: () => ({}), choose: (arm, q) => q};
const geometryOf = arm => GEOMETRIES[arm.geometry.kind] || UNKNOWN;
const choose = (arm, q, previous) => geometryOf(arm).choose(arm, q, previous);

/**
 * All joint values that bring the flange to a pose of the arm's kind, in the order of its branches.
 * @param {Object} arm
 * @param {{place: number[], rotation?: number[], angle?: number}} pose
 * @returns {number[][]}  a row that does not exist is NaN
 */
export const ik = (arm, pose) => geometryOf(arm).ik(arm, pose);

/**
 * Which singularities hold at q.
 * @param {Object} arm
 * @param {number[]} q
 * @returns {Object<string, boolean>}
 */
export const singularities = (arm, q) => geometryOf(arm).held(arm, q);

// --- Choosing among the rows ---------------------------------------------------------------------

// The limits of a joint with the slack by which it may stand past them.
const room = ({limits, tolerances: {SLACK}}, j) => [limits[j][0] - SLACK, limits[j][1] + SLACK];

/**
 * Which joints can stand at q inside their limits; a turning one at q or whole turns from it.
 * @param {Object} arm
 * @param {number[]} q
 * @returns {boolean[]}
 */
export const within = (arm, q) => q.map((value, j) => {
  const [low, high] = room(arm, j);
  if (arm.prismatic[j]) return value >= low && value <= high;
  return value + TURN * Math.ceil((low - value) / TURN) <= high;
});

/**
 * For each turning joint the value nearest to `near`, whole turns from q.
 * @param {Object} arm
 * @param {number[]} q
 * @param {number[]} near
 * @returns {number[]}
 */
export const unwrapped = (arm, q, near) =>
  q.map((value, j) => (arm.prismatic[j] ? value : wrapped(value, near[j])));

// As `unwrapped`, but inside the limits where there is such a value.
const inside = (arm, q, near) => unwrapped(arm, q, near).map((value, j) => {
  const [low, high] = room(arm, j);
  const up = value + TURN * Math.max(Math.ceil((low - value) / TURN), 0);
  const best = up - TURN * Math.max(Math.ceil((up - high) / TURN), 0);
  return best >= low && best <= high && !arm.prismatic[j] ? best : value;
});

/**
 * Joint values as people read them: inside the limits and nearest to q, else the least past them.
 * @param {Object} arm
 * @param {number[]} q
 * @returns {number[]}
 */
export const representative = (arm, q) => inside(arm, q, q).map((value, j) => {
  const [low, high] = arm.limits[j], [lowest, highest] = room(arm, j);
  if (arm.prismatic[j] || !(value < lowest || value > highest)) return value;
  const above = value - TURN * Math.floor((value - high) / TURN);
  const below = value + TURN * Math.floor((low - value) / TURN);
  return above - high <= low - below ? above : below;
});

// The option with the least travel from q; NaN where there is none.
function leastTravel(options, q) {
  let best = options[0], shortest = Infinity;
  for (const option of options) {
    const travel = option.reduce((sum, value, j) => sum + Math.abs(value - q[j]), 0);
    if (travel < shortest) [best, shortest] = [option, travel];
  }
  return best;
}

/**
 * The row with the least travel from q, each joint inside its limits if it can; NaN if there is
 * none.
 * @param {Object} arm
 * @param {number[][]} rows
 * @param {number[]} q
 * @returns {number[]}
 */
export const nearest = (arm, rows, q) => leastTravel(rows.map(row => inside(arm, row, q)), q);

// Where a motion along one row begins: joints that a singularity leaves free there look ahead to
// the first sample that fixes them.
function start(arm, track) {
  const first = track.find(exists) || track[0];
  const later = track.find(q => {
    const chosen = choose(arm, q, q.map((value, j) => value + j)); // no two shifts cancel
    return chosen.every((value, j) => Math.abs(value - q[j]) <= 1e-12);
  });
  const q = choose(arm, first, later || first).map(value => (Number.isNaN(value) ? 0 : value));
  return inside(arm, q, q);
}

/**
 * One continuous motion through the rows of `ik` along a path: it starts on `row`, then every
 * sample takes the row nearest to the one before. NaN where no row exists.
 * @param {Object} arm
 * @param {number[][][]} samples  the rows of each sample
 * @param {number} row
 * @returns {number[][]}  the posture of each sample
 */
export function follow(arm, samples, row) {
  let before = start(arm, samples.map(rows => rows[row])), started = false;
  return samples.map(rows => {
    const options = (started ? rows : [rows[row]])
      .map(q => choose(arm, unwrapped(arm, q, before), before));
    const q = leastTravel(options, before);
    if (exists(q)) [before, started] = [q, true];
    return q;
  });
}

// --- In words ------------------------------------------------------------------------------------

// One decimal as Python writes it: of two equally near ones the even one.
const oneDecimal = x => ((4 * x) % 1 === 0 ? rint(10 * x) / 10 : x).toFixed(1);
// as `in_words` of units.py
const metresInWords = x => (x < 10 ? `${oneDecimal(x / 1e-3)} mm` : `${oneDecimal(x)} m`);
/**
 * A sentence with its blanks filled.
 * @param {string} sentence
 * @param {Object<string, *>} facts
 * @returns {string}
 */
export const fill = (sentence, facts) => sentence.replace(/\{(\w+)\}/g, (_, name) => facts[name]);

// How joint j stands past its limit.
function excess(arm, q, j) {
  const [low, high] = arm.limits[j], value = representative(arm, q)[j], {name, size} = arm.units[j];
  const over = value > high ? value - high : low - value;
  return fill(arm.sentences.past, {
    joint: j + 1, limit: arm.limits_in_words[j][value > high ? 1 : 0],
    value: oneDecimal(value / size) + name, over: oneDecimal(over / size) + name,
  });
}

/**
 * In one sentence whether a row of `ik` is usable, and if not why: in Python's words.
 * @param {Object} arm
 * @param {{place: number[], rotation?: number[], angle?: number}} pose
 * @param {number} row
 * @returns {string}
 */
export function explain(arm, pose, row) {
  const {sentences, carried: what} = arm, q = ik(arm, pose)[row];
  const flags = arm.branches[row].map(flag => (flag > 0 ? "+1" : "-1")).join(", ");
  if (!exists(q)) {
    const {kind, metres} = geometryOf(arm).gap(arm, pose, row);
    const small = {...pose, place: pose.place.map(x => x / 1000)};
    const meant = metres > 10 && ik(arm, small).some(exists);
    const reason = fill(sentences[kind], {what, gap: metresInWords(metres)});
    return fill(sentences.missing, {row, flags, reason, hint: meant ? sentences.millimetres : "."});
  }
  const past = within(arm, q).flatMap((good, j) => (good ? [] : [excess(arm, q, j)]));
  const held = Object.entries(singularities(arm, q)).filter(([, holds]) => holds);
  const facts = [...past, ...held.map(([name]) => fill(sentences[name], {what}))];
  const kind = past.length ? "not usable" : facts.length ? "usable but" : "usable";
  return fill(sentences[kind], {row, flags, facts: facts.join(", and ")});
}

// --- Three levers: a family of postures for one point --------------------------------------------

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
  const KO = length2(x, y);
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
