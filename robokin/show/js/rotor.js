// The rotor of a stepper motor, as in steppers/rotor.py, with the same equations and integration
// steps. test_motor_explorer.py compares the two.

/** @import {MotorNumbers, MotorRules, PageMotor} from "./page.js" */

/**
 * A motor of PageMotors with one of its drives.
 *
 * turn      the angle between neighbouring windings, rad
 * periods   periods of the pull in one revolution of the rotor
 * sharp     1 if a pull is proportional to the current, 2 if it is proportional to its square
 * currents  the rows of the phase table
 * load      N m, always backwards
 *
 * @typedef {Pick<PageMotor, "turn" | "periods" | "sharp"> & MotorNumbers &
 *   {currents: number[][], load: number, rules: MotorRules}} Motor
 */
/** @typedef {{theta: number, omega: number, currents: number[]}} State */
/**
 * The result of a run: angles in rad and pulses sent, at times in s; steps lost at the end.
 * @typedef {{t: number[], angle: number[], sent: number[], lost: number}} Run
 */
/** @typedef {[x: number, y: number]} Pull  direction and strength */

/**
 * The pull of the currents.
 * @param {Motor} motor
 * @param {number[]} currents
 */
export const pull = (motor, currents) => summed(currents, ...waysOf(motor), motor.sharp);
/** @type {(motor: Motor) => [across: number[], along: number[]]} */
const waysOf = ({turn, currents: [row]}) => [
  row.map((_, k) => Math.cos(turn * k)),
  row.map((_, k) => Math.sin(turn * k)),
];
/**
 * @param {number[]} currents
 * @param {number[]} across
 * @param {number[]} along
 * @param {number} sharp
 * @returns {Pull}
 */
function summed(currents, across, along, sharp) {
  let x = 0,
    y = 0;
  for (let k = 0; k < currents.length; k++) {
    const much = sharp === 2 ? currents[k] * currents[k] : currents[k];
    x += much * across[k];
    y += much * along[k];
  }
  return [x, y];
}

/** One step of the rotor, rad. @param {Motor} motor */
export const stepOf = motor => (2 * Math.PI) / (motor.currents.length * motor.periods);
/** @type {(pull: Pull) => number} */
const strength = ([x, y]) => Math.sqrt(x * x + y * y);
/** @type {(motor: Motor) => Pull[]} */
const pulls = motor => motor.currents.map(row => pull(motor, row));

/** The greatest load that every row can hold. @param {Motor} motor */
export const holdingTorque = motor => motor.torque * Math.min(...pulls(motor).map(strength));
/** The greatest load that the motor can move from every row to the next. @param {Motor} motor */
export function startingTorque(motor) {
  const all = pulls(motor);
  return (
    motor.torque *
    Math.min(
      ...all.map(([x, y], k) => {
        const [u, v] = all[(k + 1) % all.length];
        const [a, b] = [u - x, v - y],
          share = Math.min(1, Math.max(0, -(x * a + y * b) / (a * a + b * b)));
        return strength([x + share * a, y + share * b]);
      }),
    )
  );
}

/**
 * The rest position in rad in the row after `sent` pulses from row 0.
 * @param {Motor} motor
 * @param {number} sent
 */
export function resting(motor, sent) {
  const all = pulls(motor),
    n = all.length,
    [x, y] = all[0],
    row = ((sent % n) + n) % n;
  const bent = Math.asin(
    Math.min(1, Math.max(-1, motor.load / (motor.torque * strength(all[row])))),
  );
  return (Math.atan2(y, x) + ((2 * Math.PI) / n) * sent - bent) / motor.periods;
}

/**
 * The longest integration step, and the time until the rotor is at rest.
 * @param {Motor} motor
 */
function rhythm(motor) {
  const most = Math.max(...pulls(motor).map(strength));
  const swing = Math.sqrt(motor.inertia / (motor.periods * motor.torque * most)),
    {fine, settled} = motor.rules;
  return {
    longest: Math.min(
      fine[0] * Math.min(swing, motor.inertia / motor.damping),
      fine[1] * motor.rise || Infinity,
    ),
    settle:
      settled *
      Math.max(
        (2 * motor.inertia) / motor.damping,
        (motor.damping * swing * swing) / motor.inertia,
      ),
  };
}

/**
 * A rotor at rest in the row after `sent` pulses.
 * @param {Motor} motor
 * @param {number} sent
 * @returns {State}
 */
export const atRest = (motor, sent) => ({
  theta: resting(motor, sent),
  omega: 0,
  currents: [...rowOf(motor, sent)],
});
/** @type {(motor: Motor, sent: number) => number[]} */
const rowOf = ({currents}, sent) =>
  currents[((sent % currents.length) + currents.length) % currents.length];

/**
 * Advances `state` by some seconds with the fourth-order Runge-Kutta method.
 * @param {Motor} motor
 * @param {State} state
 * @param {number} sent  the pulses, which determine the row that is on
 * @param {number} seconds
 * @param {?(elapsed: number) => void} [each]  called after each step
 * @param {number} [longest]  the longest step, s
 */
