// The rotation explorer: the reader rotates a vector v about an axis n, and sees the product q v
// and the rotated vector q v q*. All text comes from Python (explorer_page.py: RotationPage).

import {fill, plain} from "./blanks.js";
import {number} from "./canvas.js";
import {orbit} from "./controls.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {alongCurve} from "./handles.js";
import {cross, plus} from "./kinematics.js";
import {onCircle, rotationPicture} from "./rotation_picture.js";
import {product} from "./rotations.js";
import {clamp} from "./rows.js";
import {frameOf, slider} from "./stage.js";
import {table} from "./table.js";
import {aboutAxis, degrees, lengths, radians} from "./turns.js";

/** @import {RotationPage} from "./page.js" */
/** @import {Point, Ring} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */

/** @typedef {[angle: number, tilt: number]} State  degrees: of the rotation, and from n to v */
/** @typedef {ReturnType<typeof products>} Products */
/** @typedef {Products & {alt: string, handles: (cam: Camera) => Ring[]}} Seen */

const TINY = 1e-9; // radians: angles that differ by less count as equal

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {RotationPage} data
 */
export const explore = (id, data) => waiting(id).forEach(root => rotationExplorer(root, data));

/**
 * The vector v; its components along the axis (`foot`) and perpendicular to it (`side`), and `side`
 * after a quarter turn about the axis; and q, q v and q v q* as [w, x, y, z].
 * @param {Pick<RotationPage, "axis" | "across" | "length">} data
 * @param {number} angle  of the rotation
 * @param {number} tilt  from the axis to v
 */
export function products({axis, across, length}, angle, tilt) {
  const foot = axis.map(x => x * length * Math.cos(tilt)),
    side = across.map(x => x * length * Math.sin(tilt)),
    v = plus(foot, side),
    q = aboutAxis(axis, angle),
    left = product(q, [0, ...v]),
    whole = product(left, [q[0], -q[1], -q[2], -q[3]]);
  return {angle, v, foot, side, quarter: cross(axis, side), q, left, whole};
}

/**
 * @param {HTMLElement} root
 * @param {RotationPage} data
 */
function rotationExplorer(root, data) {
  const {words, controls, unit} = data,
    home = /** @type {State} */ (data.angles.map(degrees)),
    picture = rotationPicture(data),
    stage = frameOf(root, data, picture);
  /** @type {State} */
  const state = [...home];
  /** @type {(k: number, value: number) => void} */
  const set = (k, value) => {
    state[k] = clamp(value, controls[k].low, controls[k].high);
    stage.changed();
  };
  const sliders = controls.map((spec, k) => slider(spec, value => set(k, value))),
    rows = table(data.rows, data.heads, [1, 1, 1, 1]),
    real = element("b");
  const copy = copyButton(words, () => fill(data.code, inCode(data, state)));
  stage.side.append(
    ...sliders.map(each => each.row),
    element("p", {class: "rk-real"}, words.real, real),
    rows.node,
    stage.says,
    element("div", {class: "rk-row"}, copy),
  );
  const curves = [
    /** @param {number} x */ x => onCircle(at(data, state), x),
    /** @param {number} x */ x => products(data, 0, x).v,
  ];
  stage.handles.set(curves.map((curve, k) => handle(data, state, home, k, curve, set)));

  orbit(picture.canvas, data.scene, picture, stage.ask);
  stage.run(() => {
    const found = at(data, state),
      facts = factsOf(data, state, found),
      says = told(data, state, facts);
    sliders.forEach((each, k) => each.set(state[k]));
    real.textContent = `${facts.real} ${unit.name}`;
    rows.set(cells(data, found));
    stage.say(says);
    return {...found, alt: `${fill(words.seen, facts)} ${says}`, handles: stage.handles.place};
  });
}

/** @type {(data: RotationPage, state: State) => Products} */
const at = (data, [angle, tilt]) => products(data, radians(angle), radians(tilt));

/**
 * The cells of the table: q, v, q v and q v q*.
 * @param {RotationPage} data
 * @param {Products} found
 */
function cells({unit, decimals}, {q, v, left, whole}) {
  const vectors = [[0, ...v], left, whole].map(row =>
    row.map(x => number(x / unit.size, decimals)),
  );
  return [q.map(x => number(x, 3)), ...vectors];
}

/**
 * The numbers of the sentences, as text.
 * @param {RotationPage} data
 * @param {State} state
 * @param {Products} found
 */
function factsOf(data, [angle, tilt], found) {
  const [, , left, whole] = cells(data, found),
    {length, unit, decimals} = data;
  /** @type {(x: number) => string} */
  const inUnit = x => number(x / unit.size, decimals);
  const along = length * Math.cos(radians(tilt));
  return {
    length: inUnit(length),
    unit: unit.name,
    tilt: number(tilt, 1),
    angle: number(angle, 1),
    half: number(angle / 2, 1),
    real: left[0],
    left: left.slice(1).join(", "),
    whole: whole.slice(1).join(", "),
    along: inUnit(along),
    kept: inUnit(along * Math.cos(radians(angle) / 2)),
  };
}

/**
 * Says how the two products change v perpendicular to the axis and along it.
 * @param {RotationPage} data
 * @param {State} state
 * @param {ReturnType<typeof factsOf>} facts
 */
function told({words}, [angle, tilt], facts) {
  const across = Math.sin(radians(tilt)) < TINY ? words.parallel : words.half,
    along = Math.abs(Math.cos(radians(tilt))) < TINY ? words.perpendicular : words.along;
  const whole = Math.abs(Math.sin(radians(angle) / 2)) < TINY,
    alone = Math.cos(radians(angle) / 2) > 0 ? words.one : words.minus;
  return (whole ? [alone] : [across, along]).map(each => fill(each, facts)).join(" ");
}

/**
 * A ring at the tip of q v q*, which moves the angle (k = 0), or at the tip of v, which moves the
 * angle from the axis to v (k = 1).
 * @param {RotationPage} data
 * @param {State} state
 * @param {State} home
 * @param {number} k
 * @param {(radians: number) => Point} curve
 * @param {(k: number, value: number) => void} set
 * @returns {Handle}
 */
const handle = ({words, controls}, state, home, k, curve, set) => ({
  id: ["angle", "tilt"][k],
  name: [words.takeAngle, words.takeTilt][k],
  look: "rk-free",
  color: k ? "ink" : "accent",
  at: () => curve(radians(state[k])),
  value: () => `${controls[k].name} ${number(state[k], 1)}\u00B0`,
  grab(camera) {
    const to = alongCurve(camera, curve, radians(state[k]), 0.01);
    return (dx, dy) => set(k, Math.round(degrees(to(dx, dy))));
  },
  step: (right, up, big) => set(k, state[k] + (right + up) * (big ? 10 : 1)),
  home() {
    state[k] = home[k];
  },
});

/**
 * @param {RotationPage} data
 * @param {State} state
 */
function inCode(data, state) {
  /** @type {(row: string[]) => string} */
  const list = row => `[${row.join(", ")}]`;
  return {
    angle: plain(state[0], 3),
    axis: list(data.axis.map(x => plain(x, 9))),
    v: list(lengths(at(data, state).v, data.unit)),
    unit: data.unit.code,
  };
}
