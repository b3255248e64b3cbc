// Draws a plan in the picture of its explorer, in the plane of the arm.

import {clear, colors, polygon, spot, stroke} from "./canvas.js";
import {polyline} from "./kinematics.js";

/** @import {PageLink} from "./page.js" */
/** @import {Pixel} from "./canvas.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Now, Shown, State} from "./plan_explorer.js" */
/** @import {Draw} from "./scene.js" */

const QUADRILATERALS = /** @type {const} */ (["joint3", "joint2"]);

/**
 * The arm at the current moment of the motion, with the drawings below and above it.
 * @param {ThreeLeverArm} arm
 * @param {State} state
 * @param {Now} now
 */
export function armAt({name, chain}, state, {shown, moment}) {
  const {moments} = shown,
    k = Math.round(moment),
    end = {q: moments[moments.length - 1], past: true};
  return {
    name,
    chain,
    q: k > 0 ? moments[k] : state.q,
    ghosts: k > 0 ? [end, {q: state.q, past: false}] : [end],
    under: drawBelow(chain, shown, state),
    over: drawAbove(shown, state),
    labels: (shown.direct?.quadrilaterals ?? []).map((corners, k) => ({
      text: ["AK", "BA"][k],
      at: [mean(corners, 0), mean(corners, 1), 0],
      color: colors[QUADRILATERALS[k]],
    })),
  };
}

/**
 * Draws the clearance around H, the quadrilaterals, the area that the levers sweep, and the
 * gripper's path.
 * @type {(chain: PageLink[], shown: Shown, state: State) => Draw}
 */
const drawBelow =
  (chain, {kept, direct, moments}, state) =>
  (g, {to, scale}) => {
    const postures = moments.map(q => polyline(chain, q));
    const radius = state.distance * scale;
    spot(g, to(state.obstacle), radius, clear(colors.ghost, 0.25), colors.ghost, 1);
    /** @type {(points: number[][]) => Pixel[]} */
    const flat = points => points.map(([x, y]) => to([x, y, 0]));
    direct?.quadrilaterals.forEach((corners, k) => {
      const color = colors[QUADRILATERALS[k]];
      polygon(g, flat(corners), clear(color, 0.12), color, 1.2);
    });
    const color = kept ? colors.accent : colors.alarm;
    stroke(
      g,
      postures.flatMap(points => [...points.map(to), null]),
      clear(color, 0.3),
      1,
    );
    stroke(
      g,
      postures.map(points => to(points[points.length - 1])),
      color,
      2,
    );
  };

/** @type {(points: number[][], k: number) => number} */
const mean = (points, k) => points.reduce((sum, p) => sum + p[k], 0) / points.length;

/**
 * Draws the line from the obstacle to the nearest point of the levers.
 * @type {(shown: Shown, state: State) => Draw}
 */
const drawAbove =
  ({nearest: [at]}, state) =>
  (g, {to}) => {
    const [x, y] = to(state.obstacle),
      p = to([...at, 0]),
      far = Math.hypot(p[0] - x, p[1] - y);
    if (far > 3) stroke(g, [[x, y], p], colors.near, 2);
    spot(g, p, 3.5, colors.near);
  };
