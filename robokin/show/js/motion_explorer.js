// The motion explorer: a blended motion whose stations are taken by the hand. What is said, and
// every number of the arm, comes from Python (page.py: PageExplorer).

import {fk, matrix, origin, plus} from "./kinematics.js";
import {ik, singularities} from "./geometries.js";
import {follow, onward} from "./branches.js";
import {fill} from "./blanks.js";
import {
  blend,
  differentiate,
  leaps,
  linear,
  quintic,
  refinedMaximum,
  trapezoidal,
} from "./motion.js";
import {number} from "./canvas.js";
import {curvesView} from "./curves.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {alongCurve, inScreen, reachOf} from "./handles.js";
import {decimalsOf, peaks, timeOf} from "./peaks.js";
import {menu, slider, stageOf, table} from "./stage.js";
import {lengths, plain} from "./turns.js";

/** @import {PageExplorer, PagePose, Scale, StartValues, With} from "./page.js" */
/** @import {CurvesView} from "./curves.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Panel} from "./panel.js" */
/** @import {Stage} from "./stage.js" */

/**
 * @typedef {With<PageExplorer, "arm" | "units" | "dashes" | "start" | "via" | "goal" |
 *   "start_values" | "laws" | "corners" | "branches" | "panels" | "samples">} MotionData
 */
/** @typedef {Record<(typeof STATIONS)[number], PagePose>} Stations */
/** @typedef {Stations & StartValues & {time: number}} Asked  `time`: as a share of the duration */
/** @typedef {ReturnType<typeof motionOf>} Motion */

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {MotionData} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => motionExplorer(stageOf(root, data), data));

const LAWS = {quintic, trapezoidal, linear};
const STATIONS = /** @type {const} */ (["start", "via", "goal"]);
const NUMBERS = /** @type {const} */ (["blend", "duration"]);
const CHOICES = /** @type {const} */ (["law", "corner", "row"]);
const AXES = /** @type {const} */ (["x", "y", "z"]);

/**
 * @param {Stage} stage
 * @param {MotionData} data
 */
