// Words on a canvas: each label takes the first free place around its point, so that it hides
// nothing that is drawn there.

import {WORD, colors, font, haloed, hit, ink, wordInk, write} from "./canvas.js";

/** @import {Box, Context, Ink, Pixel, Ring} from "./canvas.js" */

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
 * @property {Pixel} [tip]  the other end of the line at whose end it stands: it is beyond this end
 *   and nearer to this line than to that of another label with `tip`, or left out
 */

/** @typedef {{x: number, y: number, r: number, heavy: number}} Dot  a part of the ink */

const GAPS = [5, 14, 26, 40, 58, 84], // px between a point and its label
  TIPS = [5, 9, 14, 20, 30, 42], // the same for a label with `tip`
  CLOSE = [5, 14], // the same for a label with `near`
  NEAR = 20, // px: the largest gap without a line
  HIGH = 16, // px: the height of a label
  REACH = 40, // px: the directions of the base, and letters beside them, are this near their centre
  APART = 28, // px: twice the distance of a label from the lines of others
  CROSSED = 8, // the cost of a line that goes through words: less than to cover a link
  MOST = 40; // the cost at which a label with `near` or `tip` is left out

/**
 * Writes the labels of a picture, after everything else is drawn in it. The places depend only on
 * what is drawn, so that the same state always has the same picture.
 * @param {Context} g
 * @param {Label[]} labels
 * @param {Box} room
 * @param {Ring[]} [handles]  the boxes of the handles, which no label covers
 */
export function placeLabels(g, labels, room, handles = []) {
  ink.push(...handles.map(wordInk));
  /** @type {Dot[]} */
  const dots = [];
  /** The letter of a handle at a place. @type {(place: Pixel) => ?string | undefined} */
  const on = ([x, y]) => handles.find(box => box[4] && hit([x - 4, y - 4, 8, 8], [box]))?.[4];
  let marked = 0; // the number of lines in `ink` whose dots are known
  for (const label of labels) {
    while (marked < ink.length) mark(dots, ink[marked++]);
    const {text, color, weight, at, tip} = label;
    if (
      labels.find(one => one.text + one.at === text + at) !== label ||
      // the letter of an axis below rings would seem to belong to another
      (tip && (on(at) === text || (on(at) && on(tip))))
    )
      continue;
    g.font = font(12, weight);
    const wide = g.measureText(text).width + 4,
      found = placed(label, labels, dots, wide, room);
    if (!found) continue;
    const [x, y, led] = found;
    if (led) haloed(g, led, color, 1);
    if (color === colors.alarm) {
      // else the red ring of a joint would show between two words
      g.fillStyle = colors.paper;
      g.fillRect(x, y, wide, HIGH - 1);
    }
    write(g, text, x + 2, y + 12, color, 12, "left", weight);
  }
}

/**
 * The upper left corner of a label, and the line to its point if it needs one; null if it is left
 * out.
 * @param {Label} label
 * @param {Label[]} labels  all labels
 * @param {Dot[]} dots
 * @param {number} wide
 * @param {Box} room
 * @returns {?[number, number, ?Pixel[]]}
 */
function placed(
  {text, at, along = [at], apart = [], away, near, tip},
  labels,
  dots,
  wide,
  [left, top, width, height],
) {
  const [ax, ay] = away ?? [0.5, -0.5],
    turns = tip ? 24 : 12, // the number of directions
    // px: the largest gap without a line
    unled = tip || apart.length ? CLOSE[1] : away ? Infinity : NEAR;
  /** @type {?[number, number, ?Pixel[]]} */
  let best = null;
  let least = tip || near ? MOST : Infinity;
  for (const [ox, oy] of along) {
    const [px, py] = [between(ox, left, width), between(oy, top, height)],
      close = dots.filter(({x, y, r}) => Math.hypot(x - px, y - py) < r + wide + 110);
    for (const each of apart) {
      mark(close, [[each], APART, WORD]);
      mark(close, [[each], 4 * APART, 0.1]);
    }
    for (const gap of tip ? TIPS : near ? CLOSE : GAPS)
      for (let k = 0; k < turns; k++) {
        const angle = (-2 * Math.PI * k) / turns,
          c = Math.cos(angle),
          s = Math.sin(angle),
          u = between(px + c * (gap + wide / 2) - wide / 2, left, width - wide),
          v = between(py + s * (gap + HIGH / 2) - HIGH / 2, top, height - HIGH);
        if (tip) {
          const [x, y] = [u + wide / 2, v + HIGH / 2],
            own = far(x, y, at, tip) + 0.4;
          if (
            ax * (x - px) + ay * (y - py) < own || // by more than 70° aside
            labels.some(one => one.tip && one.text !== text && far(x, y, one.at, one.tip) < own)
          )
            continue;
        }
        let cost = gap / 6 + 1 - ax * c - ay * s;
        // dots are objects, not arrays, since this loop takes most of the time
        for (const {x, y, r, heavy} of close) {
          if (cost >= least) break;
          if (x > u - r && x < u + wide + r && y > v - r && y < v + HIGH + r) cost += heavy;
        }
        const led =
          cost < least && gap > unled
            ? leader([px, py], u, v, wide, tip || along[1] ? 0 : 6)
            : null;
        if (led && crossed(close, led[0], [px, py])) cost += CROSSED;
        if (cost < least) [best, least] = [[u, v, led], cost];
      }
  }
  return best;
}

/**
 * The line to a point from a label whose upper left corner is (u, v). It ends `gap` pixels before
 * the point.
 * @type {(at: Pixel, u: number, v: number, wide: number, gap: number) => [Pixel, Pixel]}
 */
function leader([px, py], u, v, wide, gap) {
  const [ex, ey] = [between(px, u, wide), between(py, v, HIGH)],
    share = gap / Math.hypot(ex - px, ey - py);
  return [
    [ex, ey],
    [px + share * (ex - px), py + share * (ey - py)],
  ];
}

/**
 * Whether a line from a point goes through words, beyond what is at the point itself.
 * @type {(dots: Dot[], end: Pixel, at: Pixel) => boolean}
 */
const crossed = (dots, end, [px, py]) =>
  dots.some(
    ({x, y, r, heavy}) =>
      heavy === WORD && Math.hypot(x - px, y - py) > r && far(x, y, end, [px, py]) < r,
  );

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
 * The distance of a place from a line.
 * @type {(x: number, y: number, from: Pixel, to: Pixel) => number}
 */
const far = (x, y, [px, py], [qx, qy]) => {
  const [dx, dy] = [qx - px, qy - py],
    share = between(((x - px) * dx + (y - py) * dy) / (dx * dx + dy * dy), 0, 1);
  return Math.hypot(x - px - share * dx, y - py - share * dy);
};

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
