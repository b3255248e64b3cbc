// The picture of the elbow explorer: an arm from the side, the triangle of its chosen elbow with
// lengths and angles, the other elbow, and the circles on which both lie.

import {drawStood, stood} from "./arm_picture.js";
import {inWords} from "./blanks.js";
import {camera} from "./camera.js";
import {
  clear,
  colors,
  ink,
  jointColor,
  number,
  polygon,
  prepared,
  spot,
  stroke,
  write,
} from "./canvas.js";
import {sceneCanvas} from "./controls.js";
import {placeLabels} from "./labels.js";
import {drawFloor, sceneOf, surroundings} from "./scene.js";
import {degrees} from "./turns.js";

/** @import {Context, Pixel} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {ElbowExplorer, Seen} from "./elbow_explorer.js" */
/** @import {Label} from "./labels.js" */
/** @import {Pen} from "./scene.js" */
/** @import {Picture} from "./stage.js" */

const WIDE = 420; // px: the labels in a narrower picture are letters without numbers
const [HORIZON, BEND] = [44, 38]; // px: the greatest radii of the arcs of alpha and gamma

/**
 * The places of a triangle on the canvas: the top of the column, joint 2, the point, the corner of
 * u and w, the elbows; and the pixels per metre.
 * @typedef {Record<"top" | "joint2" | "point" | "corner", Pixel>
 *   & {elbows: Pixel[], scale: number}} Places
 */

/**
 * @param {ElbowExplorer} data
 * @returns {Picture<Seen>}
 */
export function elbowPicture(data) {
  const scene = sceneOf(data),
    space = surroundings(scene),
    canvas = sceneCanvas(scene, data.alt);
  /** @type {(w: number, h: number) => Camera} */
  const fromSide = (w, h) =>
    camera(scene.view, space.corners, [8, 8, Math.max(1, w - 16), Math.max(1, h - 34)]);
  let cam = fromSide(1, 1);
  return {
    canvas,
    camera: () => cam,
    hold() {},
    draw(now) {
      const ready = prepared(canvas);
      if (!ready) return false;
      const [g, w, h] = ready;
      cam = fromSide(w, h);
      canvas.setAttribute("aria-label", now.alt);
      const pen = {g, cam, scene, space},
        places = placesOf(cam, data, now);
      drawFloor(pen);
      ink.length = 0;
      drawBelow(pen, data, now, places);
      const {q, past} = now.elbows[now.elbow] ?? {q: data.arm.limits.map(() => NaN), past: []};
      drawStood(stood(pen, {name: "", chain: data.arm.chain, q, past}));
      drawAbove(g, data, now, places);
      const grid = +(scene.grid / scene.unit.size).toPrecision(6);
      write(g, `grid ${grid} ${scene.unit.name}`, 10, h - 8, colors.soft, 12);
      const labels = labelsOf(data, now, places, w >= WIDE);
      placeLabels(g, labels, [4, 4, w - 8, h - 28], now.handles(cam));
      return true;
    },
  };
}

/** @type {(cam: Camera, data: ElbowExplorer, now: Seen) => Places} */
function placesOf({to, scale}, {arm}, {r, z, elbows}) {
  const {shoulder_x: x, shoulder_z: height, upper} = arm.geometry.elbow,
    joint2 = to([x, 0, height]);
  return {
    scale,
    top: to([0, 0, height]),
    joint2,
    point: to([r, 0, z]),
    corner: to([r, 0, height]),
    elbows: elbows.map(({alpha}) => on(joint2, alpha, upper * scale)),
  };
}

/** A place on a circle. @type {(centre: Pixel, angle: number, radius: number) => Pixel} */
const on = ([x, y], angle, radius) => [x + radius * Math.cos(angle), y - radius * Math.sin(angle)];

/**
 * The radius of the arc of alpha, which ends before the elbow, where gamma is.
 * @param {ElbowExplorer} data
 * @param {Places} places
 */
const horizon = ({arm}, {scale}) => Math.min(HORIZON, 0.6 * arm.geometry.elbow.upper * scale);

/** A place between two others. @type {(a: Pixel, b: Pixel, share?: number) => Pixel} */
const along = (a, b, share = 0.5) => [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])];

/**
 * The direction from a line that leads away from a place beside it.
 * @param {Pixel} a  one end of the line
 * @param {Pixel} b
 * @param {Pixel} place
 * @returns {Pixel}
 */
function awayFrom(a, b, place) {
  const [[dx, dy], [px, py]] = [b, place].map(([x, y]) => [x - a[0], y - a[1]]),
    size = (dx * py > dy * px ? 1 : -1) / (Math.hypot(dx, dy) || 1);
  return [size * dy, -size * dx];
}

/**
 * Draws the column, the circles on which an elbow lies, u and w, and the other elbow.
 * @param {Pen} pen
 * @param {ElbowExplorer} data
 * @param {Seen} now
 * @param {Places} places
 */
function drawBelow({g, cam: {to, scale}}, {arm}, {elbow}, {top, joint2, point, corner, elbows}) {
  const {upper, fore} = arm.geometry.elbow;
  stroke(g, [to([0, 0, 0]), top, joint2], clear(colors.ghost, 0.35), 6);
  /** @type {(centre: Pixel, radius: number) => Pixel[]} */
  const ring = (centre, radius) =>
    Array.from({length: 121}, (_, i) => on(centre, (i * Math.PI) / 60, radius * scale));
  stroke(g, [...ring(joint2, upper), null, ...ring(point, fore)], colors.rim, 1.2, [1.5, 4]);
  stroke(g, [joint2, corner, point], colors.soft, 1.2, [5, 4]);
  if (!elbows.length) return;
  const other = elbows[1 - elbow];
  stroke(g, [joint2, other, point], clear(colors.ghost, 0.7), 3, [8, 7]);
  spot(g, other, 4.5, colors.paper, colors.ghost, 1.5);
}

