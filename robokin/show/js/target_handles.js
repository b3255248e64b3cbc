// The handles of a target, which move it freely or along its axes, and rotate it about them.

import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {alongCurve, inScreen, reachOf} from "./handles.js";
import {dot, plus} from "./kinematics.js";
import {matrix, product} from "./rotations.js";
import {AXES} from "./triad.js";
import {aboutAxis, degrees, normal, radians, rollPitchYaw, rotationOf} from "./turns.js";

/** @import {Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Stage} from "./stage.js" */
/** @import {ArmData, TargetPage, With} from "./page.js" */
/** @import {Target} from "./target_explorer.js" */

const ALONG = 0.9999; // directions count as parallel if the cosine of their angle is greater

/**
 * The page data that the handles need.
 * @typedef {Pick<TargetPage, "scene" | "unit" | "words"> & {arm: Pick<ArmData, "target">}} Moved
 */
/**
 * The common arguments of all handles of a target.
 * @typedef {{stage: Stage, state: Target, home: Target, data: Moved, fine: number}} Held
 */

/**
 * @param {Stage} stage
 * @param {Target} state
 * @param {Target} home
 * @param {Moved} data
 * @returns {Handle[]}
 */
export function targetHandles(stage, state, home, data) {
  const {flat, size} = data.scene,
    fine = 5e-3 * (data.unit.size < 1 ? 1 : size / 2),
    axes = [0, 1, 2].filter(k => k !== flat);
  /** @type {Held} */
  const held = {stage, state, home, data, fine};
  return [
    freeHandle(held),
    ...axes.map(k => alongHandle(held, k)),
    ...(data.arm.target === "Transform" ? [0, 1, 2].map(k => turnHandle(held, k)) : []),
    ...(data.arm.target === "ScaraPose" ? [angleHandle(held)] : []),
  ];
}

/**
 * Axis k of the target or, if it has no rotation, of the base.
 * @type {(state: Target, k: number) => number[]}
 */
const axisOf = ({rotation}, k) => {
  const axes = rotation ? matrix(rotation) : null;
  return [0, 1, 2].map(i => (axes ? axes[4 * i + k] : Number(i === k)));
};

/**
 * A place on a ring around the target.
 * @type {(state: Target, camera: Camera, x: number, a: number[], b: number[]) => Point}
 */
const rim = ({place}, camera, x, a, b) =>
  plus(plus(place, a, reachOf(camera) * Math.cos(x)), b, reachOf(camera) * Math.sin(x));

/** @type {(held: Held) => string} */
const placeText = ({state, data: {unit}}) =>
  `${state.place.map(x => number(x / unit.size, 1)).join(", ")} ${unit.name}`;

/** @type {(held: Held) => Handle} */
function freeHandle(held) {
  const {stage, state, home, data, fine} = held;
  /** @type {(place: Point) => void} */
  const move = place => {
    state.place = place.map((x, k) => (k === data.scene.flat ? state.place[k] : x));
  };
  return {
    id: "free",
    group: data.words.ringsMove,
    name: data.words.takeFree,
    look: "rk-free",
    at: () => state.place,
    value: () => placeText(held),
    grab(camera) {
      const to = inScreen(camera, state.place);
      return (dx, dy) => move(to(dx, dy));
    },
    step(right, up, big) {
      const camera = stage.camera(),
        by = fine * camera.scale * (big ? 10 : 1);
      move(plus(state.place, camera.across(right * by, -up * by)));
    },
    home() {
      state.place = [...home.place];
    },
  };
}

/** @type {(held: Held, k: number) => Handle} */
function alongHandle(held, k) {
  const {state, home, data, fine} = held;
  return {
    id: AXES[k],
    group: data.words.ringsMove,
    name: fill(data.words.takeAlong, {axis: AXES[k]}),
    look: "rk-arrow",
    mark: AXES[k],
    color: AXES[k],
    at(camera) {
      const axis = axisOf(state, k);
      if (Math.abs(dot(axis, camera.toward)) > ALONG) return [NaN, NaN, NaN]; // cannot be dragged
      return plus(state.place, axis, reachOf(camera));
    },
    value: () => placeText(held),
    grab(camera) {
      const from = state.place,
        way = axisOf(state, k),
        r = reachOf(camera);
      const to = alongCurve(camera, x => plus(from, way, x + r), 0, fine);
      return (dx, dy) => {
        state.place = plus(from, way, to(dx, dy));
      };
    },
    step(right, up, big) {
      state.place = plus(state.place, axisOf(state, k), (right + up) * fine * (big ? 10 : 1));
    },
    home() {
      state.place = [...home.place];
    },
  };
}

/** @type {(held: Held, k: number) => Handle} */
function turnHandle({state, home, data}, k) {
  const others = () =>
    /** @type {const} */ ([axisOf(state, (k + 1) % 3), axisOf(state, (k + 2) % 3)]);
  /** @type {(axis: number[], angle: number) => void} */
  const turnBy = (axis, angle) => {
    const {rotation} = /** @type {With<Target, "rotation">} */ (state);
    state.rotation = normal(product(aboutAxis(axis, angle), rotation));
    state.turns = rollPitchYaw(matrix(state.rotation));
  };
  return {
    id: `turn ${AXES[k]}`,
    group: data.words.ringsTurn,
    name: fill(data.words.takeTurn, {axis: AXES[k]}),
    look: "rk-arc",
    mark: "\u21BB",
    color: AXES[k],
    at: camera => rim(state, camera, Math.PI / 4, ...others()),
    value: () => `${state.turns.map(x => number(degrees(x), 1)).join(", ")} \u00B0`,
    grab(camera) {
      const [from, about] = [state.rotation, axisOf(state, k)],
        around = others();
      const to = alongCurve(camera, x => rim(state, camera, x + Math.PI / 4, ...around), 0, 0.02);
      return (dx, dy) => {
        state.rotation = from;
        turnBy(about, to(dx, dy));
      };
    },
    step(right, up, big) {
      turnBy(axisOf(state, k), (right + up) * radians(big ? 10 : 1));
    },
    home() {
      [state.turns, state.rotation] = [[...home.turns], rotationOf(home.turns)];
    },
  };
}

/** @type {(held: Held) => Handle} */
function angleHandle({state, home, data}) {
  const turned = /** @type {With<Target, "angle">} */ (state);
  /** @type {(camera: Camera, x: number) => Point} */
  const place = (camera, x) => rim(state, camera, x, [1, 0, 0], [0, 1, 0]);
  return {
    id: "angle",
    group: data.words.ringsTurn,
    name: data.words.takeAngle,
    look: "rk-arc",
    mark: "\u21BB",
    color: "z",
    at: camera => place(camera, turned.angle),
    value: () => `${number(degrees(turned.angle), 1)} \u00B0`,
    grab(camera) {
      const to = alongCurve(camera, x => place(camera, x), turned.angle, 0.02);
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
  };
}
