// The motor explorer: a stepper motor seen along its shaft, its phase table, and what its rotor
// makes of the pulses. What is said, the tables and the poles come from Python (motors.py), the law
// is rotor.js.

import {fill} from "./blanks.js";
import {
  colors,
  number,
  polygon,
  prepared,
  replaceStill,
  shape,
  spot,
  stroke,
  upright,
  words,
} from "./canvas.js";
import {pictures} from "./controls.js";
import {copyButton} from "./copy.js";
import {control, element, waiting} from "./elements.js";
import {
  advance,
  atRest,
  behind,
  holdingTorque,
  pull,
  ramp,
  resting,
  run,
  startFrequency,
  startingTorque,
  stepOf,
} from "./rotor.js";
import {menu, slider, table, tick} from "./stage.js";
import {degrees, plain, radians} from "./turns.js";

/** @import {MotorControl, PageMotor, PageMotors} from "./page.js" */
/** @import {Context, Pixel} from "./canvas.js" */
/** @import {Motor, Run} from "./rotor.js" */

/** @typedef {(angle: number, r: number) => Pixel} Round  a place around the shaft */

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {PageMotors} data
 */
export const explore = (id, data) => waiting(id).forEach(root => motorExplorer(root, data));

const SLOW = 20; // times slower than time, for a single pulse or a rotor that is let go
const SHOWN = 8; // seconds that a run takes to show
const LONG = 2; // seconds of the motor: longer no rotor is watched that does not come to rest

/** @type {(list: number[]) => number} */
const lastOf = list => list[list.length - 1];

/**
 * @param {HTMLElement} root
 * @param {PageMotors} data
 */
