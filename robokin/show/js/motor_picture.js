// The picture of a motor, seen along its shaft, for the stage of an explorer.

import {fill} from "./blanks.js";
import {colors, font, number, polygon, prepared, shape, spot, stroke, write} from "./canvas.js";
import {control} from "./elements.js";
import {holdingTorque, pull} from "./rotor.js";
import {degrees} from "./turns.js";

/** @import {PageMotors} from "./page.js" */
/** @import {Bench} from "./bench.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Context, Pixel} from "./canvas.js" */
/** @import {Motor} from "./rotor.js" */
/** @import {Picture} from "./stage.js" */

/** @typedef {(angle: number, r: number) => Pixel} Round  converts polar coordinates to pixels */
/** @typedef {{g: Context, at: Round}} Pen */

/**
 * @param {PageMotors} data
 * @param {Bench} bench
 * @param {() => void} changed  called when the rotor is grabbed, and when it is released
 * @returns {Picture<Bench>}
 */
export function motorPicture(data, bench, changed) {
  const canvas = control("canvas", {class: "rk-shaft", role: "img", "aria-label": data.alt});
  let seen = alongShaft(0, 0);
  return {
    canvas,
    camera: () => seen,
    hold(on) {
      bench.hold(on);
      changed();
    },
    draw(now) {
      const ready = prepared(canvas);
      if (!ready) return false;
      const [g, w, h] = ready;
      seen = alongShaft(w, h);
      drawMotor(g, seen, now, data.words);
      return true;
    },
  };
}

/**
 * The distance of the handle from the shaft: at the rotor's N, or at its teeth.
 * @param {Bench} bench
 */
export const gripRadius = bench => (bench.page().teeth ? 0.52 : 0.46);

/**
 * The camera along the shaft; the unit of length is the radius of the motor.
 * @param {number} w
 * @param {number} h
 * @returns {Camera}
 */
function alongShaft(w, h) {
  const scale = Math.max(1, Math.min(w, h) / 2 - 6);
  return {
    scale,
    toward: [0, 0, 1],
    to: ([x, y]) => [w / 2 + scale * x, h / 2 - scale * y],
    along: ([x, y]) => [scale * x, -scale * y],
    across: (dx, dy) => [dx / scale, -dy / scale, 0],
  };
}

/**
 * @param {Context} g
 * @param {Camera} camera
 * @param {Bench} bench
 * @param {PageMotors["words"]} says
 */
function drawMotor(g, camera, bench, says) {
  const {motor, live, sent} = bench,
    {teeth, space} = bench.page(),
    [x, y] = camera.to([0, 0, 0]);
  /** @type {Pen} */
  const pen = {g, at: (angle, r) => camera.to([r * Math.cos(angle), r * Math.sin(angle)])};
  drawStator(pen, camera.scale, bench);
  if (teeth) drawTeeth(pen, live.theta, teeth);
  else drawMagnet(pen, live.theta);
  const [across, along] = pull(motor, motor.currents[bench.row()]),
    [u, v] = pull(motor, motor.currents[0]);
  const field = space * (Math.atan2(v, u) + ((2 * Math.PI) / motor.currents.length) * sent),
    long = 0.29 * Math.sqrt(across * across + along * along);
  for (const turn of teeth ? [0, Math.PI] : [0]) drawArrow(pen, field + turn, long);
  if (motor.load) drawWeight(pen, motor);
  spot(g, [x, y], 4, colors.hub, colors.edge, 1.2);
  /** @type {(text: string, angle: number) => string} */
  const said = (text, angle) => fill(text, {angle: number(degrees(angle), 1)});
  write(g, said(says.rotorAt, live.theta), 4, 14, colors.ink, 12, "left", "600");
  write(g, said(says.fieldAt, field), 2 * x - 4, 14, colors.accent, 12, "right", "600");
}

/** @type {(at: Round, from: number, to: number, r: number) => Pixel[]} */
const arc = (at, from, to, r) =>
  Array.from({length: 25}, (_, i) => at(from + ((to - from) * i) / 24, r));

/**
 * Draws the ring and its poles, each coloured by the current in its winding.
 * @param {Pen} pen
 * @param {number} size
 * @param {Bench} bench
 */
