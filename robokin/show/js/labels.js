// Words on a canvas: each label takes the first free place around its point, so that it hides
// nothing that is drawn there.

import {WORD, font, ink, stroke, wordInk, write} from "./canvas.js";

/** @import {Box, Context, Ink, Pixel} from "./canvas.js" */

/**
 * @typedef {object} Label
 * @property {string} text
 * @property {Pixel} at  its point
 * @property {string} color
 * @property {string} [weight]
 * @property {Pixel} [away]  the preferred direction from its point; otherwise to the upper right
 * @property {boolean} [near]  whether to leave it out if there is no free place close to its point
 */

/** @typedef {Map<string, {at: Pixel, gap: number, turn: number}>} Memory */

const CELL = 4, // px: the size of the cells in which the ink is counted
  GAPS = [5, 14, 26, 40, 58], // px between a point and its label; the last two need a line
  NEAR = 26,
  TURNS = 12,
  HIGH = 16, // px: the height of a label
  STAYS = 1.5, // the cost that a label avoids by staying where it was in the last picture
  JUMP = 40; // px: a point that moves farther takes its label to a new place
/** @type {WeakMap<Context, Memory>} */
const memories = new WeakMap();

/**
 * Writes the labels of a picture, after everything else is drawn in it.
 * @param {Context} g
 * @param {Label[]} labels
 * @param {Box} room
 * @param {Box[]} [handles]  the boxes of the handles, which no label covers
 */
export function placeLabels(g, labels, room, handles = []) {
  const cells = cellsOf(room),
    memory = memories.get(g) ?? new Map();
  memories.set(g, memory);
  for (const each of [...ink, ...handles.map(wordInk)]) cells.mark(each);
  labels.forEach(({text, at, color, weight, away, near}, k) => {
    g.font = font(12, weight);
    const wide = g.measureText(text).width + 4,
      key = [...room.slice(0, 2), k, text.replace(/[\d.]/g, "")].join();
    const {cost, gap, turn, box} = bestPlace(cells, at, wide, away, near, memory.get(key));
    if (near && cost >= WORD) return;
    memory.set(key, {at, gap, turn});
    const [x, y] = box,
      end = /** @type {Pixel} */ ([
        Math.min(Math.max(at[0], x), x + wide),
        Math.min(Math.max(at[1], y), y + HIGH),
      ]);
    if (gap > NEAR) {
      stroke(g, [at, end], color, 1);
      cells.mark([[at, end], 1, 1]);
    }
    cells.mark(wordInk(box));
    write(g, text, x + 2, y + 12, color, 12, "left", weight);
  });
}

/**
 * @param {ReturnType<typeof cellsOf>} cells
 * @param {Pixel} at
 * @param {number} wide
 * @param {Pixel} [away]
 * @param {boolean} [near]
 * @param {{at: Pixel, gap: number, turn: number}} [last]
 */
function bestPlace(cells, at, wide, [ax, ay] = [0.5, -0.5], near, last) {
  const kept = last && Math.hypot(last.at[0] - at[0], last.at[1] - at[1]) < JUMP ? last : null;
  let best = {cost: Infinity, gap: 0, turn: 0, box: /** @type {Box} */ ([NaN, NaN, wide, HIGH])};
  for (const gap of GAPS)
    for (let turn = 0; turn < TURNS; turn++) {
      if (near && gap > NEAR) break;
      const c = Math.cos((2 * Math.PI * turn) / TURNS),
        s = -Math.sin((2 * Math.PI * turn) / TURNS);
      const own = gap / 6 + 1 - ax * c - ay * s,
        stays = kept?.gap === gap && kept.turn === turn ? STAYS : 0;
      if (own - stays >= best.cost) continue;
      /** @type {Box} */
      const box = [
        at[0] + c * (gap + wide / 2) - wide / 2,
        at[1] + s * (gap + HIGH / 2) - HIGH / 2,
        wide,
        HIGH,
      ];
      const cost = own - stays + cells.below(box);
      if (cost < best.cost) best = {cost, gap, turn, box};
    }
  return best;
}

/**
 * The ink in a room, counted in cells.
 *
 * mark(ink)   adds a line, a disc or a word
 * below(box)  the cost of a label there: the ink that it covers, and what is outside the room
 *
 * @param {Box} room
 */
function cellsOf([left, top, width, height]) {
  const columns = Math.max(1, Math.ceil(width / CELL)),
    rows = Math.max(1, Math.ceil(height / CELL)),
    cells = new Uint8Array(columns * rows);
  /** @type {(x: number) => number} */
  const column = x => Math.max(0, Math.min(columns - 1, Math.floor((x - left) / CELL)));
  /** @type {(y: number) => number} */
  const row = y => Math.max(0, Math.min(rows - 1, Math.floor((y - top) / CELL)));
  /** @type {(x: number, y: number, r: number, weight: number) => void} */
  function dot(x, y, r, weight) {
    if (!(x + r > left && x - r < left + width && y + r > top && y - r < top + height)) return;
    for (let i = row(y - r); i <= row(y + r); i++)
      for (let j = column(x - r), last = column(x + r); j <= last; j++)
        cells[i * columns + j] = Math.max(cells[i * columns + j], weight);
  }
  return {
    /** @param {Ink} ink */
    mark([points, wide, weight]) {
      /** @type {?Pixel} */
      let from = null;
      for (const to of points) {
        if (to) {
          const [x, y] = from ?? to,
            [dx, dy] = [to[0] - x, to[1] - y],
            count = Math.min(500, Math.ceil(Math.hypot(dx, dy) / CELL)) || 1;
          for (let i = from ? 1 : 0; i <= count; i++)
            dot(x + (i / count) * dx, y + (i / count) * dy, wide / 2, weight);
        }
        from = to;
      }
    },
    /** @param {Box} box */
    below([x, y, w, h]) {
      let sum =
        3 *
        (Math.max(0, left - x) +
          Math.max(0, x + w - left - width) +
          Math.max(0, top - y) +
          Math.max(0, y + h - top - height));
      for (let i = row(y); i <= row(y + h - 1); i++)
        for (let j = column(x), last = column(x + w - 1); j <= last; j++)
          sum += cells[i * columns + j];
      return sum;
    },
  };
}