function motorExplorer(root, data) {
  const {words: says, pulses} = data,
    state = {...data.opening, sign: 1};
  const canvas = control("canvas", {class: "rk-shaft", role: "img", "aria-label": data.alt});
  const grip = control("button", {type: "button", class: "rk-handle", "data-handle": "rotor"});
  const layer = element("div", {class: "rk-handles"}, grip),
    told = element("p", {class: "rk-says", role: "status"});
  const now = element("p", {class: "rk-state"}),
    lines = element("div", {class: "rk-lines", role: "group", "aria-label": says.table});
  const curve = element("canvas", {
    class: "rk-curves rk-run",
    role: "img",
    "aria-label": says.curves,
  });
  const facts = table(
    [says.step, says.holding, says.starting, says.startFrequency, says.commutation],
    [],
    [1, 1, 1, 1, 1],
  );
  facts.node.classList.add("rk-facts");

  // --- What is chosen, and what follows from it

  const kind = () => data.kinds[state.kind],
    page = () => kind().motors[state.motor],
    drive = () => data.drives[state.drive].key;
  /** @type {() => Motor} */
  const motorNow = () => ({
    ...page(),
    ...data.own,
    rules: data.rules,
    currents: page().currents[drive()],
    load: value("load"),
    inertia: data.own.inertia + value("inertia"),
  });
  const sizes = Object.fromEntries(data.controls.map(({key, size}) => [key, size]));
  /** In SI units. @type {(key: MotorControl["key"]) => number} */
  const value = key => state[key] * sizes[key];
  let motor = motorNow(),
    live = atRest(motor, 0),
    sent = 0,
    held = false,
    last = 0,
    since = 0;
  /** @type {Run} */
  let found = {t: [0], angle: [0], sent: [0], lost: 0};
  /** @type {?{begun: ?number, slow: number}} */
  let playing = null;
  /** @type {?ReturnType<typeof table>} */
  let lineTable = null;
  const times = () =>
    ramp(pulses, Math.min(value("start"), value("end")), value("end"), value("ramp"));
  function begin() {
    [live, sent, playing, since] = [atRest(motor, 0), 0, null, LONG];
    ask();
  }
  let stale = false;
  /** @type {Object<string, number>} */
  let starts = {};
  function changed(other = false) {
    // `other`: another motor, another table
    motor = motorNow();
    stale = true;
    if (other) {
      newTable();
      starts = {};
      begin();
    } else if (playing)
      play(); // the same from the start, with the new numbers
    else wake();
  }
  function computed() {
    // once for every picture in which something has changed
    if (!stale) return;
    stale = false;
    found = run(motor, times(), state.sign);
    tell();
  }
  function newTable() {
    const rows = page().printed[drive()];
    lineTable = table(
      rows.map((_, k) => String(k + 1)),
      [says.row, ...page().heads],
      page().heads.map(() => 1),
      take,
    );
    lines.replaceChildren(lineTable.node);
  }
  /** @param {number} row */
  function take(row) {
    // the nearest way round to this row
    const n = motor.currents.length,
      ahead = (((row - sent) % n) + n) % n;
    playing = null;
    sent += ahead > n / 2 ? ahead - n : ahead;
    wake();
  }
  function wake() {
    since = 0;
    ask();
  }
  function play() {
    computed();
    playing = {begun: null, slow: Math.max(1, Math.round(SHOWN / lastOf(found.t)))};
    ask();
  }

  // --- What can be taken hold of

  /** @type {(text: string, act: () => void) => HTMLButtonElement} */
  const button = (text, act) => {
    const node = control("button", {type: "button", class: "rk-word"}, text);
    node.addEventListener("click", act);
    return node;
  };
  /** @type {(sign: number) => () => void} */
  const pulse = sign => () => {
    playing = null;
    sent += sign;
    wake();
  };
  const runs = button(says.run, () => {
    if (playing) {
      playing = null;
      wake();
    } else play();
  });
  const back = tick(says.backwards, () => {
    state.sign = back.on() ? -1 : 1;
    changed();
  });
  const kinds = menu(
    says.motor,
    data.kinds.map(k => k.name),
    k => {
      const n = page().windings;
      state.kind = k;
      const same = kind().motors.findIndex(m => m.windings === n);
      state.motor = Math.max(0, same);
      changed(true);
    },
  );
  const counts = data.kinds.map(k =>
    menu(
      says.windings,
      k.motors.map(m => String(m.windings)),
      i => {
        state.motor = i;
        changed(true);
      },
    ),
  );
  const drives = menu(
    says.drive,
    data.drives.map(d => d.name),
    k => {
      state.drive = k;
      changed(true);
    },
  );
  const sliders = data.controls.map(spec =>
    slider(spec, x => {
      state[spec.key] = Math.min(Math.max(x, spec.low), spec.high);
      changed();
    }),
  );
  grip.addEventListener("pointerdown", event => {
    grip.setPointerCapture(event.pointerId);
    hold(true);
  });
  grip.addEventListener("pointermove", event => {
    if (!held || !grip.hasPointerCapture(event.pointerId)) return;
    const box = canvas.getBoundingClientRect(),
      x = event.clientX - box.left - box.width / 2,
      y = box.top + box.height / 2 - event.clientY;
    const turn = Math.atan2(y, x) - live.theta;
    live.theta += turn - 2 * Math.PI * Math.round(turn / (2 * Math.PI));
    ask();
  });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    grip.addEventListener(end, () => hold(false));
  /** @type {Object<string, number>} */
  const KEYS = {ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1};
  grip.addEventListener("keydown", event => {
    const way = KEYS[event.key];
    if (way) {
      hold(true);
      live.theta += way * radians(event.shiftKey ? 30 : 5);
      ask();
    } else if (event.key === "Home") begin();
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  grip.addEventListener("keyup", event => {
    if (event.key in KEYS) hold(false);
  });
  grip.addEventListener("blur", () => hold(false));
  /** @param {boolean} on */
  function hold(on) {
    if (on === held) return;
    if (on) playing = null;
    held = on;
    live.omega = 0;
    wake();
  }

  const frame = element(
    "div",
    {class: "rk rk-motor", role: "group", "aria-label": data.title},
    element("div", {class: "rk-title"}, data.title),
    element(
      "div",
      {class: "rk-views rk-asked"},
      element(
        "div",
        {},
        element("div", {class: "rk-space"}, canvas, layer),
        element(
          "div",
          {class: "rk-row"},
          button(says.back, pulse(-1)),
          button(says.on, pulse(1)),
          runs,
          button(says.begin, begin),
        ),
        now,
      ),
      element(
        "div",
        {class: "rk-side"},
        kinds.row,
        ...counts.map(c => c.row),
        drives.row,
        ...sliders.map(s => s.row),
        element("div", {class: "rk-row"}, back.row, copyButton(says, inCode)),
        told,
      ),
    ),
    element(
      "div",
      {class: "rk-below"},
      element("div", {class: "rk-beside"}, lines, element("div", {}, curve, facts.node)),
    ),
    element("p", {class: "rk-meant"}, data.meant),
  );
  replaceStill(root, frame, canvas, curve);

  // --- What is said

  function tell() {
    kinds.set(state.kind);
    counts.forEach((c, k) => {
      c.row.style.display = k === state.kind ? "" : "none";
      c.set(state.motor);
    });
    drives.set(state.drive);
    data.controls.forEach((spec, k) => sliders[k].set(state[spec.key]));
    const lost = state.sign * found.lost,
      end = number(state.end, 0),
      ramps = state.ramp > 0 && state.start < state.end;
    const gaps = times(),
      top = Math.max(...gaps.map((t, k) => 1 / (t - (k ? gaps[k - 1] : 0))));
    const how = ramps
      ? fill(says.ramped, {start: number(state.start, 0), top: number(top, 0)})
      : fill(says.plain, {end});
    const which =
      lost === 0
        ? says.allMade
        : lost > pulses
          ? says.runsBack
          : lost > 0
            ? says.someLost
            : says.tooMany;
    const slow = Math.max(1, Math.round(SHOWN / lastOf(found.t)));
    const text = `${fill(which, {pulses, how, lost: Math.abs(lost)})} ${fill(says.slow, {slow})}`;
    if (told.textContent !== text) told.textContent = text;
    const {slowest, limit, nearly} = data.rules,
      first = (starts[`${motor.load} ${motor.inertia}`] ??= startFrequency(motor, pulses));
    /** @type {(x: number) => string} */
    const torque = x => fill(says.torques, {value: number(1000 * x, 1)});
    facts.set([
      [fill(says.degrees, {value: plain(degrees(stepOf(motor)), 2)})],
      [torque(holdingTorque(motor))],
      [torque(startingTorque(motor))],
      [
        first
          ? fill(first < limit ? says.perSecond : says.orMore, {value: first})
          : fill(says.none, {value: slowest}),
      ],
      [fill(says.perSecond, {value: motor.rise ? number(1 / (nearly * motor.rise), 0) : "\u221E"})],
    ]);
  }
  /** @type {(theta: number, sentNow: number) => void} */
  function tellNow(theta, sentNow) {
    lineTable?.set(
      page().printed[drive()],
      ((sentNow % motor.currents.length) + motor.currents.length) % motor.currents.length,
    );
    const mark = /** @type {?HTMLElement} */ (lines.querySelector("[aria-current]")),
      room = lines.clientHeight;
    if (
      mark &&
      lines.scrollHeight > room &&
      (mark.offsetTop < lines.scrollTop + 24 ||
        mark.offsetTop + mark.offsetHeight > lines.scrollTop + room)
    )
      lines.scrollTop = mark.offsetTop - room / 2;
    const lost = behind(motor, {theta}, sentNow),
      facts = {sent: number(sentNow, 0), lost: Math.abs(lost)};
    const text = held
      ? says.held
      : bent()
        ? says.tooMuch
        : fill(lost > 0 ? says.behind : lost < 0 ? says.ahead : says.inStep, facts);
    if (now.textContent !== text) now.textContent = text;
    const label = `${says.takeRotor}, ${fill(says.rotorAt, {angle: number(degrees(theta), 0)})}`;
    if (grip.getAttribute("aria-label") !== label) grip.setAttribute("aria-label", label);
    grip.textContent = page().teeth ? "" : "N";
    runs.textContent = playing ? says.stop : says.run;
  }
  const bent = () => {
    // more than the row that is on can hold
    const n = motor.currents.length,
      [x, y] = pull(motor, motor.currents[((sent % n) + n) % n]);
    return motor.load > motor.torque * Math.sqrt(x * x + y * y);
  };
  function inCode() {
    /** @type {(key: MotorControl["key"]) => string} */
    const text = key => String(+value(key).toPrecision(6));
    return fill(data.code, {
      rotor: kind().rotor,
      motor: kind().motor,
      windings: page().windings,
      drive: drive(),
      pulses,
      sign: state.sign,
      start: String(Math.min(state.start, state.end)),
      end: text("end"),
      ramp: text("ramp"),
      load: text("load"),
      inertia: text("inertia"),
    });
  }

  // --- The pictures

  /**
   * Where the rotor is now: how far its run is, if it makes one; whether it goes on.
   * @param {number} time
   */
  function moment(time) {
    if (playing) {
      playing.begun ??= time;
      const t = (time - playing.begun) / 1000 / playing.slow,
        i = found.t.findLastIndex(x => x <= t);
      live = {theta: found.angle[i], omega: 0, currents: [...motor.currents[0]]};
      sent = found.sent[i];
      if (i < found.t.length - 1) return {t, on: true};
      playing = null;
      live = {...atRest(motor, sent), theta: live.theta};
      since = LONG;
    } else if (!held && since < LONG) {
      const passed = since === 0 ? 1 / 60 : Math.min(0.05, (time - last) / 1000);
      since += passed / SLOW;
      advance(motor, live, sent, passed / SLOW);
      const period = (2 * Math.PI) / motor.periods,
        off = (live.theta - resting(motor, sent)) / period;
      const still = Math.abs(off - Math.round(off)) < 1e-3 && Math.abs(live.omega) < 1;
      if (still && !bent()) {
        // what is left cannot be seen
        live = {...atRest(motor, sent), theta: resting(motor, sent) + period * Math.round(off)};
        since = LONG;
      }
    }
    last = time;
    return {t: null, on: !held && since < LONG};
  }
  const ask = pictures(root, [canvas, curve], time => {
    computed();
    const {t, on} = moment(time);
    tellNow(live.theta, sent);
    drawCurve(curve, says, found, motor, t);
    const ready = prepared(canvas);
    if (ready) {
      const [g, w, h] = ready,
        size = Math.min(w, h) / 2 - 6;
      drawMotor(g, w, h, size, page(), motor, live.theta, sent, says);
      const far = size * (page().teeth ? 0.52 : 0.46),
        x = w / 2 + far * Math.cos(live.theta),
        y = h / 2 - far * Math.sin(live.theta);
      grip.style.transform = `translate(${x}px, ${y}px)`;
    }
    if (on) ask();
    return !!ready;
  });
  changed(true);
}

/**
 * @param {Context} g
 * @param {number} w
 * @param {number} h
 * @param {number} size
 * @param {PageMotor} page
 * @param {Motor} motor
 * @param {number} theta
 * @param {number} sent
 * @param {PageMotors["words"]} says
 */
function drawMotor(g, w, h, size, {poles, teeth, space}, motor, theta, sent, says) {
  /** @type {Round} */
  const at = (angle, r) => [w / 2 + size * r * Math.cos(angle), h / 2 - size * r * Math.sin(angle)];
  /** @type {(from: number, to: number, r: number) => Pixel[]} */
  const arc = (from, to, r) =>
    Array.from({length: 25}, (_, i) => at(from + ((to - from) * i) / 24, r));
  const n = motor.currents.length,
    currents = motor.currents[((sent % n) + n) % n];
  shape(g, () => g.arc(w / 2, h / 2, size, 0, 2 * Math.PI), colors.foot, colors.footEdge, 1.2);
  shape(
    g,
    () => g.arc(w / 2, h / 2, 0.9 * size, 0, 2 * Math.PI),
    colors.paper,
    colors.footEdge,
    1.2,
  );
  const half = Math.min(0.26, (0.5 * Math.PI) / poles.length);
  for (const {at: place, winding, sign, name} of poles) {
    polygon(
      g,
      [
        ...arc(place - half * 0.7, place + half * 0.7, 0.62),
        ...arc(place + half * 0.62, place - half * 0.62, 0.92),
      ],
      colors.foot,
      colors.footEdge,
      1.2,
    );
    const now = currents[winding] * sign,
      fillOf = now > 0 ? colors.joint5 : now < 0 ? colors.joint6 : colors.paper;
    polygon(
      g,
      [
        ...arc(place - half * 1.15, place + half * 1.15, 0.69),
        ...arc(place + half, place - half, 0.87),
      ],
      fillOf,
      colors.ink,
      now ? 1.8 : 0.8,
    );
    const [x, y] = at(place, 0.78),
      mark = now > 0 ? "+" : now < 0 ? "\u2212" : "";
    plainWords(g, `${name}${mark}`, x, y + 5, now ? colors.edge : colors.soft, !!now);
  }
  if (teeth) {
    const pitch = (2 * Math.PI) / teeth;
    polygon(
      g,
      Array.from({length: teeth}, (_, k) =>
        [
          [-0.26, 0.44],
          [-0.2, 0.59],
          [0.2, 0.59],
          [0.26, 0.44],
        ].map(([share, r]) => at(theta + pitch * (k + share), r)),
      ).flat(),
      colors.rod,
      colors.edge,
      1.2,
    );
  } else {
    for (const {turn, color, name} of [
      {turn: 0, color: colors.joint2, name: "N"},
      {turn: Math.PI, color: colors.rod, name: "S"},
    ]) {
      polygon(
        g,
        arc(theta + turn - Math.PI / 2, theta + turn + Math.PI / 2, 0.57),
        color,
        colors.edge,
        1.2,
      );
      const [x, y] = at(theta + turn, 0.46); // on the screen the ring to take it by lies over the N
      plainWords(g, name, x, y + 5, colors.edge, true);
    }
  }
  const [x, y] = pull(motor, currents),
    strength = Math.sqrt(x * x + y * y),
    [u, v] = pull(motor, motor.currents[0]);
  const field = space * (Math.atan2(v, u) + ((2 * Math.PI) / n) * sent),
    long = 0.29 * strength;
  for (const turn of teeth ? [0, Math.PI] : [0]) arrow(g, at, field + turn, long);
  if (motor.load) {
    // the weight pulls clockwise
    const turned = 2.6 * Math.min(1, motor.load / holdingTorque(motor)),
      from = Math.PI / 2 + 1.3,
      end = at(from - turned, 0.15);
    stroke(g, arc(from, from - turned, 0.15), colors.near, 3);
    polygon(
      g,
      [at(from - turned - 0.5, 0.15), at(from - turned, 0.2), at(from - turned, 0.1)],
      colors.near,
      colors.paper,
      1,
    );
    spot(g, end, 1.5, colors.near, colors.near, 1);
  }
  spot(g, [w / 2, h / 2], 4, colors.hub, colors.edge, 1.2);
  words(
    g,
    fill(says.rotorAt, {angle: number(degrees(theta), 1)}),
    4,
    14,
    colors.ink,
    12,
    "left",
    "600",
  );
  words(
    g,
    fill(says.fieldAt, {angle: number(degrees(field), 1)}),
    w - 4,
    14,
    colors.accent,
    12,
    "right",
    "600",
  );
}

/**
 * @param {Context} g
 * @param {Round} at
 * @param {number} angle
 * @param {number} long
 */
function arrow(g, at, angle, long) {
  const tip = at(angle, long),
    neck = at(angle, long - 0.07),
    [sx, sy] = at(angle + Math.PI / 2, 0.05),
    [cx, cy] = at(0, 0);
  stroke(g, [[cx, cy], neck], colors.paper, 8);
  stroke(g, [[cx, cy], neck], colors.accent, 4);
  polygon(
    g,
    [tip, [neck[0] + sx - cx, neck[1] + sy - cy], [neck[0] - sx + cx, neck[1] - sy + cy]],
    colors.accent,
    colors.paper,
    1.2,
  );
}

/**
 * Words on a coloured ground that is the same, light, in both themes.
 * @param {Context} g
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {string} color
 * @param {boolean} strong
 */
function plainWords(g, text, x, y, color, strong) {
  g.font = `${strong ? "700" : "400"} 12px system-ui, sans-serif`;
  g.textAlign = "center";
  g.fillStyle = color;
  g.fillText(text, x, y);
}

/**
 * Steps over time: what was sent as a staircase, what the rotor made as a line, and where the clock
 * is.
 * @param {HTMLCanvasElement} canvas
 * @param {PageMotors["words"]} says
 * @param {Run} run
 * @param {Motor} motor
 * @param {?number} clock
 */
function drawCurve(canvas, says, {t, angle, sent}, motor, clock) {
  const ready = prepared(canvas);
  if (!ready) return;
  const [g, w, h] = ready,
    left = 40,
    right = w - 46,
    top = 26,
    bottom = h - 32,
    step = stepOf(motor);
  const made = angle.map(a => (a - angle[0]) / step),
    low = Math.min(0, ...sent, ...made),
    high = Math.max(1, ...sent, ...made);
  /** @type {(time: number) => number} */
  const x = time => left + ((right - left) * time) / lastOf(t);
  /** @type {(value: number) => number} */
  const y = value => bottom - ((bottom - top) * (value - low)) / (high - low);
  words(g, says.curveTitle, 6, 14, colors.ink, 12, "left", "600");
  const marked = [lastOf(sent), 0, low, high].map(Math.round);
  for (const value of marked.filter((v, i) =>
    marked.slice(0, i).every(other => Math.abs(y(v) - y(other)) > 12),
  )) {
    stroke(
      g,
      [
        [left, y(value)],
        [right, y(value)],
      ],
      colors.grid,
      1,
    );
    words(g, number(value, 0), left - 5, y(value) + 4, colors.soft, 11, "right");
  }
  stroke(
    g,
    sent.flatMap((n, i) =>
      i && sent[i - 1] !== n
        ? [
            [x(t[i - 1]), y(sent[i - 1])],
            [x(t[i - 1]), y(n)],
          ]
        : i === 0 || i === sent.length - 1
          ? [[x(t[i]), y(n)]]
          : [],
    ),
    colors.soft,
    1.6,
    [4, 2],
  );
  stroke(
    g,
    made.map((value, i) => [x(t[i]), y(value)]),
    colors.accent,
    2,
  );
  /** @type {[number, number]} */
  const ends = [y(lastOf(sent)), y(lastOf(made))];
  const apart = Math.abs(ends[0] - ends[1]) < 13;
  words(g, says.sent, right + 4, ends[0] + (apart ? -2 : 4), colors.soft, 11);
  words(g, says.made, right + 4, ends[1] + (apart ? 11 : 4), colors.accent, 11);
  const lost = Math.round(Math.abs(lastOf(sent) - lastOf(made)));
  if (lost) {
    upright(g, right - 6, ...ends, colors.alarm, 1.6);
    words(
      g,
      fill(says.gap, {lost}),
      right - 10,
      (ends[0] + ends[1]) / 2 + 4,
      colors.alarm,
      12,
      "right",
      "600",
    );
  }
  words(g, "0", left, bottom + 14, colors.soft, 11, "center");
  words(g, number(1000 * lastOf(t), 0), right, bottom + 14, colors.soft, 11, "center");
  words(g, says.curveTime, (left + right) / 2, bottom + 26, colors.soft, 11, "center");
  if (clock !== null) upright(g, x(clock), top, bottom, colors.ink, 1.2);
}
