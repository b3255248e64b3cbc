// The inverse kinematics and the singularities of every geometry (for three levers see levers.js),
// as in arms/elbow.py, spherical_wrist.py, scara.py and two_link.py, which are the reference.
//
// The scripts decide whether a row exists with + - * / and sqrt only, in the same order as Python,
// so that both agree to the last bit. Math.hypot, ** and Math.round differ from NumPy and are not
// used.

import {wrapped} from "./angles.js";
import {origin} from "./kinematics.js";
import {matrix, product} from "./rotations.js";
import {distance2, nowhere} from "./rows.js";
import {SIGNS, twoLevers, worst} from "./two_levers.js";

/**
 * @import {ArmData, ElbowData, ElbowInverse, Inverse, PagePose, ScaraInverse,
 *   TwoLinkInverse, WristInverse} from "./page.js"
 */
/** @import {Gap} from "./two_levers.js" */
/** @import {ArmOf, ClosedFormArm, ScaraPose, TransformPose} from "./kinematics.js" */

/** @typedef {[number, number]} Pair  cosine and sine of one angle */
/** @typedef {Object<string, boolean>} Held  which singularities a posture has */
/** @typedef {{q: number[], plane: Pair, ahead: Pair}} ElbowRow */
/**
 * The functions of one geometry. `ik` returns the rows, `held` the singularities of q, `choose` q
 * with the joints that are free there as in the previous posture, and `gap` the reason why a row is
 * missing.
 * @template {Inverse} G
 * @typedef {{
 *   ik(arm: ArmOf<G>, pose: PagePose): number[][],
 *   held(arm: ArmOf<G>, q: number[]): Held,
 *   choose(arm: ArmOf<G>, q: number[], previous: number[]): number[],
 *   gap(arm: ClosedFormArm & ArmOf<G>, pose: PagePose, row: number): Gap,
 * }} Geometry
 */

/**
 * The pair (cosine, sine) of the sum of an angle and a constant angle.
 * @param {Pair} angle
 * @param {Pair} constant
 * @returns {Pair}
 */
const onward = ([cosine, sine], [c, s]) =>
  s === 0 && c === 1 ? [cosine, sine] : [cosine * c - sine * s, sine * c + cosine * s];

/**
 * The angle half a turn away from q, between -pi and pi.
 * @param {number} q
 */
const opposite = q => (q < 0 || Object.is(q, -0) ? q + Math.PI : q - Math.PI);

// --- Three joints that place a point: `Elbow` ----------------------------------------------------

/**
 * For a pair of flags (front/back, elbow), null or {q, plane, ahead}, as in Elbow.solve: the joint
 * values and the directions (cosine, sine) of the arm's plane and of the forearm's elevation.
 * @param {ArmOf<ElbowInverse | WristInverse>} arm
 * @param {number[]} place
 * @param {number} front
 * @param {number} flag
 * @returns {?ElbowRow}
 */