function motionExplorer(stage, data) {
  const {arm, words, unit, units, samples} = data,
    n = arm.chain.length;
  /** @type {() => Stations} */
  const copied = () => structuredClone({start: data.start, via: data.via, goal: data.goal});
  /** @type {Asked} */
  const state = {...copied(), ...data.start_values, time: 0};
  /** @type {(name: (typeof CHOICES)[number], value: number) => void} */
  const set = (name, value) => {
    state[name] = value;
    stage.changed();
  };

  const sliders = data.controls.map((spec, k) =>
    slider(spec, value => {
      if (k < 3) state.via.place[k] = value * unit.size;
      else state[NUMBERS[k - 3]] = Math.min(Math.max(value, spec.low), spec.high);
      stage.changed();
    }),
  );
  const menus = [
    menu(words.law, data.laws, k => set("law", k)),
    menu(words.corner, data.corners, k => set("corner", k)),
    menu(words.branch, data.branches, k => set("row", k)),
  ];
  const scrub = slider(
    {name: words.time, unit: "s", low: 0, high: 1, step: 0.001, decimals: 2},
    value => {
      state.time = Math.min(Math.max(value / state.duration, 0), 1);
      stage.changed();
    },
  );
  const canvas = element("canvas", {class: "rk-curves", role: "img", "aria-label": words.curves});
  const curves = curvesView(canvas, data.dashes);
  const numbers = table(
    [words.speed, words.acceleration],
    ["", ...units.map(({name}, j) => `q${j + 1} ${name}`)],
    units.map(() => 1),
  );
  stage.side.append(canvas);
  stage.below.append(
    element("div", {class: "rk-columns"}, ...[...sliders, ...menus, scrub].map(s => s.row)),
    numbers.node,
    element(
      "div",
      {class: "rk-row"},
      stage.says,
      copyButton(words, () => inCode(data, state)),
    ),
  );
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    clock(event);
  });
  canvas.addEventListener("pointermove", event => {
    if (canvas.hasPointerCapture(event.pointerId)) clock(event);
  });
  /** @param {PointerEvent} event */
  const clock = event => {
    [state.time] = curves.timeAt(event.offsetX, event.offsetY, 0).map(t => t / state.duration);
    stage.changed();
  };
  stage.handles.set(stationHandles(stage, state, copied, data));

  // While a hand holds something, the samples have to do: between them it takes too long.
  let held = false;
  /** @type {(on: boolean) => void} */
  const hold = on => {
    held = on;
    stage.changed();
  };
  const {layer} = stage.handles;
  layer.addEventListener("pointerdown", () => hold(true));
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    layer.addEventListener(end, () => hold(false));
  stage.below.addEventListener("input", ({target}) =>
    hold(/** @type {HTMLInputElement} */ (target).type === "range"),
  );
  stage.below.addEventListener("change", () => hold(false));

  const heads = numbers.node.querySelectorAll("tbody th");
  let known = "";
  /** @type {?Motion} */
  let found = null;
  /** @type {?number[][]} */
  let tops = null;
  /** @type {?Parameters<CurvesView["draw"]>} */
  let drawn = null;
  stage.run(
    () => {
      const {time, ...asked} = state,
        key = JSON.stringify(asked);
      // the clock alone changes nothing
      if (!found || key !== known) [known, found, tops] = [key, motionOf(data, state), null];
      const now = found,
        {t, q, v, a, tool, missing} = now;
      sliders.forEach((s, k) =>
        s.set(k < 3 ? state.via.place[k] / unit.size : state[NUMBERS[k - 3]]),
      );
      menus.forEach((m, k) => m.set(state[CHOICES[k]]));
      scrub.reach(state.duration);
      scrub.set(time * state.duration);
      const panels = [q, v, a].map((rows, order) => panelOf(data, now, rows, order));
      const i = Math.round(time * (samples - 1));
      for (const panel of panels) panel.now = panel.curves.map(curve => curve[i]);
      drawn = [
        [{title: arm.name, panels}],
        t,
        scaleOf(0, state.duration, 5),
        time * state.duration,
      ];
      const sampled = [v, a].map(rows => units.map(({size}, j) => most(rows, j) / size));
      if (!held) tops ||= topsOf(data, now, sampled);
      const shown = tops || sampled;
      [words.speed, words.acceleration].forEach((text, k) => {
        heads[k].textContent = tops ? text : fill(words.sampled, {what: text, samples});
      });
      numbers.set(
        shown.map((values, order) =>
          values.map((value, j) =>
            Number.isNaN(value)
              ? words.none
              : number(value, decimalsOf(value)) +
                (order === 0 && arm.speed_limits
                  ? ` (${Math.round((100 * value * units[j].size) / arm.speed_limits[j])}\u00A0%)`
                  : ""),
          ),
        ),
      );
      stage.say([nearWords(data, now.near), ...notes(data, now)].join(" "));
      stage.scene.targets = STATIONS.map(name => ({
        name,
        pose: matrix(
          state[name].rotation || [
            Math.cos((state[name].angle || 0) / 2),
            0,
            0,
            Math.sin((state[name].angle || 0) / 2),
          ],
          state[name].place,
        ),
      }));
      const posture = q[i].some(Number.isNaN)
        ? q.slice(0, i).findLast(row => !row.some(Number.isNaN)) || new Array(n).fill(NaN)
        : q[i];
      return [
        {
          name: arm.name,
          chain: arm.chain,
          q: posture,
          faded: missing[i],
          trace: tool,
          tail: tool.slice(0, i + 1),
        },
      ];
    },
    [canvas],
    () => drawn && curves.draw(...drawn),
  );
}

/**
 * The motion for what is asked: times, joint values, speeds, accelerations, the tool's places, how
 * near it passes via; where there is no posture, after which samples its curves break, where its
 * speed jumps (-1: nowhere); the pose at a time, and the times at which an acceleration may jump.
 * @param {MotionData} data
 * @param {Asked} state
 */
