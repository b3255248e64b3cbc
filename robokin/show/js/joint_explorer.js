// The joint explorer: the reader drags joints. All text and the arm data come from Python (page.py:
// JointPage).

import {TRIAD} from "./arm_picture.js";
import {distance_from_singularity} from "./dexterity.js";
import {fk, origin, plus, turned} from "./kinematics.js";
import {singularities} from "./geometries.js";
import {fill} from "./blanks.js";
import {point} from "./mark.js";
import {number} from "./canvas.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {ellipsoidMenu} from "./ellipsoid_menu.js";
import {alongCurve} from "./handles.js";
import {around, drawRings, ringAt, ringsOf} from "./joint_ring.js";
import {quaternion} from "./rotations.js";
import {slider, stageOf, tick} from "./stage.js";
import {table} from "./table.js";
import {degrees, inUnits, rollPitchYaw} from "./turns.js";

/** @import {ArmData, JointPage} from "./page.js" */
/** @import {Color, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Ring} from "./joint_ring.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {JointPage} JointExplorer */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {JointExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => jointExplorer(stageOf(root, data), data));

/** @typedef {{q: number[]}} State */

/**
 * Builds a slider and a handle for each joint.
 * @param {Stage} stage
 * @param {JointExplorer} data
 */
function jointExplorer(stage, data) {
  const {arm, words, units} = data,
    state = {q: [...data.q]},
    rings = ringsOf(arm.chain, arm.reach),
    long = TRIAD * stage.scene.size,
    sizes = units.map(unit => unit.size);
  const sliders = data.controls.map((spec, j) =>
    slider(spec, value => {
      state.q[j] = limited(arm.limits[j], value * sizes[j]);
      stage.changed();
    }),
  );
  const numbers = table(
    data.rows.map(row => row.name),
    [],
    data.rows.map(row => row.heads.length),
  );
  const now = element("span", {class: "rk-count"});
  stage.title.append(now); // above the picture, so that it can be read while a ring is dragged
  const more = ellipsoidMenu(data, stage.changed),
    axes = tick(words.axes, stage.changed, true),
    copy = copyButton(words, () => fill(data.code, {q: inUnits(units, state.q)}));
  stage.side.append(
    ...sliders.map(s => s.row),
    ...(data.singular ? [more.row] : []),
    element("div", {class: "rk-row"}, axes.row, copy),
    stage.says,
  );
  stage.below.append(numbers.node);
  if (data.wrist) stage.space.classList.add("rk-close");
  stage.handles.set(arm.chain.map((_, j) => jointHandle(data, rings, state, j)));

  stage.run(() => {
    const {q} = state,
      {ellipsoid, speeds} = more.at(q);
    sliders.forEach((s, j) => s.set(q[j] / sizes[j]));
    const told = cells(data, q);
    numbers.set(told);
    now.textContent = `${data.rows[0].name}: ${told[0].join(", ")}`;
    if (data.wrist) stage.scene.things = [point(words.wrist, wristCentre(arm, q, data.wrist))];
    if (data.singular) stage.say(singular(data, q) + speeds);
    return [
      {
        name: arm.name,
        chain: arm.chain,
        q,
        framed: true,
        glass: data.wrist !== null,
        around: camera => around(camera, arm.chain, rings, q, stage.handles.shown(), long),
        over: (g, camera) => drawRings(g, camera, arm.chain, rings, q, stage.handles.shown()),
        axes: axes.on(),
        ellipsoid,
      },
    ];
  });
}

/** @type {(limits: number[], value: number) => number} */
const limited = ([low, high], value) => Math.min(Math.max(value, low), high);

/**
 * The handle of joint j, which is a ring.
 * @param {JointExplorer} data
 * @param {Ring[]} rings
 * @param {State} state
 * @param {number} j
 * @returns {Handle}
 */
function jointHandle({arm, words, units, controls, q: home}, rings, state, j) {
  const {size, name} = units[j],
    step = controls[j].step * size,
    small = arm.chain[j].prismatic ? 1e-3 : 0.01,
    count = arm.chain.length,
    half = Math.ceil(count / 2);
  /** @type {(value: number) => void} */
  const set = value => {
    state.q[j] = limited(arm.limits[j], value);
  };
  /** @type {(camera: Camera, value: number) => Point} */
  const place = (camera, value) =>
    ringAt(
      arm.chain,
      rings,
      state.q.map((x, k) => (k === j ? value : x)),
      j,
      camera,
    ).grip;
  return {
    id: `q${j + 1}`,
    group: fill(words.rings, j < half ? {first: 1, last: half} : {first: half + 1, last: count}),
    name: fill(words.takeJoint, {joint: j + 1}),
    look: "rk-joint",
    mark: String(j + 1),
    color: /** @type {Color} */ (`joint${(j % 6) + 1}`),
    at: camera => place(camera, state.q[j]),
    value: () => `${number(state.q[j] / size, 1)} ${name}`,
    grab(camera) {
      const to = alongCurve(camera, value => place(camera, value), state.q[j], small);
      return (dx, dy) => set(to(dx, dy));
    },
    step: (right, up, big) => set(state.q[j] + (right + up) * step * (big ? 10 : 1)),
    home() {
      state.q[j] = home[j];
    },
  };
}

/**
 * The wrist centre in base coordinates, from its place in flange coordinates.
 * @param {ArmData} arm
 * @param {number[]} q
 * @param {Point} wrist
 */
function wristCentre({chain}, q, wrist) {
  const flange = fk(chain, q);
  return plus(origin(flange), turned(flange, wrist));
}

/**
 * The cells of the table: the numbers of the flange.
 * @param {JointExplorer} data
 * @param {number[]} q
 */
function cells({arm, unit, rows}, q) {
  const flange = fk(arm.chain, q),
    rotation = quaternion(flange);
  /** @type {Record<string, number[]>} */
  const facts = {
    place: origin(flange).map(x => x / unit.size),
    turns: rollPitchYaw(flange).map(degrees),
    rotation: rotation[0] < 0 ? rotation.map(x => -x) : rotation,
    near: [distance_from_singularity(arm, q)],
  };
  return rows.map(({fact, heads, decimals}) =>
    facts[fact].map((x, k) => `${heads[k]} ${number(x, decimals)}`.trim()),
  );
}

/**
 * The singularities of the posture, as text.
 * @param {JointExplorer} data
 * @param {number[]} q
 */
function singular({arm, words}, q) {
  const names = Object.entries(arm.geometry.kind ? singularities(arm, q) : {})
    .filter(([, holds]) => holds)
    .map(([name]) => fill(words.singularity, {name}));
  return names.length ? fill(words.singular, {names: names.join(words.and)}) : words.regular;
}
