// The bench of the motor explorer: its motor, the run of pulses, and the present state of the
// rotor. The model is in rotor.js.

import {advance, atRest, pull, ramp, resting, run} from "./rotor.js";

/** @import {MotorControl, PageMotors} from "./page.js" */
/** @import {Motor, Run} from "./rotor.js" */

const SLOW = 20; // times slower than real time, for a single pulse or a released rotor
const SHOWN = 8; // seconds in which a run is shown
const LONG = 2; // motor seconds: a rotor that does not come to rest is not shown for longer

/** @type {(list: number[]) => number} */
export const lastOf = list => list[list.length - 1];

export class Bench {
  /** @param {PageMotors} data */
  constructor(data) {
    this.data = data;
    this.state = {...data.opening, sign: 1};
    /** `time` of the run, s. The picture shows the run then, if it is `shown`. */
    this.clock = {time: 0, playing: false, shown: false};
    this.motor = this.built();
    this.live = atRest(this.motor, 0);
    this.sent = 0;
    this.held = false;
    this.since = LONG; // motor seconds since it was touched
    this.last = 0; // time of the last picture, ms
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

  /** In SI units. @param {MotorControl["key"]} key */
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

  /** The run with the present choice, computed on demand. */
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

  /** The choice has changed; `other`: to another motor, which begins again. */
  change(other = false) {
    this.motor = this.built();
    this.found = null;
    if (other) this.begin();
    else if (this.clock.playing) this.clock.time = 0;
    else this.wake();
  }

  begin() {
    this.wake();
    [this.live, this.sent, this.since] = [atRest(this.motor, 0), 0, LONG];
  }

  /** The reader has touched it: it no longer shows a run, and the rotor moves by itself. */
  wake() {
    Object.assign(this.clock, {time: 0, playing: false, shown: false});
    this.since = 0;
  }

  /** @param {number} count */
  send(count) {
    this.sent += count;
    this.wake();
  }

  /** Sends pulses to reach a row by the shortest way. @param {number} row */
  sendTo(row) {
    const count = this.motor.currents.length,
      ahead = (((row - this.sent) % count) + count) % count;
    this.send(ahead > count / 2 ? ahead - count : ahead);
  }

  /** The rotor is taken or released. @param {boolean} on */
  hold(on) {
    if (on === this.held) return;
    this.held = on;
    this.live.omega = 0;
    this.wake();
  }

  /** Advances to the time of a picture; returns whether it goes on. @param {number} now  ms */
  moment(now) {
    const passed = this.since === 0 ? 1 / 60 : Math.min(0.05, (now - this.last) / 1000);
    this.last = now;
    if (this.clock.shown) {
      const {t, angle, sent} = this.run(),
        i = t.findLastIndex(x => x <= this.clock.time);
      this.live = {theta: angle[i], omega: 0, currents: [...this.motor.currents[0]]};
      this.sent = sent[i];
      return false; // the clock shows it
    }
    if (this.held || this.since >= LONG) return false;
    this.since += passed / SLOW;
    advance(this.motor, this.live, this.sent, passed / SLOW);
    this.settle();
    return this.since < LONG;
  }

  /** Stops it when the remaining motion is invisible. */
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
