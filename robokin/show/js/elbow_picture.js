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
 * The places of a triangle on the canvas: the foot and the top of the column, joint 2, the point,
 * the corner of u and w, the elbows; and the pixels per metre.
 * @typedef {Record<"foot" | "top" | "joint2" | "point" | "corner", Pixel>
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
    foot: to([0, 0, 0]),
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

/**
 * A line with a name: its ends, and a place on the side where the name is not.
 * @typedef {[text: string, a: Pixel, b: Pixel, place: Pixel, color: string, weight: string]} Named
 */

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
 * Draws the column, the circles on which an elbow lies, and the other elbow.
 * @param {Pen} pen
 * @param {ElbowExplorer} data
 * @param {Seen} now
 * @param {Places} places
 */
function drawBelow({g, cam: {to, scale}}, {arm}, {elbow}, {foot, top, joint2, point, elbows}) {
  const {upper, fore} = arm.geometry.elbow;
  stroke(g, [foot, top, joint2], clear(colors.ghost, 0.35), 6);
  /** @type {(centre: Pixel, radius: number) => Pixel[]} */
  const ring = (centre, radius) =>
    Array.from({length: 121}, (_, i) => on(centre, (i * Math.PI) / 60, radius * scale));
  stroke(g, [...ring(joint2, upper), null, ...ring(point, fore)], colors.rim, 1.2, [1.5, 4]);
  if (!elbows.length) return;
  const other = elbows[1 - elbow];
  stroke(g, [joint2, other, point], clear(colors.ghost, 0.7), 3, [8, 7]);
  spot(g, other, 4.5, colors.paper, colors.ghost, 1.5);
}

/**
 * Draws u, w, d and the angles or, if the point is out of reach, the gap between the circles.
 * @param {Context} g
 * @param {ElbowExplorer} data
 * @param {Seen} now
 * @param {Places} places
 */
function drawAbove(g, data, now, places) {
  const {joint2, point, corner, elbows} = places,
    bent = now.elbows[now.elbow];
  // above the links, since a line leads to it from its name
  stroke(g, [joint2, corner, point], colors.paper, 3);
  stroke(g, [joint2, corner, point], colors.soft, 1.2, [5, 4]);
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
  const {unit, controls, elbows: names, words} = data,
    {joint2, point, corner, elbows} = places,
    bent = now.elbows[now.elbow],
    elbow = elbows[now.elbow],
    column = between(places.foot, places.top);
  /** @type {(text: string, at: Pixel, color?: string, weight?: string) => Label} */
  const label = (text, at, color = colors.soft, weight = "") => ({text, at, color, weight});
  const joint = {...label("joint 2", joint2), apart: column};
  const own = [label(words.take, point, colors.ink, "600"), ...(wide ? [joint] : [])];
  /** @type {(name: string, x: number) => string} */
  const length = (name, x) =>
    wide ? `${name} ${number(x / unit.size, controls[0].decimals)} ${unit.name}` : name;
  /** @type {(name: string, x: number) => string} */
  const angle = (name, x) => (wide ? `${name} ${number(degrees(x), 1)}\u00B0` : name);
  /** @type {Named[]} */
  const lines = [
    [length("d", now.d), joint2, point, elbow ?? corner, colors.ink, ""],
    [length("u", now.u), joint2, corner, point, colors.soft, ""],
    [length("w", now.w), corner, point, joint2, colors.soft, ""],
  ];
  if (!bent) {
    const [a, b] = missing(data, now, places),
      far = label(inWords(now.gap?.metres ?? 0), along(a, b), colors.alarm, "600");
    return [{...far, away: awayFrom(a, b, corner)}, ...beside(lines, column), ...own];
  }
  const {alpha, gamma} = bent,
    {upper, fore} = data.arm.geometry.elbow,
    other = elbows[1 - now.elbow];
  lines.unshift(
    // bold, as the links are
    [length("l2", upper), joint2, elbow, point, colors.soft, "600"],
    [length("l3", fore), elbow, point, joint2, colors.soft, "600"],
  );
  return [
    ...own,
    ...beside(lines, [...column, ...between(joint2, other), ...between(other, point)]),
    label(angle("\u03B1", alpha), on(joint2, 0.3 * alpha, horizon(data, places)), colors.ink),
    label(angle("\u03B3", gamma), on(elbow, alpha + 0.4 * gamma, BEND), colors.ink),
    ...names.map((text, k) =>
      k === now.elbow ? label(text, elbows[k], colors.ink, "600") : label(text, elbows[k]),
    ),
  ];
}

/** Points on a line, its ends included. @type {(a: Pixel, b: Pixel) => Pixel[]} */
const between = (a, b) => Array.from({length: 21}, (_, i) => along(a, b, i / 20));

/**
 * The names of lines, each on the side away from its `place`, and apart from the other lines.
 * @param {Named[]} lines
 * @param {Pixel[]} more  points of lines without a name
 * @returns {Label[]}
 */
const beside = (lines, more) =>
  lines.map(([text, a, b, place, color, weight], k) => {
    // l2 and l3 may cover u and w, which come last
    const others = weight ? lines.slice(0, 3) : lines,
      apart = others.flatMap(([, a, b], i) => (i === k ? [] : between(a, b)));
    return {
      text,
      at: along(a, b),
      along: [0.5, 0.6, 0.4, 0.7, 0.3, 0.8, 0.2].map(share => along(a, b, share)),
      apart: [...apart, ...more],
      away: awayFrom(a, b, place),
      color,
      weight,
    };
  });
