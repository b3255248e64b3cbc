// The handles of a blended motion: start and goal move freely in the plane of the screen, the via
// point also along the base's axes.

import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {alongCurve, inScreen, reachOf} from "./handles.js";
import {plus} from "./kinematics.js";
import {AXES} from "./triad.js";

/** @import {Point} from "./canvas.js" */
/** @import {Handle} from "./handles.js" */
/** @import {MotionPage} from "./page.js" */
/** @import {Asked, Stations} from "./motion_parts.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {{stage: Stage, state: Asked, data: MotionPage, fine: number}} Held */

export const STATIONS = /** @type {const} */ (["start", "via", "goal"]);

/**
 * @param {Stage} stage
 * @param {Asked} state
 * @param {MotionPage} data
 * @returns {Handle[]}
 */
export function stationHandles(stage, state, data) {
  const {flat, size} = data.scene,
    fine = 5e-3 * (data.unit.size < 1 ? 1 : size / 2);
  /** @type {Held} */
  const held = {stage, state, data, fine};
  return [
    ...STATIONS.map(name => freeHandle(held, name)),
    ...[0, 1, 2].filter(k => k !== flat).map(k => alongHandle(held, k)),
  ];
}

/**
 * The common parts of both kinds of handles: the place as text, and the reset to the original
 * place.
 * @param {Held} held
 * @param {keyof Stations} name
 */
const common = ({state, data}, name) => ({
  value: () =>
    `${state[name].place.map(x => number(x / data.unit.size, 1)).join(", ")} ${data.unit.name}`,
  home() {
    state[name].place = [...data[name].place];
  },
});

/** @type {(held: Held, name: keyof Stations) => Handle} */
function freeHandle(held, name) {
  const {stage, state, data, fine} = held;
  /** @type {(place: Point, from: Point) => void} */
  const move = (place, from) => {
    state[name].place = place.map((x, k) => (k === data.scene.flat ? from[k] : x));
  };
  return {
    ...common(held, name),
    id: name,
    group: data.words.ringsFree,
    name: fill(data.words.takeStation, {name}),
    look: "rk-free",
    at: () => state[name].place,
    grab(camera) {
      const from = state[name].place,
        to = inScreen(camera, from);
      return (dx, dy) => move(to(dx, dy), from);
    },
    step(right, up, big) {
      const camera = stage.camera(),
        by = fine * camera.scale * (big ? 10 : 1),
        from = state[name].place;
      move(plus(from, camera.across(right * by, -up * by)), from);
    },
  };
}

/** @type {(held: Held, k: number) => Handle} */
function alongHandle(held, k) {
  const {state, data, fine} = held,
    way = [0, 1, 2].map(i => Number(i === k));
  return {
    ...common(held, "via"),
    id: `via ${AXES[k]}`,
    group: data.words.ringsVia,
    name: fill(data.words.takeVia, {axis: AXES[k]}),
    look: "rk-arrow",
    mark: AXES[k],
    color: AXES[k],
    at: camera => plus(state.via.place, way, reachOf(camera)),
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
}
