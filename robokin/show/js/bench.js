// The state of the motor explorer: its motor, the run of pulses, and the current state of the
// rotor. The model is in rotor.js.

import {advance, atRest, pull, ramp, resting, run} from "./rotor.js";

/** @import {MotorControl, PageMotors} from "./page.js" */
/** @import {Motor, Run} from "./rotor.js" */

const SLOW = 20; // slow-motion factor for a single pulse or a released rotor
const SHOWN = 8; // seconds: the time in which a run is displayed
const LONG = 2; // seconds of motor time: the longest time for which a moving rotor is shown

/** @type {(list: number[]) => number} */
export const lastOf = list => list[list.length - 1];

export class Bench {
  /** @param {PageMotors} data */
  constructor(data) {
    this.data = data;
    this.state = {...data.opening, sign: 1};
    /** `time` is the time in the run in s. If `shown`, the picture shows the run at that time. */
    this.clock = {time: 0, playing: false, shown: false};
    this.motor = this.built();
    this.live = atRest(this.motor, 0);
    this.sent = 0;
    this.held = false;
    this.since = LONG; // seconds of motor time since the reader touched the motor
    this.last = 0; // time of the last frame, ms
    /** @type {?Run} */
    this.found = null;
  }

  kind() {
    return this.data.kinds[this.state.kind];
  }

  page() {
    return this.kind().motors[this.state.motor];
  }

  drive() {
    return this.data.drives[this.state.drive].key;
  }

  /** The value of a slider in SI units. @param {MotorControl["key"]} key */
  value(key) {
    const {size} = /** @type {MotorControl} */ (this.data.controls.find(each => each.key === key));
    return this.state[key] * size;
  }

  /** @returns {Motor} */
  built() {
    const {own, rules} = this.data;
    return {
      ...this.page(),
      ...own,
      rules,
      currents: this.page().currents[this.drive()],
      load: this.value("load"),
      inertia: own.inertia + this.value("inertia"),
    };
  }

  times() {
    const end = this.value("end");
    return ramp(this.data.pulses, Math.min(this.value("start"), end), end, this.value("ramp"));
  }

  /** The run with the current settings, computed on demand. */
  run() {
    this.found ??= run(this.motor, this.times(), this.state.sign);
    return this.found;
  }

  /** The end of the run, s. */
  end() {
    return lastOf(this.run().t);
  }

  /** How many times slower than real time a run is shown. */
  slow() {
    return Math.max(1, Math.round(SHOWN / this.end()));
  }

  /** The current row of the table. */
  row() {
    const count = this.motor.currents.length;
    return ((this.sent % count) + count) % count;
  }

  /** Whether the load is more than the current row can hold. */
  bent() {
    const [x, y] = pull(this.motor, this.motor.currents[this.row()]);
    return this.motor.load > this.motor.torque * Math.sqrt(x * x + y * y);
  }

  /**
   * Reacts to a changed setting. The rotor starts from rest if its run no longer fits the settings,
   * or if the motor is an `other` one.
   */
  change(other = false) {
    this.motor = this.built();
    this.found = null;
    if (this.clock.playing && !other) this.clock.time = 0;
    else if (this.clock.shown || other) this.begin();
    else this.wake();
  }

  begin() {
    this.wake();
    [this.live, this.sent, this.since] = [atRest(this.motor, 0), 0, LONG];
  }

  /** Stops displaying a run and releases the rotor, since the reader has touched something. */
  wake() {
    Object.assign(this.clock, {time: 0, playing: false, shown: false});
    this.since = 0;
  }

  /** @param {number} count */
  send(count) {
    this.sent += count;
    this.wake();
  }

  /** Sends the fewest pulses that reach a row. @param {number} row */
  sendTo(row) {
    const count = this.motor.currents.length,
      ahead = (((row - this.sent) % count) + count) % count;
    this.send(ahead > count / 2 ? ahead - count : ahead);
  }

  /** Grabs or releases the rotor. @param {boolean} on */
  hold(on) {
    if (on === this.held) return;
    this.held = on;
    this.live.omega = 0;
    this.wake();
  }

  /** Advances to the time of a frame; returns whether another is needed. @param {number} now  ms */
  moment(now) {
    const passed = this.since === 0 ? 1 / 60 : Math.min(0.05, (now - this.last) / 1000);
    this.last = now;
    if (this.clock.shown) {
      const {t, angle, sent} = this.run(),
        i = t.findLastIndex(x => x <= this.clock.time);
      this.live = {theta: angle[i], omega: 0, currents: [...this.motor.currents[0]]};
      this.sent = sent[i];
      return false; // the clock advances the run
    }
    if (this.held || this.since >= LONG) return false;
    this.since += passed / SLOW;
    advance(this.motor, this.live, this.sent, passed / SLOW);
    this.settle();
    return this.since < LONG;
  }

  /** Stops the rotor when its remaining motion is too small to see. */
  settle() {
    const period = (2 * Math.PI) / this.motor.periods,
      rest = resting(this.motor, this.sent),
      off = (this.live.theta - rest) / period;
    const still = Math.abs(off - Math.round(off)) < 1e-3 && Math.abs(this.live.omega) < 1;
    if (!still || this.bent()) return;
    this.live = {...atRest(this.motor, this.sent), theta: rest + period * Math.round(off)};
    this.since = LONG;
  }
}
