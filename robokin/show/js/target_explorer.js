// The target explorer: a target taken by the hand, and all branches that reach it. What is said,
// and every number of the arm, comes from Python (page.py: PageExplorer).

import {distance_from_singularity, matrix, plus, product, wrapped} from "./kinematics.js";
import {ik, singularities} from "./geometries.js";
import {explain, nearest, representative, within} from "./branches.js";
import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {alongCurve, inScreen, reachOf} from "./handles.js";
import {AXES} from "./triad.js";
import {menu, slider, stageOf, table, tick} from "./stage.js";
import {
  aboutAxis,
  ellipsoidOf,
  degrees,
  inCode,
  normal,
  radians,
  rollPitchYaw,
  rotationOf,
} from "./turns.js";

/** @import {ArmData, BranchTask, PageExplorer, With} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {ClosedFormArm} from "./kinematics.js" */
/** @import {Stage} from "./stage.js" */

/**
 * @typedef {With<PageExplorer, "arm" | "units" | "q" | "target" | "turns" | "branches" | "heads" |
 *   "turning"> & {arm: ClosedFormArm}} TargetExplorer
 */
/**
 * A target: `rotation` and its `turns` (roll, pitch, yaw) of a transform, `angle` of a ScaraPose.
 * @typedef {{place: Point, turns: number[], rotation?: number[], angle?: number}} Target
 */
/**
 * The target now; the posture that the arm has, the branch that the reader wants (-1: the nearest
 * one) and the one that is shown.
 * @typedef {Target & {q: number[], wanted: number, chosen: number}} State
 */

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {TargetExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => targetExplorer(stageOf(root, data), data));

/**
 * Handles on the target, and a row of a table for every branch that reaches it.
 * @param {Stage} stage
 * @param {TargetExplorer} data
 */
function targetExplorer(stage, data) {
  const {arm, words, unit} = data,
    oriented = arm.target === "Transform",
    sizes = data.units.map(u => u.size);
  /** @type {Target} */
  const home = {...data.target, turns: data.turns};
  /** @type {State} */
  const state = {...structuredClone(home), q: [...data.q], wanted: -1, chosen: 0};
  if (oriented) state.rotation = rotationOf(state.turns);

  const sliders = data.controls.map((spec, k) =>
    slider(spec, value => {
      if (k < 3) state.place[k] = value * unit.size;
      else if (oriented) {
        state.turns[k - 3] = radians(value);
        state.rotation = rotationOf(state.turns);
      } else state.angle = radians(value);
      stage.changed();
    }),
  );
  const choice = menu(words.branch, [words.nearest, ...data.branches], k => {
    state.wanted = k - 1;
    stage.changed();
  });
  const more = tick(words.ellipsoid, stage.changed),
    axes = tick(words.axes, stage.changed);
  stage.side.append(
    ...sliders.map(s => s.row),
    choice.row,
    element(
      "div",
      {class: "rk-row"},
      more.row,
      axes.row,
      copyButton(words, () => fill(data.code, {...inCode(state, unit), row: state.chosen})),
    ),
    stage.says,
  );
  const rows = table(
    data.branches,
    data.heads,
    data.heads.slice(1).map(() => 1),
    k => {
      state.wanted = k;
      stage.changed();
    },
  );
  stage.below.append(rows.node);

  /** @type {(axis: number[], angle: number) => void} */
  const turnBy = (axis, angle) => {
    const {rotation} = /** @type {With<State, "rotation">} */ (state);
    state.rotation = normal(product(aboutAxis(axis, angle), rotation));
    state.turns = rollPitchYaw(matrix(state.rotation));
  };
  stage.handles.set(targetHandles(stage, state, home, data, turnBy));

  stage.run(() => {
    const last = state.q;
    const found = ik(arm, state).map(row => {
      const near = nearest(arm, [row], last);
      return within(arm, near).every(Boolean) ? near : representative(arm, near);
    });
    const exists = found.map(q => q.every(Number.isFinite)),
      inside = found.map(q => within(arm, q));
    const usable = found.map((_, k) => exists[k] && inside[k].every(Boolean));
    const travel = found.map(q =>
      data.turning.reduce((sum, j) => sum + Math.abs(q[j] - last[j]), 0),
    );
    const among = usable.some(Boolean) ? usable : exists;
    const shortest = travel.reduce(
      (best, x, k) => (among[k] && (best < 0 || x < travel[best]) ? k : best),
      -1,
    );
    const chosen = state.wanted >= 0 ? state.wanted : Math.max(shortest, 0);
    state.chosen = chosen;
    if (exists[chosen]) state.q = found[chosen];

    sliders.forEach((s, k) =>
      s.set(k < 3 ? state.place[k] / unit.size : degrees(state.angle ?? state.turns[k - 3])),
    );
    choice.set(state.wanted + 1);
    rows.set(
      found.map((q, k) => [
        verdict(arm, words, q, inside[k], exists[k]),
        ...q.map((x, j) =>
          exists[k] ? {text: number(x / sizes[j], 1), past: !inside[k][j]} : words.none,
        ),
        exists[k] ? number(distance_from_singularity(arm, q), 3) : words.none,
        exists[k] ? number(degrees(travel[k]), 1) : words.none,
      ]),
      exists[chosen] ? chosen : -1,
      exists,
    );
    stage.say(told(data.task, found, exists) + summary(arm, words, state, usable, chosen));

    const asked = state.rotation ? matrix(state.rotation, state.place) : null;
    stage.scene.targets = asked ? [{name: words.target, pose: asked}] : [];
    stage.scene.marks = asked ? [] : [{name: words.target, at: state.place, radius: 0}];
    return [
      {
        name: arm.name,
        chain: arm.chain,
        q: state.q,
        faded: !exists[chosen],
        ghosts: found.flatMap((q, k) => (exists[k] && k !== chosen ? [{q, past: !usable[k]}] : [])),
        axes: axes.on(),
        ellipsoid: more.on() && ellipsoidOf(arm, state.q),
      },
    ];
  });
}

