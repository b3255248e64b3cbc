// Words on a canvas: each label takes the first free place around its point, so that it hides
// nothing that is drawn there.

import {WORD, colors, font, ink, stroke, wordInk, write} from "./canvas.js";

/** @import {Box, Context, Ink, Pixel} from "./canvas.js" */

/**
 * @typedef {object} Label
 * @property {string} text
 * @property {Pixel} at  its point
 * @property {Pixel[]} [along]  the points of its line; it is at one of them
 * @property {Pixel[]} [apart]  the points of lines that it could seem to name: it keeps away
 * @property {string} color
 * @property {string} [weight]
 * @property {Pixel} [away]  the preferred direction from its point; without it, the label prefers
 *   the upper right, and a distant label has a line to its point
 * @property {boolean} [near]  whether to leave it out if there is no free place close to its point
 * @property {boolean} [tip]  whether it names the end of a line: it is beyond this end, or left out
 */

/** @typedef {{x: number, y: number, r: number, heavy: number}} Dot  a part of the ink */

const GAPS = [5, 14, 26, 40, 58, 84], // px between a point and its label
  TURNS = 12, // the number of directions
  NEAR = 3 * TURNS, // the number of places without a line
  HIGH = 16, // px: the height of a label
  REACH = 40, // px: the directions of the base, and letters beside them, are this near their centre
  APART = 28, // px: twice the distance of a label from the lines of others
  CROSSED = 8, // the cost of a line that goes through words: less than to cover a link
  TIP = 2 * TURNS, // the number of places of a label with `tip` or `near`
  MOST = 40, // the cost above which a label with `near` is left out
  TIPS = 12; // the same for a label with `tip`

/**
 * Writes the labels of a picture, after everything else is drawn in it. The places depend only on
 * what is drawn, so that the same state always has the same picture.
 * @param {Context} g
 * @param {Label[]} labels
 * @param {Box} room
 * @param {Box[]} [handles]  the boxes of the handles, which no label covers
 */
export function placeLabels(g, labels, [left, top, width, height], handles = []) {
  ink.push(...handles.map(wordInk));
  /** @type {Dot[]} */
  const dots = [];
  let marked = 0; // the number of lines in `ink` whose dots are known
  for (const {text, at, along = [at], apart = [], color, weight, away, near, tip} of labels) {
    while (marked < ink.length) mark(dots, ink[marked++]);
    g.font = font(12, weight);
    const wide = g.measureText(text).width + 4,
      [ax, ay] = away ?? [0.5, -0.5],
      led = apart.length ? TIP : away ? Infinity : NEAR;
    let [least, bestX, bestY, place, fromX, fromY] = [Infinity, 0, 0, 0, 0, 0];
    for (const [x, y] of along) {
      const [px, py] = [between(x, left, width), between(y, top, height)],
        close = dots.filter(({x, y, r}) => Math.hypot(x - px, y - py) < wide + r + 110);
      for (const each of apart) {
        mark(close, [[each], APART, WORD]);
        mark(close, [[each], 4 * APART, 0.1]);
      }
      for (let k = 0; k < (tip || near ? TIP : GAPS.length * TURNS); k++) {
        const gap = GAPS[Math.floor(k / TURNS)],
          turn = (2 * Math.PI * k) / TURNS,
          [c, s] = [Math.cos(turn), -Math.sin(turn)],
          u = px + c * (gap + wide / 2) - wide / 2,
          v = py + s * (gap + HIGH / 2) - HIGH / 2;
        if (tip && 2 * (ax * c + ay * s) < Math.hypot(ax, ay)) continue; // by more than 60°
        let cost = gap / 6 + 1 - ax * c - ay * s;
        if (u !== between(u, left, width - wide) || v !== between(v, top, height - HIGH))
          cost += 5 * WORD;
        if (cost >= least) continue;
        // dots are objects, not arrays, since this loop takes most of the time
        for (const {x, y, r, heavy} of close) {
          if (x > u - r && x < u + wide + r && y > v - r && y < v + HIGH + r) cost += heavy;
          if (cost >= least) break;
        }
        if (k >= led && crossed(close, px, py, ...line(px, py, u, v, wide))) cost += CROSSED;
        if (cost < least) [least, bestX, bestY, place, fromX, fromY] = [cost, u, v, k, px, py];
      }
    }
    if (least > (tip ? TIPS : near ? MOST : Infinity)) continue;
    if (place >= led) lead(g, [fromX, fromY], line(fromX, fromY, bestX, bestY, wide), color);
    if (color === colors.alarm) {
      // else the red ring of a joint would show between two words
      g.fillStyle = colors.paper;
      g.fillRect(bestX, bestY, wide, HIGH - 1);
    }
    write(g, text, bestX + 2, bestY + 12, color, 12, "left", weight);
  }
}

/**
 * The place with the least ink within REACH; of several such places, the first.
 * @param {Pixel[]} places
 */
export function freest(places) {
  /** @type {Dot[]} */
  const dots = [];
  for (const each of ink) mark(dots, each);
  const costs = places.map(([px, py]) =>
    dots.reduce(
      (sum, {x, y, r, heavy}) => (Math.hypot(x - px, y - py) < r + REACH ? sum + heavy : sum),
      0,
    ),
  );
  return places[costs.indexOf(Math.min(...costs))];
}

/**
 * The line from a point to a label whose upper left corner is (u, v).
 * @type {(px: number, py: number, u: number, v: number, wide: number) => Pixel}
 */
const line = (px, py, u, v, wide) => [between(px, u, wide) - px, between(py, v, HIGH) - py];

/**
 * Draws a line from a point, but not up to the dot at the point itself.
 * @type {(g: Context, at: Pixel, way: Pixel, color: string) => void}
 */
function lead(g, [x, y], [dx, dy], color) {
  const gap = 6 / Math.hypot(dx, dy);
  stroke(
    g,
    [
      [x + dx, y + dy],
      [x + gap * dx, y + gap * dy],
    ],
    color,
    1,
  );
}

/**
 * Whether a line from a point goes through words, beyond what is at the point itself.
 * @type {(dots: Dot[], px: number, py: number, dx: number, dy: number) => boolean}
 */
const crossed = (dots, px, py, dx, dy) =>
  dots.some(({x, y, r, heavy}) => {
    const share = ((x - px) * dx + (y - py) * dy) / (dx * dx + dy * dy);
    const aside = Math.hypot(x - px - share * dx, y - py - share * dy),
      beyond = share > 0 && share < 1 && Math.hypot(x - px, y - py) > r;
    return heavy === WORD && beyond && aside < r;
  });

/** @type {(x: number, low: number, size: number) => number} */
const between = (x, low, size) => Math.max(low, Math.min(low + size, x));

/**
 * Adds the dots of a line.
 * @param {Dot[]} dots
 * @param {Ink} ink
 */
function mark(dots, [points, wide, heavy]) {
  const step = 7 + wide / 4;
  /** @type {?Pixel} */
  let from = null;
  for (const to of points) {
    if (to) {
      const [x, y] = from ?? to,
        dx = to[0] - x,
        dy = to[1] - y,
        count = Math.min(200, Math.ceil(Math.hypot(dx, dy) / step)) || 1;
      for (let i = 1; i <= count; i++)
        dots.push({x: x + (i / count) * dx, y: y + (i / count) * dy, r: wide / 2, heavy});
    }
    from = to;
  }
}