export function advance(motor, state, sent, seconds, each = null, longest = rhythm(motor).longest) {
  const goal = rowOf(motor, sent),
    count = Math.ceil(seconds / longest),
    [across, along] = waysOf(motor);
  if (!count) return;
  const {periods, sharp, torque, inertia, damping, load, rise} = motor,
    h = seconds / count,
    {currents} = state;
  const left = rise ? Math.exp(-h / 2 / rise) : 0;
  /** @type {(i: number[]) => Pull} */
  const now = i => summed(i, across, along, sharp);
  const nearer = () => {
    for (let k = 0; k < goal.length; k++) currents[k] = goal[k] + (currents[k] - goal[k]) * left;
  };
  /** @type {(pull: Pull, theta: number, omega: number) => number} */
  const faster = ([x, y], theta, omega) => {
    const a = periods * theta;
    return (torque * (y * Math.cos(a) - x * Math.sin(a)) - (damping * omega + load)) / inertia;
  };
  let p0 = now(rise ? currents : goal);
  for (let i = 0; i < count; i++) {
    nearer();
    const p1 = now(currents);
    nearer();
    const p2 = now(currents),
      {theta, omega} = state;
    const a0 = faster(p0, theta, omega);
    const w1 = omega + (h / 2) * a0,
      a1 = faster(p1, theta + (h / 2) * omega, w1);
    const w2 = omega + (h / 2) * a1,
      a2 = faster(p1, theta + (h / 2) * w1, w2);
    const w3 = omega + h * a2,
      a3 = faster(p2, theta + h * w2, w3);
    state.theta += (h / 6) * (omega + 2 * w1 + 2 * w2 + w3);
    state.omega += (h / 6) * (a0 + 2 * a1 + 2 * a2 + a3);
    p0 = p2;
    if (each) each((i + 1) * h);
  }
}

/**
 * Simulates a run from rest in row 0, with pulses of one sign at these times, until the rotor is at
 * rest.
 * @param {Motor} motor
 * @param {number[]} times
 * @param {number} sign
 * @returns {Run}
 */
export function run(motor, times, sign) {
  const found = {t: [0], angle: [resting(motor, 0)], sent: [0]};
  const lost = lostOf(motor, times, sign, (time, state, sent) => {
    found.t.push(time);
    found.angle.push(state.theta);
    found.sent.push(sent);
  });
  return {...found, lost};
}

/**
 * @param {Motor} motor
 * @param {number[]} times
 * @param {number} [sign]
 * @param {?(time: number, state: State, sent: number) => void} [each]  called after each step
 */
function lostOf(motor, times, sign = 1, each = null) {
  const state = atRest(motor, 0),
    {longest, settle} = rhythm(motor),
    ends = [...times, (times.at(-1) ?? 0) + settle];
  ends.forEach((end, k) => {
    const since = k ? ends[k - 1] : 0;
    advance(
      motor,
      state,
      sign * k,
      end - since,
      each && (elapsed => each(since + elapsed, state, sign * k)),
      longest,
    );
  });
  return behind(motor, state, sign * times.length);
}

/**
 * How many steps the rotor is behind the pulses sent.
 * @param {Motor} motor
 * @param {Pick<State, "theta">} state
 * @param {number} sent
 */
export const behind = (motor, state, sent) =>
  rounded((resting(motor, sent) - state.theta) / stepOf(motor));

/**
 * The times of pulses, as in Python's `ramp`.
 * @param {number} count
 * @param {number} start  pulses per second
 * @param {number} end  pulses per second
 * @param {number} seconds  the time from one frequency to the other
 */
export function ramp(count, start, end, seconds) {
  const more = seconds > 0 ? (end - start) / seconds : 0,
    low = more ? start : end;
  const top = Math.min(end, Math.sqrt(low * low + more * count)),
    up = more ? (top - low) / more : 0;
  const done = ((low + top) / 2) * up,
    duration = 2 * up + (count - 2 * done) / top;
  return Array.from({length: count}, (_, i) => {
    const k = i + 1,
      ahead = Math.min(k, count - k);
    const since =
      ahead < done
        ? (2 * ahead) / (low + Math.sqrt(low * low + 2 * more * ahead))
        : up + (ahead - done) / top;
    return k <= count - k ? since : duration - since;
  });
}

/**
 * The maximum start frequency in pulses per second, as in `Stepper.start_frequency`; 0 if there is
 * none.
 * @param {Motor} motor
 * @param {number} count
 */
export function startFrequency(motor, count) {
  const {slowest, limit} = motor.rules;
  let low = slowest - 1,
    high = limit + 1;
  while (high - low > 1) {
    const middle = Math.floor((low + high) / 2);
    if (lostOf(motor, ramp(count, middle, middle, 0))) high = middle;
    else low = middle;
  }
  return low < slowest ? 0 : low;
}

/** The nearest integer, without a negative zero. @type {(x: number) => number} */
const rounded = x => Math.round(x) || 0;