function motionOf(data, state) {
  const {arm, laws, corners, samples} = data;
  const law = LAWS[laws[state.law]](state.duration);
  const t = Float64Array.from({length: samples}, (_, i) => (state.duration * i) / (samples - 1));
  /** @type {(x: number) => PagePose} */
  const poseAt = x =>
    blend(state.start, state.via, state.goal, state.blend, law(x), corners[state.corner]);
  const rows = Array.from(t, x => ik(arm, poseAt(x)));
  const q = follow(arm, rows, state.row),
    missing = q.map(row => row.some(Number.isNaN));
  // No difference is taken across a jump: where the branch ends, where a joint leaps, at a corner
  // without a blend.
  /** @type {Set<number>} */
  const breaks = new Set();
  const jumps = leaps(q, Array.from(t), arm.prismatic);
  for (let i = 1; i < samples; i++)
    if (missing[i] !== missing[i - 1] || jumps[i - 1].includes(true)) breaks.add(i);
  const gaps = new Set([...breaks].map(i => i - 1)),
    corner = state.blend === 0 ? (samples - 1) / 2 : -1;
  const nothing = () => q.map(row => row.map(() => NaN)),
    v = nothing(),
    a = nothing();
  const ends = [0, ...breaks, samples].sort((x, y) => x - y);
  for (let k = 0; k + 1 < ends.length; k++)
    for (const [from, to] of corner > ends[k] + 1 && corner < ends[k + 1] - 2
      ? [
          [ends[k], corner + 1],
          [corner, ends[k + 1]],
        ]
      : [[ends[k], ends[k + 1]]]) {
      if (to - from < 3 || missing[from]) continue;
      const piece = q.slice(from, to),
        times = Array.from(t.slice(from, to));
      const speeds = differentiate(piece, times),
        accelerations = differentiate(speeds, times);
      for (let i = from; i < to; i++) [v[i], a[i]] = [speeds[i - from], accelerations[i - from]];
    }
  if (corner > 0) a[corner] = a[corner].map(() => NaN);
  const tool = q.map((row, i) => (missing[i] ? null : origin(fk(arm.chain, row))));
  const jump = corner > 0 && !missing[corner] && v[corner - 1] ? corner : -1;
  const near = passing(data, state.via, poseAt, t, missing);
  const bend = timeOf(law, state.duration, 0.5 - state.blend),
    ramps = laws[state.law] === "trapezoidal" ? [0.25, 0.75] : [];
  const times = [
    0,
    bend,
    ...ramps.map(x => x * state.duration),
    state.duration - bend,
    state.duration,
  ];
  times.sort((x, y) => x - y);
  return {t, q, v, a, tool, missing, gaps, jump, near, poseAt, times};
}

/**
 * The greatest speeds and accelerations between the samples, too; null where the motion is broken
 * or passes a singularity, or one of them does not stand.
 * @param {MotionData} data
 * @param {Motion} motion
 * @param {number[][]} sampled
 */
function topsOf({arm, units, samples}, {t, q, missing, gaps, poseAt, times}, sampled) {
  if (gaps.size || missing[0]) return null;
  const step = t[1];
  // where joints are free, it is a choice how they stand
  /** @type {(x: number) => number[]} */
  const posture = x => {
    const near = q[Math.min(Math.round(x / step), samples - 1)],
      row = onward(arm, ik(arm, poseAt(x)), near);
    return Object.values(singularities(arm, row)).some(Boolean) ? row.map(() => NaN) : row;
  };
  return peaks(
    posture,
    times,
    units.map(({size}) => size),
    sampled,
  );
}

/**
 * A panel of curves: joint values (order 0), speeds or accelerations.
 * @param {MotionData} data
 * @param {Motion} motion
 * @param {number[][]} rows
 * @param {number} order
 * @returns {Panel}
 */