/**
 * Draws d and the angles or, if the point is out of reach, the gap between the circles.
 * @param {Context} g
 * @param {ElbowExplorer} data
 * @param {Seen} now
 * @param {Places} places
 */
function drawAbove(g, data, now, places) {
  const {joint2, point, elbows} = places,
    bent = now.elbows[now.elbow];
  stroke(g, [joint2, point], colors.path, 2);
  if (bent) {
    const {alpha, gamma} = bent,
      elbow = elbows[now.elbow];
    arrow(g, joint2, horizon(data, places), 0, alpha, jointColor(1));
    arrow(g, elbow, BEND, alpha, alpha + gamma, jointColor(2));
  } else {
    spot(g, joint2, 5, jointColor(1), colors.edge, 1.2);
    stroke(g, missing(data, now, places), colors.alarm, 4);
  }
  spot(g, point, 3.5, colors.path);
}

/**
 * Draws the direction from which an angle is measured, and an arc with an arrow at its end.
 * @param {Context} g
 * @param {Pixel} centre
 * @param {number} radius
 * @param {number} from
 * @param {number} to
 * @param {string} color
 */
function arrow(g, centre, radius, from, to, color) {
  const turn = to - from,
    back = to - Math.sign(turn) * Math.min(9 / radius, Math.abs(turn));
  const arc = Array.from({length: 49}, (_, i) =>
    on(centre, from + ((back - from) * i) / 48, radius),
  );
  stroke(g, [centre, on(centre, from, 1.35 * radius)], colors.soft, 1, [3, 3]);
  stroke(g, arc, color, 2.2);
  const feet = [-4, 4].map(d => on(centre, back, radius + d));
  polygon(g, [on(centre, to, radius), ...feet], color);
}

/**
 * The ends of the gap between the circles, on the line through joint 2 and the point.
 * @param {ElbowExplorer} data
 * @param {Seen} now
 * @param {Places} places
 * @returns {Pixel[]}
 */
function missing({arm}, {u, w, gap}, {joint2, point, scale}) {
  const {upper, fore} = arm.geometry.elbow,
    [one, two] = gap?.kind === "stretched" ? [1, -1] : upper > fore ? [1, 1] : [-1, -1],
    angle = Math.atan2(w, u);
  return [on(joint2, angle, one * upper * scale), on(point, angle, two * fore * scale)];
}

/**
 * @param {ElbowExplorer} data
 * @param {Seen} now
 * @param {Places} places
 * @param {boolean} wide  whether there is room for the numbers, too
 * @returns {Label[]}
 */
function labelsOf(data, now, places, wide) {
  const {arm, unit, controls, elbows: names, words} = data,
    {joint2, point, corner, elbows} = places,
    bent = now.elbows[now.elbow],
    elbow = elbows[now.elbow];
  /** @type {(text: string, at: Pixel, color?: string, weight?: string) => Label} */
  const label = (text, at, color = colors.soft, weight = "") => ({text, at, color, weight});
  /** @type {(name: string, x: number) => string} */
  const length = (name, x) =>
    wide ? `${name} ${number(x / unit.size, controls[0].decimals)}` : name;
  /** @type {(name: string, x: number) => string} */
  const angle = (name, x) => (wide ? `${name} ${number(degrees(x), 1)}\u00B0` : name);
  /**
   * The name of a line, on the side away from `place`.
   * @type {(text: string, a: Pixel, b: Pixel, share: number, place: Pixel) => Label}
   */
  const beside = (text, a, b, share, place) => ({
    ...label(text, along(a, b, share)),
    away: awayFrom(a, b, place),
  });
  const lines = [
    {...beside(length("d", now.d), joint2, point, 0.5, elbow ?? corner), color: colors.ink},
    beside(length("u", now.u), joint2, corner, 0.7, point), // clear of "joint 2"
    beside(length("w", now.w), corner, point, 0.75, joint2),
    label(words.take, point, colors.ink, "600"),
    ...(wide ? [label("joint 2", joint2)] : []),
  ];
  if (!bent) {
    const far = inWords(now.gap?.metres ?? 0),
      [a, b] = missing(data, now, places);
    const gap = {...beside(far, a, b, 0.5, corner), color: colors.alarm, weight: "600"};
    return [gap, ...lines];
  }
  const {alpha, gamma} = bent,
    {upper, fore} = arm.geometry.elbow;
  return [
    // bold, as the links are
    {...beside(length("l2", upper), joint2, elbow, 0.4, point), weight: "600"},
    {...beside(length("l3", fore), elbow, point, 0.5, joint2), weight: "600"},
    label(angle("\u03B1", alpha), on(joint2, 0.3 * alpha, horizon(data, places)), colors.ink),
    label(angle("\u03B3", gamma), on(elbow, alpha + 0.4 * gamma, BEND), colors.ink),
    ...lines,
    ...names.map((text, k) =>
      k === now.elbow ? label(text, elbows[k], colors.ink, "600") : label(text, elbows[k]),
    ),
  ];
}