export function elbowRow({geometry: {elbow: e, turns}, tolerances}, [x, y, z], front, flag) {
  const {ROUNDING, STRAIGHT, FREE} = tolerances,
    {upper, fore, reach, lateral: b} = e;
  const rho2 = x * x + y * y,
    r2 = rho2 - b * b,
    tiny = FREE * reach;
  if (!(r2 >= -2 * ROUNDING * Math.abs(b) * reach)) return null;
  const free = rho2 <= tiny * tiny,
    r = front * Math.sqrt(Math.max(r2, 0));
  const cos1 = free ? front : (x * r + y * b) / rho2;
  const sin1 = (free ? 0 : (y * r - x * b) / rho2) + 0;

  const u = r - e.shoulder_x,
    w = z - e.shoulder_z;
  const d2 = u * u + w * w,
    scale = 2 * upper * fore;
  let unfolded = (d2 - (upper - fore) * (upper - fore)) / scale;
  let unstretched = ((upper + fore) * (upper + fore) - d2) / scale;
  const innermost = (2 * Math.abs(upper - fore) * reach) / scale;
  const outermost = (2 * (upper + fore) * reach) / scale;
  if (!(unfolded >= -ROUNDING * innermost && unstretched >= -ROUNDING * outermost)) return null;
  if (unstretched <= STRAIGHT * outermost) unstretched = 0;
  if (unfolded <= STRAIGHT * innermost) unfolded = 0;
  const cosG = unfolded - 1,
    sinG = e.sign3 * flag * Math.sqrt(unfolded * unstretched);
  const along = upper - fore + fore * unfolded,
    across = fore * sinG;
  const c = along * u + across * w,
    s = along * w - across * u,
    length = Math.sqrt(c * c + s * s);
  // joint 2 is free if the links have equal lengths and are folded
  const [cosA, sinA] = length === 0 ? [1, s] : [c / length, s / length];

  const [cos2, sin2] = onward([cosA, sinA], turns.upper);
  const [cos3, sin3] = onward([cosG, sinG], turns.fore);
  return {
    q: [
      Math.atan2(e.sign1 * sin1, cos1),
      Math.atan2(e.sign2 * sin2, cos2),
      Math.atan2(e.sign3 * sin3, cos3),
    ],
    plane: [cos1, sin1],
    ahead: [cosA * cosG - sinA * sinG, sinA * cosG + cosA * sinG],
  };
}

/**
 * `elbowRow` for each pair of flags.
 * @param {ArmOf<ElbowInverse | WristInverse>} arm
 * @param {number[]} place
 */
const elbowRows = (arm, place) =>
  SIGNS.flatMap(front => SIGNS.map(flag => elbowRow(arm, place, front, flag)));

/**
 * @param {ElbowData} e
 * @param {number[]} q
 */
const bend = (e, q) => e.fore_angle - e.upper_angle + e.sign3 * q[2];

/**
 * The distance of the point from axis 1, positive in front of the axis.
 * @param {ElbowData} e
 * @param {number[]} q
 */
function radius(e, q) {
  const elevation = e.upper_angle + e.sign2 * q[1];
  return e.shoulder_x + (e.upper * Math.cos(elevation) + e.fore * Math.cos(elevation + bend(e, q)));
}

/**
 * @param {ArmOf<ElbowInverse | WristInverse>} arm
 * @param {number[]} q
 */
const elbowHeld = ({geometry: {elbow: e}, tolerances: {SINGULAR}}, q) => ({
  shoulder: Math.abs(radius(e, q)) < SINGULAR * e.reach,
  elbow: Math.abs(Math.sin(bend(e, q))) < SINGULAR,
});

/**
 * @param {ArmOf<ElbowInverse | WristInverse>} arm
 * @param {number[]} place
 * @param {number} front
 * @returns {Gap}
 */
function elbowGap({geometry: {elbow: e}, tolerances: {ROUNDING}}, [x, y, z], front) {
  const rho2 = x * x + y * y,
    r2 = rho2 - e.lateral * e.lateral;
  if (r2 < -2 * ROUNDING * Math.abs(e.lateral) * e.reach)
    return {kind: "axis", metres: Math.abs(e.lateral) - Math.sqrt(rho2)};
  const d = distance2(front * Math.sqrt(Math.max(r2, 0)) - e.shoulder_x, z - e.shoulder_z);
  return worst({stretched: d - (e.upper + e.fore), folded: Math.abs(e.upper - e.fore) - d});
}

// --- The geometries: ik, singularities, free joints, why a row is missing ------------------------

/** @type {Geometry<ElbowInverse>} */
const elbow = {
  ik: (arm, {place}) => elbowRows(arm, place).map(row => (row ? row.q : nowhere(3))),
  held: elbowHeld,
  choose({geometry: {elbow: e}, tolerances: {FREE}}, q, previous) {
    const free = e.lateral === 0 && Math.abs(radius(e, q)) < FREE * e.reach;
    return free ? [previous[0], q[1], q[2]] : q;
  },
  gap: (arm, {place}, row) => elbowGap(arm, place, arm.branches[row][0]),
};

