// The motor explorer: a stepper motor seen along its shaft, its phase table, and the response of
// its rotor to pulses. Text, tables and poles come from Python (motors.py), the model is in
// rotor.js.

import {Bench} from "./bench.js";
import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {clockRow, runningClock} from "./clock.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {drawCurve} from "./motor_curve.js";
import {gripRadius, motorPicture} from "./motor_picture.js";
import {factTable, inCode, outcome, standing} from "./motor_words.js";
import {beside, frameOf, menu, slider, tick, wordButton} from "./stage.js";
import {table} from "./table.js";
import {degrees, radians} from "./turns.js";

/** @import {PageMotors} from "./page.js" */
/** @import {Handle} from "./handles.js" */

/** @typedef {ReturnType<typeof motorStage>} Stage */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {PageMotors} data
 */
export const explore = (id, data) => waiting(id).forEach(root => motorExplorer(root, data));

/**
 * @param {HTMLElement} root
 * @param {PageMotors} data
 */
function motorExplorer(root, data) {
  const bench = new Bench(data),
    stage = motorStage(root, data, bench),
    {words: says} = data;
  const clock = runWatch(stage, bench, says),
    chosen = choices(stage, bench, data),
    now = pulseRow(stage, bench, clock.row, says);
  const curve = element("canvas", {
    class: "rk-curves rk-run",
    role: "img",
    "aria-label": says.curves,
  });
  const lines = phaseTable(stage, bench, says),
    facts = factTable(bench, data);
  stage.below.append(
    element("div", {class: "rk-beside"}, lines.node, element("div", {}, curve, facts.node)),
  );
  stage.run(
    time => {
      clock.pass(time);
      if (bench.moment(time)) stage.changed();
      clock.tell();
      chosen.tell();
      facts.tell();
      lines.tell();
      const text = standing(bench, says);
      if (now.textContent !== text) now.textContent = text;
      stage.say(outcome(bench, data));
      return bench;
    },
    [curve],
    () => drawCurve(curve, says, bench),
  );
}

/**
 * The frame with its picture, and a handle on the rotor.
 * @param {HTMLElement} root
 * @param {PageMotors} data
 * @param {Bench} bench
 */
function motorStage(root, data, bench) {
  const stage = frameOf(
    root,
    data,
    motorPicture(data, bench, () => stage.changed()),
  );
  const {layer} = stage.handles,
    letGo = () => {
      bench.hold(false);
      stage.changed();
    };
  // so that the rotor is also released after being moved with the keyboard
  layer.addEventListener("keyup", letGo);
  layer.addEventListener("focusout", letGo);
  return stage;
}

/**
 * @param {Bench} bench
 * @param {PageMotors["words"]} says
 * @returns {Handle}
 */
function rotorHandle(bench, says) {
  /** @type {(angle: number) => void} */
  const turnTo = angle => {
    const turn = angle - bench.live.theta;
    bench.live.theta += turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
  };
  const at = () => {
    const {theta} = bench.live,
      r = gripRadius(bench);
    return [r * Math.cos(theta), r * Math.sin(theta), 0];
  };
  return {
    id: "rotor",
    name: says.takeRotor,
    look: "rk-joint",
    mark: bench.page().teeth ? "" : "N",
    at,
    value: () => fill(says.rotorAt, {angle: number(degrees(bench.live.theta), 0)}),
    grab(camera) {
      const [x, y] = camera.to(at()),
        [cx, cy] = camera.to([0, 0, 0]);
      return (dx, dy) => turnTo(Math.atan2(cy - y - dy, x + dx - cx));
    },
    step(right, up, big) {
      bench.hold(true);
      turnTo(bench.live.theta + (up - right) * radians(big ? 30 : 5));
    },
    home: () => bench.begin(),
  };
}

/**
 * The clock of a run. The picture shows the run as soon as the clock starts or is set.
 * @param {Stage} stage
 * @param {Bench} bench
 * @param {PageMotors["words"]} says
 */
function runWatch(stage, bench, says) {
  const parts = clockRow({play: says.run, pause: says.stop});
  const clock = runningClock(
    parts,
    stage.frame,
    bench.clock,
    () => [0, bench.end()],
    () => {
      bench.clock.shown = true;
      stage.changed();
    },
    () => 1 / bench.slow(),
  );
  return {...clock, row: parts.row};
}

/**
 * Adds buttons for single pulses, the clock of a run, and the state of the rotor below the
 * picture.
 * @param {Stage} stage
 * @param {Bench} bench
 * @param {HTMLElement} clock
 * @param {PageMotors["words"]} says
 */
