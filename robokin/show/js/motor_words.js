// The sentences of the motor explorer, and the Python code for a motor and a run.

import {lastOf} from "./bench.js";
import {fill, plain} from "./blanks.js";
import {number} from "./canvas.js";
import {behind, holdingTorque, startFrequency, startingTorque, stepOf} from "./rotor.js";
import {table} from "./table.js";
import {degrees} from "./turns.js";

/** @import {MotorControl, PageMotors} from "./page.js" */
/** @import {Bench} from "./bench.js" */

/**
 * The table of the properties of the motor; without loads, only the step and the maximum start
 * frequency.
 * @param {Bench} bench
 * @param {PageMotors} data
 */
export function factTable(bench, {words: says, pulses, rules, alone}) {
  /** @type {<T>(all: T[]) => T[]} */
  const shown = all => all.filter((_, k) => !alone || k === 0 || k === 3);
  const names = shown([
    says.step,
    says.holding,
    says.starting,
    says.startFrequency,
    says.commutation,
  ]);
  const rows = table(
    names,
    [],
    names.map(() => 1),
  );
  rows.node.classList.add("rk-facts");
  /** @type {(x: number) => string} */
  const torque = x => fill(says.torques, {value: number(1000 * x, 1)});
  /** @type {?Bench["motor"]} */
  let told = null;
  /** @type {Map<string, number>} stored, since they take a long time to compute */
  const starts = new Map();
  return {
    node: rows.node,
    tell() {
      const {motor, state} = bench;
      if (motor === told) return;
      told = motor;
      const key = [state.kind, state.motor, state.drive, motor.load, motor.inertia].join();
      const first = starts.get(key) ?? startFrequency(motor, pulses);
      starts.set(key, first);
      const {limit, slowest, nearly} = rules;
      const started = first < limit ? says.perSecond : says.orMore;
      const values = [
        [fill(says.degrees, {value: plain(degrees(stepOf(motor)), 2)})],
        [torque(holdingTorque(motor))],
        [torque(startingTorque(motor))],
        [first ? fill(started, {value: first}) : fill(says.none, {value: slowest})],
        [
          fill(says.perSecond, {
            value: motor.rise ? number(1 / (nearly * motor.rise), 0) : "\u221E",
          }),
        ],
      ];
      rows.set(shown(values));
    },
  };
}

/**
 * The result of a run, as a sentence.
 * @param {Bench} bench
 * @param {PageMotors} data
 */
export function outcome(bench, {words: says, pulses}) {
  const {state} = bench,
    lost = state.sign * bench.run().lost,
    times = bench.times(),
    last = number(1000 * lastOf(times), 0),
    top = Math.max(...times.map((t, k) => 1 / (t - (k ? times[k - 1] : 0))));
  const {start, end} = state;
  let how = says.plain;
  if (state.ramp > 0) how = start < end ? says.ramped : says.flat;
  how = fill(how, {start: number(start, 0), end: number(end, 0), top: number(top, 0)});
  let which = lost > 0 ? says.someLost : says.tooMany;
  if (lost === 0) which = says.allMade;
  else if (lost > pulses) which = says.runsBack;
  const told = fill(which, {pulses, last, how, lost: Math.abs(lost)});
  return `${told} ${fill(says.slow, {slow: bench.slow()})}`;
}

/**
 * The current state of the rotor, as text.
 * @param {Bench} bench
 * @param {PageMotors["words"]} says
 */
export function standing(bench, says) {
  if (bench.held) return says.held;
  if (bench.bent()) return says.tooMuch;
  const lost = behind(bench.motor, bench.live, bench.sent),
    text = lost > 0 ? says.behind : lost < 0 ? says.ahead : says.inStep;
  return fill(text, {sent: number(bench.sent, 0), lost: Math.abs(lost)});
}

/**
 * The Python code that makes the same run.
 * @param {Bench} bench
 * @param {PageMotors} data
 */
export function inCode(bench, {code, pulses}) {
  const {start, end, sign} = bench.state;
  /** @type {(key: MotorControl["key"]) => string} */
  const text = key => String(+bench.value(key).toPrecision(6));
  return fill(code, {
    rotor: bench.kind().rotor,
    motor: bench.kind().motor,
    windings: bench.page().windings,
    drive: bench.drive(),
    pulses,
    sign,
    start: String(Math.min(start, end)),
    end: text("end"),
    ramp: text("ramp"),
    load: text("load"),
    inertia: text("inertia"),
  });
}