/**
 * The frame of the wrist for a pose of the flange, as 12 numbers. Its origin is the wrist centre.
 * @param {ArmOf<WristInverse>} arm
 * @param {TransformPose} pose
 */
function wristFrame({geometry: {wrist}}, {rotation, place}) {
  const m = matrix(product(rotation, wrist.from_flange)),
    [x, y, z] = wrist.centre_from_flange;
  for (let k = 0; k < 3; k++)
    m[4 * k + 3] = place[k] + m[4 * k] * x + m[4 * k + 1] * y + m[4 * k + 2] * z;
  return m;
}

/** @type {Geometry<WristInverse>} */
const wrist = {
  ik(arm, /** @type {TransformPose} */ pose) {
    const {
        wrist: {sign5, sign6},
        turns,
      } = arm.geometry,
      m = wristFrame(arm, pose);
    return elbowRows(arm, origin(m)).flatMap(row => {
      if (!row) return [nowhere(6), nowhere(6)];
      // in the frame of the forearm, axis 4 points forward by ce and up by se
      const [cos1, sin1] = row.plane,
        [ce, se] = onward(row.ahead, turns.axis4);
      /** @type {(k: number) => number} */
      const ahead = k => cos1 * m[k] + sin1 * m[4 + k];
      /** @type {(k: number) => number} */
      const aside = k => sign5 * (cos1 * m[4 + k] - sin1 * m[k]);
      /** @type {(k: number) => number} */
      const below = k => sign5 * (se * ahead(k) - ce * m[8 + k]);
      const aside2 = aside(2),
        below2 = below(2),
        cos5 = ce * ahead(2) + se * m[10];
      const length = Math.sqrt(below2 * below2 + aside2 * aside2);
      const stuck = length < arm.tolerances.STUCK,
        sin5 = stuck ? 0 : length;
      const cos4 = stuck ? 1 : below2 / length,
        sin4 = stuck ? 0 : aside2 / length;
      const sin6 = sign6 * (cos4 * aside(0) - sin4 * below(0));
      const cos6 = cos4 * aside(1) - sin4 * below(1);
      const q4 = Math.atan2(sin4, cos4),
        q5 = Math.atan2(sin5, cos5),
        q6 = Math.atan2(sin6, cos6);
      const one = [...row.q, q4, q5, q6];
      return [one, stuck ? [...one] : [...row.q, opposite(q4), -q5, opposite(q6)]];
    });
  },
  held: (arm, q) => ({
    ...elbowHeld(arm, q),
    wrist: Math.abs(Math.sin(q[4])) < arm.tolerances.SINGULAR,
  }),
  choose({geometry, tolerances: {NOISY}}, q, previous) {
    if (!(Math.abs(Math.sin(q[4])) < NOISY)) return q;
    const sense = geometry.wrist.sign6 * (Math.cos(q[4]) > 0 ? 1 : -1);
    const half = wrapped(q[3] - previous[3] + sense * (q[5] - previous[5])) / 2;
    return [q[0], q[1], q[2], previous[3] + half, q[4], previous[5] + sense * half];
  },
  gap: (arm, /** @type {TransformPose} */ pose, row) =>
    elbowGap(arm, origin(wristFrame(arm, pose)), arm.branches[row][0]),
};

/**
 * Whether two links of equal lengths are folded, so that joint 1 is free.
 * @param {number} one
 * @param {number} two
 * @param {number} q2
 * @param {ArmOf<ScaraInverse | TwoLinkInverse>} arm
 */
const folded = (one, two, q2, {geometry: {reach}, tolerances: {FREE}}) =>
  Math.abs(one - two) <= FREE * reach && Math.abs(Math.cos(q2 / 2)) < FREE;