function panelOf({arm, panels, units}, {t, gaps, jump}, rows, order) {
  const curves = units.map((u, j) => Float64Array.from(rows, row => row[j] / u.size));
  const axes = [false, true]
    .map(shifts => units.flatMap((_, j) => (arm.prismatic[j] === shifts ? [j] : [])))
    .filter(joints => joints.length)
    .map(joints => {
      let [low, high] = [Infinity, -Infinity];
      for (const j of joints)
        for (const x of curves[j])
          if (!Number.isNaN(x)) [low, high] = [Math.min(low, x), Math.max(high, x)];
      return {
        joints,
        unit: units[joints[0]].name + ["", "/s", "/s\u00B2"][order],
        scale: scaleOf(low, high, 4),
      };
    });
  const limits =
    order === 0
      ? [0, 1].map(side => arm.limits.map((pair, j) => pair[side] / units[j].size))
      : null;
  const near = limits
    ? curves.flatMap((curve, j) =>
        [0, 1]
          .filter(side => {
            const sign = side ? 1 : -1,
              room = 0.03 * (limits[1][j] - limits[0][j]);
            return curve.some(x => sign * (x - limits[side][j]) > -room);
          })
          .map(side => [j, side]),
      )
    : [];
  const marks = jump > 0 && order > 0 ? [{time: t[jump], text: ""}] : [];
  return {
    label: `${panels[order]}, ${axes[0].unit}`,
    axes,
    curves,
    gaps,
    limits,
    near,
    marks,
    now: [],
  };
}

/**
 * A scale of some ticks round the values.
 * @param {number} low
 * @param {number} high
 * @param {number} wanted  how many ticks
 * @returns {Scale}
 */
function scaleOf(low, high, wanted) {
  if (!(high - low > 1e-6 * Math.max(Math.abs(low), Math.abs(high), 1e-3))) {
    const middle = Number.isFinite(low) ? low : 0,
      pad = 0.5 * Math.max(Math.abs(middle), 1);
    [low, high] = [middle - pad, middle + pad];
  }
  const power = 10 ** Math.floor(Math.log10((high - low) / wanted));
  const step =
    power * ([1, 2, 2.5, 5].find(k => power * k * wanted >= (high - low) * (1 - 1e-9)) ?? 10);
  const first = Math.floor(low / step + 1e-9),
    last = Math.ceil(high / step - 1e-9);
  const decimals =
    Math.max(0, -Math.floor(Math.log10(step) + 1e-9)) +
    (Math.abs(step / power - 2.5) < 1e-9 && power < 10 ? 1 : 0);
  return [first * step, step, last - first + 1, power >= 10 ? 0 : decimals];
}

/** The greatest value, NaN where there is none. @type {(rows: number[][], j: number) => number} */
const most = (rows, j) =>
  rows.reduce(
    (best, row) => (Number.isNaN(row[j]) || Math.abs(row[j]) <= best ? best : Math.abs(row[j])),
    NaN,
  );

/** @type {(unit: {size: number}) => number} */
const nearDecimals = unit => (unit.size < 1 ? 1 : 3);

/**
 * How near the path passes the via station, in the shown unit: between the samples, too. Infinity
 * where there is no path.
 * @param {MotionData} data
 * @param {PagePose} via
 * @param {(x: number) => PagePose} poseAt
 * @param {Float64Array} t
 * @param {boolean[]} missing
 */
function passing({unit}, via, poseAt, t, missing) {
  /** @type {(place: number[], from: number[]) => number} */
  const apart = (place, from) => Math.hypot(...plus(place, from, -1)) / unit.size;
  const places = Array.from(t, x => poseAt(x).place),
    far = places.map(place => apart(place, via.place));
  const steps = far.flatMap((_, i) => (i && !missing[i] && !missing[i - 1] ? [i] : []));
  let least = Math.min(...steps.flatMap(i => [far[i - 1], far[i]]));
  // only on steps this long the path may come nearer than at the samples
  for (const i of steps.filter(
    k => Math.min(far[k - 1], far[k]) - apart(places[k], places[k - 1]) < least,
  )) {
    const away = -refinedMaximum(
      x => -apart(poseAt(x).place, via.place),
      t[i - 1],
      t[i],
      nearDecimals(unit),
    );
    if (away < least) least = away;
  }
  return least;
}

/**
 * @param {MotionData} data
 * @param {number} distance
 */
const nearWords = ({words, unit}, distance) =>
  Number.isFinite(distance)
    ? fill(words.near, {distance: number(distance, nearDecimals(unit))})
    : "";

/**
 * What is wrong with the motion.
 * @param {MotionData} data
 * @param {Motion} motion
 */
