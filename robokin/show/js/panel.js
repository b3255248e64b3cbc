// One panel of curves over time, with their limits and breaks.

import {
  clear,
  colors,
  font,
  jointColor,
  level,
  number,
  polygon,
  shade,
  spot,
  stroke,
  upright,
  write,
} from "./canvas.js";
import {lineColor, panelWords} from "./panel_words.js";

/** @import {Box, Context, Pixel} from "./canvas.js" */
/** @import {Scale} from "./page.js" */

/**
 * @typedef {object} Line  one curve
 * @property {Float64Array} values  over the times
 * @property {?{values: Float64Array, gaps: Set<number>}} opening  the curve of the opening motion,
 *   if this is another motion
 * @property {number} joint  from 0; -1 for a quantity that belongs to no joint
 * @property {number} arm  from 0
 * @property {number} axis  the index of its axis in the panel
 * @property {boolean} faint  whether the line is faint, because it is not watched
 * @property {Set<number>} gaps  samples after which the line breaks
 * @property {?[low: number, high: number]} limits
 * @property {boolean} [steps]  whether it is constant until the next sample, as a count is
 * @property {number} now  its current value
 */
/**
 * @typedef {object} Panel
 * @property {string} label
 * @property {{unit: string, scale: Scale}[]} axes
 * @property {Line[]} lines
 * @property {[line: number, side: number][]} near  the limits to show, side 0 low or 1 high
 * @property {Mark[]} marks
 * @property {string} [where]  the size and theme for which its text was placed
 * @property {Note[]} [words]
 */
/** @typedef {{time: number, text: string}} Mark  a dashed vertical line with text next to it */
/** @typedef {[text: string, place: Box, color: string, size: number, weight?: string]} Note */
/** @typedef {ArrayLike<number>} Times  increasing times in s */
/** @typedef {(value: number) => number} Place  maps a time or a value to a place on the canvas */
/** @typedef {[left: number, right: number, top: number, bottom: number]} Sides */
/**
 * The data for drawing a panel: the canvas, the dashes of the joints' lines, the times and their
 * places, the sides of the panel, whether it shows several arms, and whether joints have dashes in
 * this picture.
 * @typedef {{
 *   g: Context, patterns: number[][], times: Times, x: Place, sides: Sides, several: boolean,
 *   joints: boolean,
 * }} Ground
 */

export const FAINT = 0.4; // opacity of a curve that is not watched
const SMALL = 60; // px: a lower panel shows only the ends of its scale, and no text
const INSET = 4; // px between the frame and the outermost ticks, so that no curve lies on the frame
const PAST = 0.002; // an excess over a limit up to this value is due to rounding

/** The line width for an arm. @type {(arm: number) => number} */
export const strength = arm => [2.6, 1.4][arm] ?? 0.8;

/** @type {(patterns: number[][], j: number, width: number) => number[]} */
export const dashes = (patterns, j, width) => patterns[j % patterns.length].map(x => x * width);

/** Whether a value exceeds a limit of its line. @type {(line: Line, v: number) => boolean} */
export const isPast = ({limits}, value) =>
  !!limits && (value < limits[0] - PAST || value > limits[1] + PAST);

/**
 * @param {Ground} ground
 * @param {Panel} panel
 * @param {Scale} ticks  the scale of the time axis
 * @param {number} now
 */
export function drawPanel(ground, panel, ticks, now) {
  const {g, times, x, sides} = ground,
    [left, right, top, bottom] = sides,
    {lines} = panel;
  const scales = panel.axes.map(({scale: [low, step, count]}) => {
    const per = (bottom - top - 2 * INSET) / (step * (count - 1));
    /** @type {Place} */
    const y = v => bottom - INSET - per * (v - low);
    return y;
  });
  const ys = lines.map(({axis}) => scales[axis]);
  write(g, panel.label, left + 1, top - 6, colors.ink, 12, "left", "600");
  g.save();
  g.beginPath();
  g.rect(left, top - 1, right - left, bottom - top + 2);
  g.clip();
  drawGrid(ground, panel.axes[0].scale, scales[0], ticks);
  for (const [k, side] of panel.near)
    band(g, ys[k](lines[k].limits?.[side] ?? 0), side ? 1 : -1, left, right, lineColor(lines[k]));
  for (const {time} of panel.marks) upright(g, x(time), top, bottom, colors.alarm, 1.2, [3, 3]);
  drawLines(ground, lines, ys);
  g.restore();
  g.lineWidth = 1;
  g.strokeStyle = colors.rim;
  g.strokeRect(left, top, right - left, bottom - top);
  drawScales(ground, panel, scales);
  upright(g, x(now), top, bottom, colors.ink, 1.4);
  if (bottom - top >= SMALL)
    for (const note of panelWords(g, panel, ys, times, x, sides)) {
      const [text, [px, py, w, h], color, size, weight] = note;
      if (Math.abs(x(now) - px - w / 2) < w / 2 + 3) {
        // the line of the current time does not go through the text
        g.fillStyle = colors.paper;
        g.fillRect(px - 2, py, w + 4, h);
      }
      write(g, text, px, py + h - 2, color, size, "left", weight);
    }
  lines.forEach((line, k) => {
    const at = ys[k](line.now);
    if (line.faint || !(at > top - 3 && at < bottom + 3)) return;
    const past = isPast(line, line.now);
    spot(g, [x(now), at], past ? 5.5 : 4, past ? colors.alarm : lineColor(line));
  });
  for (const {time, text} of panel.marks) if (text) drawMark(ground, x(time));
}

