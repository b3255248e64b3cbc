// The joint explorer: joints taken by the hand. What is said, and every number of the arm, comes
// from Python (page.py: PageExplorer).

import {distance_from_singularity, fk, origin, quaternion} from "./kinematics.js";
import {singularities} from "./geometries.js";
import {fill} from "./blanks.js";
import {number} from "./canvas.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {alongCurve, gripOf} from "./handles.js";
import {slider, stageOf, table, tick} from "./stage.js";
import {ellipsoidOf, degrees, inUnits, rollPitchYaw} from "./turns.js";

/** @import {PageExplorer, With} from "./page.js" */
/** @import {Color, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Stage} from "./stage.js" */

/** @typedef {With<PageExplorer, "arm" | "units" | "q" | "rows">} JointExplorer */

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {JointExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => jointExplorer(stageOf(root, data), data));

/**
 * A slider for each joint and a handle on it.
 * @param {Stage} stage
 * @param {JointExplorer} data
 */
function jointExplorer(stage, data) {
  const {arm, words, units} = data,
    state = {q: [...data.q]},
    sizes = units.map(unit => unit.size);
  /** @type {(j: number, value: number) => number} */
  const limited = (j, value) => Math.min(Math.max(value, arm.limits[j][0]), arm.limits[j][1]);
  const sliders = data.controls.map((spec, j) =>
    slider(spec, value => {
      state.q[j] = limited(j, value * sizes[j]);
      stage.changed();
    }),
  );
  const numbers = table(
    data.rows.map(row => row.name),
    [],
    data.rows.map(row => row.heads.length),
  );
  const more = tick(words.ellipsoid, stage.changed),
    axes = tick(words.axes, stage.changed, true);
  stage.side.append(
    ...sliders.map(s => s.row),
    element(
      "div",
      {class: "rk-row"},
      more.row,
      axes.row,
      copyButton(words, () => fill(data.code, {q: inUnits(units, state.q)})),
    ),
    stage.says,
  );
  stage.below.append(numbers.node);

  stage.handles.set(
    arm.chain.map(
      /** @returns {Handle} */ (link, j) => {
        const step = data.controls[j].step * sizes[j];
        /** @type {(camera: Camera, value: number) => Point} */
        const place = (camera, value) =>
          gripOf(
            arm.chain,
            state.q.map((x, k) => (k === j ? value : x)),
            j,
            camera,
          );
        return {
          id: `q${j + 1}`,
          name: fill(words.takeJoint, {joint: j + 1}),
          look: "rk-joint",
          mark: String(j + 1),
          color: /** @type {Color} */ (`joint${(j % 6) + 1}`),
          at: camera => place(camera, state.q[j]),
          value: () => `${number(state.q[j] / sizes[j], 1)} ${units[j].name}`,
          grab(camera) {
            const to = alongCurve(
              camera,
              value => place(camera, value),
              state.q[j],
              link.prismatic ? 1e-3 : 0.01,
            );
            return (dx, dy) => {
              state.q[j] = limited(j, to(dx, dy));
            };
          },
          step(right, up, big) {
            state.q[j] = limited(j, state.q[j] + (right + up) * step * (big ? 10 : 1));
          },
          home() {
            state.q[j] = data.q[j];
          },
        };
      },
    ),
  );

  stage.run(() => {
    const q = state.q,
      flange = fk(arm.chain, q),
      place = origin(flange),
      rotation = quaternion(flange);
    sliders.forEach((s, j) => s.set(q[j] / sizes[j]));
    /** @type {Record<string, number[]>} */
    const facts = {
      place: place.map(x => x / data.unit.size),
      turns: rollPitchYaw(flange).map(degrees),
      rotation: rotation[0] < 0 ? rotation.map(x => -x) : rotation,
      near: [distance_from_singularity(arm, q)],
    };
    numbers.set(
      data.rows.map(({fact, heads, decimals}) =>
        facts[fact].map((x, k) => `${heads[k]} ${number(x, decimals)}`.trim()),
      ),
    );
    const held = Object.entries(arm.geometry.kind ? singularities(arm, q) : {})
      .filter(([, holds]) => holds)
      .map(([name]) => fill(words.singularity, {name}));
    stage.say(held.length ? fill(words.singular, {names: held.join(words.and)}) : words.regular);
    return [
      {
        name: arm.name,
        chain: arm.chain,
        q,
        framed: true,
        axes: axes.on(),
        ellipsoid: more.on() && ellipsoidOf(arm, q),
      },
    ];
  });
}
