// The handles of an explorer of three levers: joint A changes the free angle alpha, and the ring
// moves the point.

import {frames, origin, plus} from "./kinematics.js";
import {alpha_range, family} from "./levers.js";
import {number} from "./canvas.js";
import {inScreen} from "./handles.js";
import {distance2} from "./rows.js";
import {degrees, radians} from "./turns.js";

/** @import {Pixel, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {LeversExplorer, State} from "./levers_explorer.js" */

const HIDDEN = [NaN, NaN, NaN];

/**
 * The handle of joint A, which changes alpha. The gripper stays in place. If no
 * posture reaches the point, there is no handle.
 * @param {LeversExplorer} data
 * @param {State} state
 * @returns {Handle}
 */
export function alphaHandle({words}, state) {
  /** @type {(alpha: number) => Point} */
  const jointA = alpha => {
    /** @type {number[][]} */
    const joints = [];
    frames(state.arm.chain, family(state.arm, state, alpha), joints);
    return origin(joints[2]);
  };
  return {
    id: "alpha",
    name: words.takeAlpha,
    look: "rk-joint",
    mark: "\u03B1",
    color: "joint3",
    at: () => (Number.isNaN(alpha_range(state.arm, state)[0]) ? HIDDEN : jointA(state.alpha)),
    value: () => `${number(degrees(state.alpha), 1)}\u00B0`,
    grab(camera) {
      const from = camera.to(jointA(state.alpha));
      return (dx, dy) => {
        state.alpha = nearest(camera, jointA, alpha_range(state.arm, state), [
          from[0] + dx,
          from[1] + dy,
        ]);
      };
    },
    step(right, up, big) {
      state.alpha += radians((right + up) * (big ? 10 : 1));
    },
    home() {
      state.alpha = state.before[2];
    },
  };
}

/**
 * Returns the value between both ends whose place is nearest to a pixel. Starts with the best of 41
 * values, and then refines the search twice, with 41 values between the neighbours of the best.
 * @param {Camera} camera
 * @param {(value: number) => Point} place
 * @param {[number, number]} ends
 * @param {Pixel} pixel
 */
function nearest(camera, place, ends, [px, py]) {
  let [low, high] = ends,
    best = low;
  for (let round = 0; round < 3; round++) {
    const step = (high - low) / 40;
    let shortest = Infinity;
    for (let i = 0; i <= 40; i++) {
      const value = low + i * step,
        [x, y] = camera.to(place(value)),
        away = distance2(x - px, y - py);
      if (away < shortest) [best, shortest] = [value, away];
    }
    [low, high] = [Math.max(ends[0], best - step), Math.min(ends[1], best + step)];
  }
  return best;
}

/**
 * The handle of the point.
 * @param {LeversExplorer} data
 * @param {State} state
 * @returns {Handle}
 */
export function pointHandle({words, unit, targets}, state) {
  const fine = 5e-3;
  return {
    id: "free",
    name: words.takeFree,
    look: "rk-free",
    at: () => state.place,
    value() {
      const [x, y] = state.place.map(each => number(each / unit.size, unit.name === "m" ? 3 : 1));
      return `${x}, ${y} ${unit.name}`;
    },
    grab(camera) {
      const to = inScreen(camera, state.place);
      return (dx, dy) => {
        state.place = [...to(dx, dy).slice(0, 2), 0];
      };
    },
    step(right, up, big) {
      state.place = plus(state.place, [right, up, 0], fine * (big ? 10 : 1));
    },
    home() {
      state.place = [...targets[Math.min(state.task, targets.length - 1)].place];
    },
  };
}