/**
 * Draws the curves, with the faint ones below the others.
 * @param {Ground} ground
 * @param {Line[]} lines
 * @param {Place[]} ys
 */
function drawLines(ground, lines, ys) {
  lines.forEach((line, k) => {
    if (!line.opening || line.faint) return;
    const points = placed(ground, {...line, ...line.opening}, ys[k]);
    stroke(ground.g, points, clear(lineColor(line), FAINT), 1.2);
  });
  for (const faint of [true, false])
    lines.forEach((line, k) => {
      if (line.faint === faint) curve(ground, line, ys[k]);
    });
}

/**
 * Draws lines at the ticks of the first scale and of the time axis.
 * @param {Ground} ground
 * @param {Scale} scale
 * @param {Place} y
 * @param {Scale} ticks
 */
function drawGrid({g, x, sides: [left, right, top, bottom]}, [low, step, count], y, ticks) {
  for (let i = 0; i < count; i++) {
    const value = low + i * step,
      color = Math.abs(value) < step / 9 ? colors.line : colors.grid;
    level(g, y(value), left, right, color, 1);
  }
  for (let i = 0; i < ticks[2]; i++)
    upright(g, x(ticks[0] + i * ticks[1]), top, bottom, colors.grid, 1);
}

/**
 * Writes the numbers of the scales: the first scale on the left, a second one on the right.
 * @param {Ground} ground
 * @param {Panel} panel
 * @param {Place[]} scales
 */
function drawScales({g, sides: [left, right, top, bottom]}, {label, axes, lines}, scales) {
  axes.forEach(({scale: [low, step, count, decimals], unit}, k) => {
    const joints = [...new Set(lines.filter(line => line.axis === k).map(({joint}) => joint))];
    const color = k && joints.length === 1 ? shade(jointColor(joints[0])) : colors.soft;
    const apart = (bottom - top - 2 * INSET) / (count - 1),
      every = bottom - top < SMALL ? count - 1 : Math.ceil(14 / apart);
    for (let i = 0; i < count; i += every) {
      const value = low + i * step;
      write(
        g,
        number(value, decimals),
        k ? right + 6 : left - 6,
        scales[k](value) + 4,
        color,
        11,
        k ? "left" : "right",
      );
    }
    if (!k) return;
    g.font = font(12, "600");
    const text = `${joints.map(j => `q${j + 1}`).join(" and ")}, ${unit}`,
      room = right - left - 12 - g.measureText(label).width; // beside the name of the panel
    write(
      g,
      g.measureText(text).width > room ? unit : text,
      right - 1,
      top - 6,
      color,
      12,
      "right",
      "600",
    );
  });
}

/** Draws a triangle at each end of a mark's line. @type {(ground: Ground, x: number) => void} */
function drawMark({g, sides: [, , top, bottom]}, x) {
  for (const [y, tip] of [
    [top, top + 7],
    [bottom, bottom - 7],
  ])
    polygon(
      g,
      [
        [x - 5, y],
        [x + 5, y],
        [x, tip],
      ],
      colors.alarm,
    );
}

/**
 * Draws a strip beyond a limit, above (side 1) or below it.
 * @param {Context} g
 * @param {number} at
 * @param {number} side  1 or -1
 * @param {number} left
 * @param {number} right
 * @param {string} color
 */
function band(g, at, side, left, right, color) {
  const fade = g.createLinearGradient(0, at, 0, at - 12 * side);
  fade.addColorStop(0, clear(color, 0.35));
  fade.addColorStop(1, clear(color, 0.05));
  g.fillStyle = fade;
  g.fillRect(left, at, right - left, -12 * side);
  level(g, at, left, right, color, 1);
}

/**
 * The places of values, null where the line breaks.
 * @param {Ground} ground
 * @param {Pick<Line, "values" | "gaps" | "steps">} line
 * @param {Place} y
 */
function placed({times, x}, {values, gaps, steps}, y) {
  /** @type {(?Pixel)[]} */
  const points = [];
  values.forEach((value, i) => {
    if (steps && i) points.push([x(times[i]), y(values[i - 1])]);
    points.push(Number.isNaN(value) ? null : [x(times[i]), y(value)]);
    if (gaps.has(i)) points.push(null);
  });
  return points;
}

/**
 * @param {Ground} ground
 * @param {Line} line
 * @param {Place} y
 */
function curve(ground, line, y) {
  const {g, patterns, several, joints} = ground,
    points = placed(ground, line, y),
    width = several ? strength(line.arm) : 2;
  if (!line.faint && line.limits) {
    const past = line.values.map(value => (isPast(line, value) ? value : NaN));
    if (past.some(Number.isFinite))
      stroke(g, placed(ground, {values: past, gaps: line.gaps}, y), clear(colors.alarm, 0.4), 8);
  }
  g.lineCap = "butt";
  const color = line.faint ? clear(lineColor(line), FAINT) : lineColor(line);
  // a quantity has no joint: its dashes tell the arms apart, unless dashes stand for joints
  const kind = line.joint >= 0 ? line.joint : joints ? 0 : line.arm;
  stroke(g, points, color, width, dashes(patterns, kind, width));
  g.lineCap = "round";
}