/**
 * What can be taken of a target: its place, freely or along its axes; its turns about them.
 * @param {Stage} stage
 * @param {State} state
 * @param {Target} home
 * @param {TargetExplorer} data
 * @param {(axis: number[], angle: number) => void} turnBy
 */
function targetHandles(stage, state, home, data, turnBy) {
  const {arm, words, unit} = data,
    size = data.scene.size,
    oriented = arm.target === "Transform";
  const fine = 5e-3 * (unit.size < 1 ? 1 : size / 2);
  /** @type {(k: number) => number[]} */
  const axis = k => {
    const axes = state.rotation ? matrix(state.rotation) : null;
    return [0, 1, 2].map(i => (axes ? axes[4 * i + k] : Number(i === k)));
  };
  const value = () => `${state.place.map(x => number(x / unit.size, 1)).join(", ")} ${unit.name}`;
  const flat = data.scene.flat;
  /** @type {(camera: Camera, x: number, a: number[], b: number[]) => Point} */
  const rim = (camera, x, a, b) =>
    plus(plus(state.place, a, reachOf(camera) * Math.cos(x)), b, reachOf(camera) * Math.sin(x));
  /** @type {(place: Point) => Point} */
  const kept = place => place.map((x, k) => (k === flat ? state.place[k] : x));
  /** @type {Handle[]} */
  const handles = [
    {
      id: "free",
      name: words.takeFree,
      look: "rk-free",
      at: () => state.place,
      value,
      grab(camera) {
        const to = inScreen(camera, state.place);
        return (dx, dy) => {
          state.place = kept(to(dx, dy));
        };
      },
      step(right, up, big) {
        const camera = stage.camera(),
          by = fine * camera.scale * (big ? 10 : 1);
        state.place = kept(plus(state.place, camera.across(right * by, -up * by)));
      },
      home() {
        state.place = [...home.place];
      },
    },
  ];
  for (const k of [0, 1, 2].filter(k => k !== flat))
    handles.push({
      id: AXES[k],
      name: fill(words.takeAlong, {axis: AXES[k]}),
      look: "rk-arrow",
      mark: AXES[k],
      color: AXES[k],
      at: camera => plus(state.place, axis(k), reachOf(camera)),
      value,
      grab(camera) {
        const from = state.place,
          way = axis(k),
          r = reachOf(camera);
        const to = alongCurve(camera, x => plus(from, way, x + r), 0, fine);
        return (dx, dy) => {
          state.place = plus(from, way, to(dx, dy));
        };
      },
      step(right, up, big) {
        state.place = plus(state.place, axis(k), (right + up) * fine * (big ? 10 : 1));
      },
      home() {
        state.place = [...home.place];
      },
    });
  if (oriented)
    for (const k of [0, 1, 2])
      handles.push({
        id: `turn ${AXES[k]}`,
        name: fill(words.takeTurn, {axis: AXES[k]}),
        look: "rk-arc",
        mark: "\u21BB",
        color: AXES[k],
        at: camera => rim(camera, Math.PI / 4, axis((k + 1) % 3), axis((k + 2) % 3)),
        value: () => `${state.turns.map(x => number(degrees(x), 1)).join(", ")} \u00B0`,
        grab(camera) {
          const [from, about] = [state.rotation, axis(k)];
          const [a, b] = [axis((k + 1) % 3), axis((k + 2) % 3)];
          const to = alongCurve(camera, x => rim(camera, x + Math.PI / 4, a, b), 0, 0.02);
          return (dx, dy) => {
            state.rotation = from;
            turnBy(about, to(dx, dy));
          };
        },
        step(right, up, big) {
          turnBy(axis(k), (right + up) * radians(big ? 10 : 1));
        },
        home() {
          [state.turns, state.rotation] = [[...home.turns], rotationOf(home.turns)];
        },
      });
  if (arm.target === "ScaraPose") {
    const turned = /** @type {With<State, "angle">} */ (state);
    handles.push({
      id: "angle",
      name: words.takeAngle,
      look: "rk-arc",
      mark: "\u21BB",
      color: "z",
      at: camera => rim(camera, turned.angle, [1, 0, 0], [0, 1, 0]),
      value: () => `${number(degrees(turned.angle), 1)} \u00B0`,
      grab(camera) {
        const to = alongCurve(
          camera,
          x => rim(camera, x, [1, 0, 0], [0, 1, 0]),
          turned.angle,
          0.02,
        );
        return (dx, dy) => {
          turned.angle = to(dx, dy);
        };
      },
      step(right, up, big) {
        turned.angle += (right + up) * radians(big ? 10 : 1);
      },
      home() {
        state.angle = home.angle;
      },
    });
  }
  return handles;
}