function pulseRow(stage, bench, clock, says) {
  /** @type {(text: string, act: () => void) => HTMLElement} */
  const button = (text, act) =>
    wordButton(text, () => {
      act();
      stage.changed();
    });
  const now = element("p", {class: "rk-state"});
  beside(
    stage.space,
    clock,
    element(
      "div",
      {class: "rk-row"},
      button(says.back, () => bench.send(-1)),
      button(says.on, () => bench.send(1)),
      button(says.begin, () => bench.begin()),
    ),
    now,
  );
  return now;
}

/**
 * The inputs next to the picture.
 * @param {Stage} stage
 * @param {Bench} bench
 * @param {PageMotors} data
 */
function choices(stage, bench, data) {
  const {words: says} = data,
    {state} = bench;
  /** @type {(other: boolean) => void} */
  const changed = other => {
    bench.change(other);
    stage.changed();
  };
  const menus = menusOf(bench, data, () => changed(true));
  const offered = data.alone ? data.controls.filter(({key}) => key === "end") : data.controls;
  const sliders = offered.map(spec =>
    slider(spec, x => {
      state[spec.key] = Math.min(Math.max(x, spec.low), spec.high);
      changed(false);
    }),
  );
  const back = tick(says.backwards, () => {
    state.sign = back.on() ? -1 : 1;
    changed(false);
  });
  const copy = copyButton(says, () => inCode(bench, data));
  stage.side.append(
    ...menus.rows,
    ...sliders.map(s => s.row),
    element("div", {class: "rk-row"}, back.row, copy),
    stage.says,
  );
  return {
    tell() {
      menus.tell();
      offered.forEach((spec, k) => sliders[k].set(state[spec.key]));
    },
  };
}

/**
 * The menus of the motor: rotor and feed, windings (which depend on them), and the drive. A motor
 * that is alone has only the last one.
 * @param {Bench} bench
 * @param {PageMotors} data
 * @param {() => void} changed
 */
function menusOf(bench, {words: says, kinds, drives, alone}, changed) {
  const {state} = bench;
  const kind = menu(
    says.motor,
    kinds.map(k => k.name),
    k => {
      const {windings} = bench.page();
      state.kind = k;
      // keep the number of windings if possible
      state.motor = Math.max(
        0,
        kinds[k].motors.findIndex(m => m.windings === windings),
      );
      changed();
    },
  );
  const counts = kinds.map(({motors}) =>
    menu(
      says.windings,
      motors.map(m => String(m.windings)),
      i => {
        state.motor = i;
        changed();
      },
    ),
  );
  const drive = menu(
    says.drive,
    drives.map(d => d.name),
    k => {
      state.drive = k;
      changed();
    },
  );
  return {
    rows: (alone ? [drive] : [kind, ...counts, drive]).map(each => each.row),
    tell() {
      kind.set(state.kind);
      drive.set(state.drive);
      counts.forEach((count, k) => {
        count.row.style.display = k === state.kind ? "" : "none";
        count.set(state.motor);
      });
    },
  };
}

/**
 * The phase table, which is rebuilt for another motor. Choosing a row switches on its windings.
 * @param {Stage} stage
 * @param {Bench} bench
 * @param {PageMotors["words"]} says
 */
function phaseTable(stage, bench, says) {
  const node = element("div", {class: "rk-lines", role: "group", "aria-label": says.table});
  let shown = "";
  /** @type {?ReturnType<typeof table>} */
  let lines = null;
  /** @type {?HTMLElement} */
  let current = null; // the row that is visible; a new table shows its first rows
  function renew() {
    const {heads, printed} = bench.page();
    lines = table(
      printed[bench.drive()].map((_, k) => String(k + 1)),
      [says.row, ...heads],
      heads.map(() => 1),
      row => {
        bench.sendTo(row);
        stage.changed();
      },
    );
    node.replaceChildren(lines.node);
    current = node.querySelector("tbody tr");
    stage.handles.set([rotorHandle(bench, says)]);
  }
  return {
    node,
    tell() {
      const {kind, motor, drive} = bench.state,
        now = [kind, motor, drive].join();
      if (now !== shown) renew();
      shown = now;
      lines?.set(bench.page().printed[bench.drive()], bench.row());
      /** @type {?HTMLElement} */
      const row = node.querySelector("[aria-current]");
      if (row !== current) scrollTo(node, row); // asking for sizes costs a layout
      current = row;
    },
  };
}

/**
 * Scrolls a box until one of its rows is visible.
 * @param {HTMLElement} box
 * @param {?HTMLElement} row
 */
function scrollTo(box, row) {
  const room = box.clientHeight;
  if (!row || box.scrollHeight <= room) return;
  const {offsetTop: top, offsetHeight: height} = row;
  if (top < box.scrollTop + 24 || top + height > box.scrollTop + room)
    box.scrollTop = top - room / 2;
}