function drawStator({g, at}, size, bench) {
  const {poles} = bench.page(),
    currents = bench.motor.currents[bench.row()],
    half = Math.min(0.26, (0.5 * Math.PI) / poles.length),
    rim = /** @type {const} */ ([colors.footEdge, 1.2]);
  shape(g, () => g.arc(...at(0, 0), size, 0, 2 * Math.PI), colors.foot, ...rim);
  shape(g, () => g.arc(...at(0, 0), 0.9 * size, 0, 2 * Math.PI), colors.paper, ...rim);
  for (const {at: place, winding, sign, name} of poles) {
    /** @type {(inner: number, low: number, outer: number, high: number) => Pixel[]} */
    const block = (inner, low, outer, high) => [
      ...arc(at, place - half * inner, place + half * inner, low),
      ...arc(at, place + half * outer, place - half * outer, high),
    ];
    const now = currents[winding] * sign,
      color = now > 0 ? colors.joint5 : now < 0 ? colors.joint6 : colors.paper,
      mark = now > 0 ? "+" : now < 0 ? "\u2212" : "";
    polygon(g, block(0.7, 0.62, 0.62, 0.92), colors.foot, ...rim);
    polygon(g, block(1.15, 0.66, 1, 0.89), color, colors.ink, now ? 1.8 : 0.8);
    plainWords(g, `${name}${mark}`, at(place, 0.78), now ? colors.edge : colors.soft, !!now);
  }
}

/** @type {(pen: Pen, theta: number, teeth: number) => void} */
function drawTeeth({g, at}, theta, teeth) {
  const pitch = (2 * Math.PI) / teeth,
    profile = [
      [-0.26, 0.44],
      [-0.2, 0.59],
      [0.2, 0.59],
      [0.26, 0.44],
    ];
  const rim = Array.from({length: teeth}, (_, k) =>
    profile.map(([share, r]) => at(theta + pitch * (k + share), r)),
  );
  polygon(g, rim.flat(), colors.rod, colors.edge, 1.2);
}

/** @type {(pen: Pen, theta: number) => void} */
function drawMagnet({g, at}, theta) {
  for (const {turn, color, name} of [
    {turn: theta, color: colors.joint2, name: "N"},
    {turn: theta + Math.PI, color: colors.rod, name: "S"},
  ]) {
    const half = arc(at, turn - Math.PI / 2, turn + Math.PI / 2, 0.57);
    polygon(g, half, color, colors.edge, 1.2);
    // on the screen the handle covers this N
    const [x, y] = at(turn, 0.46);
    write(g, name, x, y + 5, colors.ink, 12, "center", "700");
  }
}

/** Draws the weight on the drum, which pulls clockwise. @type {(pen: Pen, motor: Motor) => void} */
function drawWeight({g, at}, motor) {
  const from = Math.PI / 2 + 1.3,
    to = from - 2.6 * Math.min(1, motor.load / holdingTorque(motor));
  stroke(g, arc(at, from, to, 0.15), colors.near, 3);
  polygon(g, [at(to - 0.5, 0.15), at(to, 0.2), at(to, 0.1)], colors.near, colors.paper, 1);
  spot(g, at(to, 0.15), 1.5, colors.near, colors.near, 1);
}

/** Draws the field as an arrow. @type {(pen: Pen, angle: number, long: number) => void} */
function drawArrow({g, at}, angle, long) {
  const tip = at(angle, long),
    neck = at(angle, long - 0.07),
    [sx, sy] = at(angle + Math.PI / 2, 0.05),
    [cx, cy] = at(0, 0);
  stroke(g, [[cx, cy], neck], colors.paper, 8);
  stroke(g, [[cx, cy], neck], colors.accent, 4);
  /** @type {Pixel[]} */
  const feet = [
    [neck[0] + sx - cx, neck[1] + sy - cy],
    [neck[0] - sx + cx, neck[1] - sy + cy],
  ];
  polygon(g, [tip, ...feet], colors.accent, colors.paper, 1.2);
}

/**
 * Writes text on a coloured background that is light in both themes.
 * @param {Context} g
 * @param {string} text
 * @param {Pixel} place
 * @param {string} color
 * @param {boolean} strong
 */
function plainWords(g, text, [x, y], color, strong) {
  g.font = font(12, strong ? 700 : 400);
  g.textAlign = "center";
  g.fillStyle = color;
  g.fillText(text, x, y + 5);
}