/** @type {(arm: ArmData, q: number[]) => Held} */
const stretched = ({tolerances: {SINGULAR}}, q) => ({elbow: Math.abs(Math.sin(q[1])) < SINGULAR});

/** @type {Geometry<ScaraInverse>} */
const scara = {
  ik(arm, /** @type {ScaraPose} */ {place: [x, y, z], angle}) {
    const {
      geometry: {upper, fore, height},
      tolerances,
    } = arm;
    const levers = twoLevers(upper, fore, distance2(x, y), tolerances);
    return SIGNS.map(flag => {
      if (!levers) return nowhere(4);
      const q1 = Math.atan2(y, x) - flag * levers.ahead,
        q2 = flag * levers.turn + 0;
      return [wrapped(q1), q2, wrapped(angle - q1 - q2), height - z];
    });
  },
  held: stretched,
  choose(arm, q, previous) {
    const {upper, fore} = arm.geometry;
    const back = folded(upper, fore, q[1], arm) ? q[0] - previous[0] : 0;
    return [q[0] - back, q[1], q[2] + back, q[3]];
  },
  gap({geometry: {upper, fore}}, {place: [x, y]}) {
    const r = distance2(x, y);
    return worst({stretched: r - (upper + fore), axis: Math.abs(upper - fore) - r});
  },
};

/**
 * The vector from the base to the tip of two links. -0 becomes 0, since atan2 distinguishes them
 * although the point is the same.
 * @param {TwoLinkInverse} geometry
 * @param {number[]} place
 * @returns {Pair}
 */
const way = ({base}, [x, y]) => [x - base[0] + 0, y - base[1] + 0];

/** @type {Geometry<TwoLinkInverse>} */
const twoLink = {
  ik({geometry, tolerances}, {place}) {
    const {l1, l2, reach} = geometry,
      [x, y] = way(geometry, place);
    const levers = twoLevers(l1, l2, distance2(x, y), tolerances);
    const flat = Math.abs(place[2]) <= tolerances.ROUNDING * reach;
    return SIGNS.map(flag =>
      levers && flat
        ? [wrapped(Math.atan2(y, x) - flag * levers.ahead) + 0, wrapped(flag * levers.turn) + 0]
        : nowhere(2),
    );
  },
  held: stretched,
  choose(arm, q, previous) {
    return folded(arm.geometry.l1, arm.geometry.l2, q[1], arm) ? [previous[0], q[1]] : q;
  },
  gap({geometry}, {place}) {
    const {l1, l2} = geometry,
      d = distance2(...way(geometry, place));
    return worst({
      stretched: d - (l1 + l2),
      base: Math.abs(l1 - l2) - d,
      plane: Math.abs(place[2]),
    });
  },
};

/** @type {Object<string, Geometry<Inverse>>} */
const GEOMETRIES = {elbow, wrist, scara, two_link: twoLink};
/** @type {Pick<Geometry<Inverse>, "held" | "choose">} */
const UNKNOWN = {held: () => ({}), choose: (arm, q) => q};

/**
 * The functions of an arm's geometry; a geometry without an inverse has only `held` and `choose`.
 * @param {ArmData} arm
 */
export const geometryOf = arm =>
  /** @type {Geometry<Inverse>} */ (GEOMETRIES[String(arm.geometry.kind)] || UNKNOWN);

/**
 * All joint values that bring the flange to a target pose, in the order of the arm's branches.
 * @param {ArmData} arm
 * @param {PagePose} pose
 * @returns {number[][]}  a row that does not exist is NaN
 */
export const ik = (arm, pose) => geometryOf(arm).ik(arm, pose);

/**
 * The singularities that the posture q has.
 * @param {ArmData} arm
 * @param {number[]} q
 * @returns {Held}
 */
export const singularities = (arm, q) => geometryOf(arm).held(arm, q);
