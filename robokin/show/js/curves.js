// The curves: columns of panels with a common time axis.

import {colors, font, jointColor, number, prepared, stroke, tiled, write} from "./canvas.js";
import {dashes, drawPanel} from "./panel.js";

/** @import {Box, Context} from "./canvas.js" */
/** @import {Scale} from "./page.js" */
/** @import {Panel, Place, Times} from "./panel.js" */

/** @typedef {{title: string, panels: Panel[]}} Column  a column of panels with one time axis */
/** @typedef {ReturnType<typeof curvesView>} CurvesView */
/** @typedef {{g: Context, patterns: number[][], times: Times, ticks: Scale, now: number}} Shown */
/** @typedef {[left: number, width: number, t0: number, t1: number, x: number, y: number]} Span */

/**
 * Draws columns of panels.
 *
 * draw(columns, times, ticks, now)  draws one picture
 * timeAt(x, y, held)                the time at a place on the canvas, in the column there or, if
 *                                   given, in the column `held`; and the number of the column
 *
 * @param {HTMLCanvasElement} canvas
 * @param {number[][]} patterns  the dashes of the joints' lines
 */
export function curvesView(canvas, patterns) {
  /** @type {Span[]} */
  let spans = [];

  /**
   * @param {Column[]} columns
   * @param {Times} times
   * @param {Scale} ticks
   * @param {number} now
   */
  function draw(columns, times, ticks, now) {
    const ready = prepared(canvas);
    if (!ready) return;
    const [g, w, h] = ready,
      [across, rows] = tiled(columns.length, w),
      [width, height] = [w / across, h / rows];
    spans = columns.map((column, c) =>
      drawColumn(
        {g, patterns, times, ticks, now},
        column,
        [(c % across) * width, Math.floor(c / across) * height, width, height],
        columns.length > 1,
      ),
    );
  }

  /**
   * @param {number} px
   * @param {number} py
   * @param {number} [held]
   * @returns {[time: number, column: number]}
   */
  function timeAt(
    px,
    py,
    held = spans.findLastIndex(([, , , , left, above]) => px >= left && py >= above),
  ) {
    const [left, width, t0, t1] = spans[Math.max(0, held)];
    return [t0 + (t1 - t0) * Math.min(1, Math.max(0, (px - left) / width)), Math.max(0, held)];
  }

  return {draw, timeAt};
}

/**
 * Draws one column in its box.
 * @param {Shown} shown
 * @param {Column} column
 * @param {Box} box
 * @param {boolean} titled
 * @returns {Span}
 */
function drawColumn({g, patterns, times, ticks, now}, column, box, titled) {
  const [left, above, width, height] = box,
    {panels, title} = column,
    t0 = times[0],
    t1 = times[times.length - 1];
  const right = panels.some(p => p.axes.length > 1) ? 46 : 16,
    room = Math.max(48, 14 + widest(g, column)),
    inner = left + room,
    wide = width - room - right;
  const below = legend(g, patterns, column, inner, wide, above + (titled ? 36 : 14));
  if (titled) write(g, title, inner, above + 14, colors.ink, 13, "left", "600");
  const bottom = above + height - 24,
    tall = (bottom - below) / panels.length;
  /** @type {Place} */
  const x = t => inner + (wide * (t - t0)) / (t1 - t0);
  panels.forEach((panel, k) => {
    const top = below + k * tall + 26,
      end = top + (below + (k + 1) * tall - top - 4);
    drawPanel({g, patterns, times, x, sides: [inner, inner + wide, top, end]}, panel, ticks, now);
  });
  tellTimes(g, ticks, [t0, t1], x, bottom + 16);
  return [inner, wide, t0, t1, left, above];
}

/**
 * Writes the times below a column; the last one has the unit.
 * @param {Context} g
 * @param {Scale} ticks
 * @param {[first: number, last: number]} span
 * @param {Place} x
 * @param {number} y
 */
function tellTimes(g, [first, step, count, decimals], [t0, t1], x, y) {
  for (let i = 0; i < count; i++) {
    const t = first + i * step;
    if (t < t0 - 1e-9 || t > t1 + 1e-9) continue;
    const unit = t + step > t1 + 1e-9 ? " s" : "";
    write(g, number(t, decimals) + unit, x(t) + (unit ? 4 : 0), y, colors.soft, 11, "center");
  }
}

/**
 * The width of the numbers beside the panels.
 * @param {Context} g
 * @param {Column} column
 */
function widest(g, {panels}) {
  g.font = font(11);
  return Math.max(
    ...panels.flatMap(
      ({
        axes: [
          {
            scale: [low, step, count, decimals],
          },
        ],
      }) =>
        [low, low + (count - 1) * step].map(value => g.measureText(number(value, decimals)).width),
    ),
  );
}

/**
 * Writes the legend above the panels, evenly in as many rows as necessary.
 * @param {Context} g
 * @param {number[][]} patterns
 * @param {Column} column
 * @param {number} left
 * @param {number} width
 * @param {number} y
 * @returns {number}  where the panels may begin
 */
function legend(g, patterns, column, left, width, y) {
  const joints = column.panels[0].curves.length,
    rows = Math.ceil((joints * 38) / width),
    inRow = Math.ceil(joints / rows);
  const each = Math.min(56, width / inRow),
    long = each - 30;
  for (let j = 0; j < joints; j++) {
    const x = left + (j % inRow) * each,
      row = y + 16 * Math.floor(j / inRow);
    stroke(
      g,
      [
        [x, row - 4],
        [x + long, row - 4],
      ],
      jointColor(j),
      2.2,
      dashes(patterns, j, 2.2),
    );
    write(g, `q${j + 1}`, x + long + 4, row, colors.ink, 12);
  }
  return y + 16 * (rows - 1) + 2;
}