function notes({arm, words, units}, {q, v, t, missing, jump}) {
  /** @type {string[]} */
  const said = [];
  const none = missing.filter(Boolean).length,
    fastest = arm.speed_limits;
  if (none) said.push(fill(words.missingSamples, {none, all: q.length}));
  units.forEach((_, j) => {
    const [low, high] = arm.limits[j],
      slack = arm.tolerances.SLACK;
    const past = q.filter(row => row[j] < low - slack || row[j] > high + slack).length;
    if (past) said.push(fill(words.pastSamples, {joint: j + 1, past, all: q.length}));
    const fast = fastest ? v.filter(row => Math.abs(row[j]) > fastest[j] * (1 + 1e-9)).length : 0;
    if (fast) said.push(fill(words.fastSamples, {joint: j + 1, past: fast, all: q.length}));
  });
  if (jump > 0) said.push(fill(words.jump, {time: number(t[jump], 2)}));
  return said;
}

/**
 * Start and goal freely in the plane of the screen, the via station along the base's axes, too.
 * @param {Stage} stage
 * @param {Asked} state
 * @param {() => Stations} copied
 * @param {MotionData} data
 */
function stationHandles(stage, state, copied, data) {
  const {unit, words, scene} = data,
    size = scene.size,
    fine = 5e-3 * (unit.size < 1 ? 1 : size / 2);
  /** @type {(place: Point, from: Point) => Point} */
  const kept = (place, from) => place.map((x, k) => (k === scene.flat ? from[k] : x));
  /** @type {(name: keyof Stations) => () => string} */
  const value = name => () =>
    `${state[name].place.map(x => number(x / unit.size, 1)).join(", ")} ${unit.name}`;
  /** @type {(name: keyof Stations) => () => void} */
  const home = name => () => {
    state[name].place = copied()[name].place;
  };
  /** @type {Handle[]} */
  const free = STATIONS.map(name => ({
    id: name,
    name: fill(words.takeStation, {name}),
    look: "rk-free",
    at: () => state[name].place,
    value: value(name),
    home: home(name),
    grab(camera) {
      const from = state[name].place,
        to = inScreen(camera, from);
      return (dx, dy) => {
        state[name].place = kept(to(dx, dy), from);
      };
    },
    step(right, up, big) {
      const camera = stage.camera(),
        by = fine * camera.scale * (big ? 10 : 1),
        from = state[name].place;
      state[name].place = kept(plus(from, camera.across(right * by, -up * by)), from);
    },
  }));
  /** @type {Handle[]} */
  const arrows = [0, 1, 2]
    .filter(k => k !== scene.flat)
    .map(k => {
      const way = [0, 1, 2].map(i => Number(i === k));
      return {
        id: `via ${AXES[k]}`,
        name: fill(words.takeVia, {axis: AXES[k]}),
        look: "rk-arrow",
        mark: AXES[k],
        color: AXES[k],
        at: camera => plus(state.via.place, way, reachOf(camera)),
        value: value("via"),
        home: home("via"),
        grab(camera) {
          const from = state.via.place,
            r = reachOf(camera),
            to = alongCurve(camera, x => plus(from, way, x + r), 0, fine);
          return (dx, dy) => {
            state.via.place = plus(from, way, to(dx, dy));
          };
        },
        step(right, up, big) {
          state.via.place = plus(state.via.place, way, (right + up) * fine * (big ? 10 : 1));
        },
      };
    });
  return [...free, ...arrows];
}

/**
 * The lines of Python that make the same motion.
 * @param {MotionData} data
 * @param {Asked} state
 */
function inCode(data, state) {
  const {unit, code, laws, corners} = data;
  /** @type {(place: Point) => string} */
  const numbers = place =>
    lengths(place, unit)
      .map(x => `${x} * ${unit.code}`)
      .join(", ");
  return fill(code, {
    start: numbers(state.start.place),
    via: numbers(state.via.place),
    goal: numbers(state.goal.place),
    law: laws[state.law],
    duration: state.duration,
    blend: plain(state.blend, 3),
    corner: corners[state.corner],
    row: state.row,
  });
}