/**
 * @param {ArmData} arm
 * @param {Record<string, string>} words
 * @param {number[]} q
 * @param {boolean[]} inside  for each joint its limits
 * @param {boolean} exists
 */
function verdict(arm, words, q, inside, exists) {
  if (!exists) return words.missingRow;
  const past = inside.flatMap((good, j) => (good ? [] : [`q${j + 1}`]));
  if (past.length) return fill(words.past, {joints: past.join(", ")});
  return Object.values(singularities(arm, q)).some(Boolean) ? words.usableSingular : words.usable;
}

/**
 * Whether an exercise's task is fulfilled, in words.
 * @param {BranchTask | undefined} task
 * @param {number[][]} rows
 * @param {boolean[]} exists
 */
function told(task, rows, exists) {
  if (!task) return "";
  // at a singularity two rows may be one posture
  /** @type {(a: number[], b: number[]) => boolean} */
  const same = (a, b) => a.every((x, j) => Math.abs(wrapped(x - b[j])) < 1e-6);
  const count = rows.filter(
    (q, k) => exists[k] && !rows.some((other, i) => i < k && exists[i] && same(q, other)),
  ).length;
  return `${fill(count === task.wanted ? task.holds : task.open, {count, wanted: task.wanted})} `;
}

/**
 * @param {ClosedFormArm} arm
 * @param {Record<string, string>} words
 * @param {State} state
 * @param {boolean[]} usable
 * @param {number} chosen
 */
function summary(arm, words, state, usable, chosen) {
  const count = usable.filter(Boolean).length,
    why = explain(arm, state, chosen);
  return fill(count ? (count === 1 ? words.oneUsable : words.someUsable) : words.noneUsable, {
    count,
    all: usable.length,
    why,
  });
}
