// The curves: panels with a common time axis, one of them large.

import {clear, colors, font, jointColor, level, number, prepared, write} from "./canvas.js";
import {dashes, drawPanel, FAINT, strength} from "./panel.js";

/** @import {Context} from "./canvas.js" */
/** @import {Scale} from "./page.js" */
/** @import {Panel, Place, Times} from "./panel.js" */

/**
 * Panels with a common time axis. `large` is the index of the large panel. `names` contains the
 * names of the arms if there are several, and is empty otherwise.
 * @typedef {{panels: Panel[], large: number, names: string[]}} Curves
 */
/** @typedef {ReturnType<typeof curvesView>} CurvesView */
/** @typedef {{text: string, color: string, width: number, dash: number[]}} Entry  in a legend */

const HEAD = 22, // px: the height of the name above a plot
  LEAST = 34, // px: the height of a small plot
  LARGE = 182; // px: the height of the large plot

/**
 * Draws panels.
 *
 * draw(curves, times, ticks, now)  draws one picture
 * timeAt(x)                        returns the time at a place on the canvas
 *
 * @param {HTMLCanvasElement} canvas
 * @param {number[][]} patterns  the dashes of the joints' lines
 * @param {string} [unit]  the unit of the horizontal axis, if it does not show time
 */
export function curvesView(canvas, patterns, unit = "s") {
  let span = [0, 1, 0, 1]; // left, width, first and last time

  /**
   * @param {Curves} curves
   * @param {Times} times
   * @param {Scale} ticks
   * @param {number} now
   */
  function draw({panels, large, names}, times, ticks, now) {
    const ready = prepared(canvas);
    if (!ready) return;
    const [g, w, h] = ready,
      t0 = times[0],
      t1 = times[times.length - 1];
    const left = Math.max(48, 14 + widest(g, panels, 0)),
      right = w - (panels.some(p => p.axes.length > 1) ? 14 + widest(g, panels, 1) : 16);
    span = [left, right - left, t0, t1];
    /** @type {Place} */
    const x = t => left + ((right - left) * (t - t0)) / (t1 - t0);
    // a legend in one row is lower than the name of a plot
    const end = h - 24,
      shown = heights(panels.length, large, end - HEAD).map(([k]) => panels[k]),
      joints = shown.some(({lines}) => lines.some(({joint}) => joint >= 0)),
      begin = legend(g, entries(patterns, shown, names), left, right);
    let top = begin;
    for (const [k, height] of heights(panels.length, large, end - begin)) {
      /** @type {[number, number, number, number]} */
      const sides = [left, right, top + HEAD, top + HEAD + height];
      const ground = {g, patterns, times, x, sides, several: names.length > 1, joints};
      drawPanel(ground, panels[k], ticks, now);
      top += HEAD + height;
    }
    tellTimes(g, ticks, [t0, t1], x, end + 16, unit);
  }

  return {
    draw,
    /** @param {number} px */
    timeAt: px => {
      const [left, width, t0, t1] = span;
      return t0 + (t1 - t0) * Math.min(1, Math.max(0, (px - left) / width));
    },
  };
}

/**
 * Returns [index, height of the plot] of the panels for which there is room: always the large
 * panel, which gets at least half of the room, and as many of the others as fit, beginning with the
 * first. If there is no large panel (-1), all panels have the same height.
 * @param {number} count
 * @param {number} large
 * @param {number} room
 * @returns {[number, number][]}
 */
export function heights(count, large, room) {
  const all = [...Array(count).keys()];
  if (large < 0) return all.map(k => [k, room / count - HEAD]);
  const fit = Math.max(0, Math.floor((room - HEAD - LARGE) / (HEAD + LEAST))),
    small = all.filter(k => k !== large).slice(0, fit);
  const plots = room - HEAD * (small.length + 1),
    most = small.length ? Math.max(LARGE, plots / 2) : plots;
  return [large, ...small]
    .sort((p, q) => p - q)
    .map(k => [k, k === large ? most : (plots - most) / small.length]);
}

/**
 * Writes the times below the panels, with the unit after the last time.
 * @param {Context} g
 * @param {Scale} ticks
 * @param {[first: number, last: number]} span
 * @param {Place} x
 * @param {number} y
 * @param {string} name  of the unit
 */
function tellTimes(g, [first, step, count, decimals], [t0, t1], x, y, name) {
  for (let i = 0; i < count; i++) {
    const t = first + i * step;
    if (t < t0 - 1e-9 || t > t1 + 1e-9) continue;
    const unit = t + step > t1 + 1e-9 ? ` ${name}` : "";
    const text = number(t, decimals) + unit;
    g.font = font(11);
    // keeps the text inside the canvas
    const most = g.canvas.clientWidth - 2 - g.measureText(text).width / 2;
    write(g, text, Math.min(most, x(t) + (unit ? 4 : 0)), y, colors.soft, 11, "center");
  }
}

/**
 * The width of the numbers on the left (axis 0) or on the right (axis 1) of the panels.
 * @param {Context} g
 * @param {Panel[]} panels
 * @param {number} axis
 */
function widest(g, panels, axis) {
  g.font = font(11);
  const widths = panels.flatMap(({axes}) => {
    const [low, step, count, decimals] = (axes[axis] ?? axes[0]).scale;
    return [low, low + (count - 1) * step].map(x => g.measureText(number(x, decimals)).width);
  });
  return Math.max(...widths);
}

/**
 * The legend of the joints in these panels, of the arms if there are several, and of the curves of
 * the opening motion. The dashes tell the joints apart; where there are none, they tell the arms
 * apart.
 * @param {number[][]} patterns
 * @param {Panel[]} panels
 * @param {string[]} names
 * @returns {Entry[]}
 */
function entries(patterns, panels, names) {
  const all = panels.flatMap(panel => panel.lines),
    lines = all.filter(({joint}) => joint >= 0),
    joints = [...new Set(lines.map(({joint}) => joint))];
  return [
    ...joints.map(j => ({
      text: `q${j + 1}`,
      color: clear(jointColor(j), lines.some(line => line.joint === j && !line.faint) ? 1 : FAINT),
      width: 2.2,
      dash: dashes(patterns, j, 2.2),
    })),
    ...names.map((text, arm) => ({
      text,
      color: colors.ink,
      width: strength(arm),
      dash: dashes(patterns, joints.length ? 0 : arm, strength(arm)),
    })),
    ...(all.some(({opening, faint}) => opening && !faint)
      ? [{text: "faint: the opening motion", color: clear(colors.ink, FAINT), width: 1.2, dash: []}]
      : []),
  ];
}

/**
 * Writes the legend above the panels, in as many rows as necessary.
 * @param {Context} g
 * @param {Entry[]} legend
 * @param {number} left
 * @param {number} right
 * @returns {number}  where the panels may begin
 */
function legend(g, legend, left, right) {
  let x = left,
    y = 13;
  g.lineCap = "butt"; // as the curves, or the gaps of dashes would be shorter
  for (const {text, color, width, dash} of legend) {
    g.font = font(12);
    const wide = 30 + g.measureText(text).width;
    if (x > left && x + wide > right + 8) [x, y] = [left, y + 16];
    level(g, y - 4, x, x + 24, color, width, dash);
    write(g, text, x + 28, y, colors.ink, 12);
    x += wide + 8;
  }
  g.lineCap = "round";
  return legend.length ? y + 2 : 0;
}
