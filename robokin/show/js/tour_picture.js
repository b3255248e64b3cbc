// Draws the tours in the picture of their explorer.

import {clear, colors, spot, stroke} from "./canvas.js";
import {fk, origin} from "./kinematics.js";

/** @import {PageLink} from "./page.js" */
/** @import {Color} from "./canvas.js" */
/** @import {Draw} from "./scene.js" */
/** @import {Answer, FoundTour, State, TourName} from "./tour_explorer.js" */

/** @typedef {ReturnType<typeof toured>} Tour */

const FINE = 0.05; // rad: step of the fastest joint between two points of a drawn path
// colour-blind readers can distinguish these colours, and the dashes differ, too
/** @type {Record<TourName, Color>} */
const COLORS = {greedy: "joint2", best: "joint1", yours: "joint3"};
/** @type {Record<TourName, [width: number, dash?: number[]]>} */
const LINES = {greedy: [2.2, [7, 7]], best: [3.4], yours: [7, [3, 4]]}; // all are visible where
// they coincide

/**
 * A tour to draw and to play: the places of the tool, and the posture at a time.
 * @param {PageLink[]} chain
 * @param {FoundTour} tour
 * @param {TourName} name
 */
export function toured(chain, {t, q, order, times}, name) {
  const when = [...t.values],
    stops = when.map((_, k) => [...q.values.slice(3 * k, 3 * k + 3)]);
  /** @type {(a: number[], b: number[], share: number) => number[]} */
  const interpolate = (a, b, share) => a.map((x, j) => x + share * (b[j] - x));
  const places = stops
    .flatMap((to, k) => {
      if (!k) return [to];
      if (String(to) === String(stops[k - 2])) return [null, to]; // back on the same way
      const count = Math.max(
        1,
        Math.ceil(Math.max(...to.map((x, j) => Math.abs(x - stops[k - 1][j]))) / FINE),
      );
      return Array.from({length: count}, (_, i) => interpolate(stops[k - 1], to, (i + 1) / count));
    })
    .map(posture => posture && origin(fk(chain, posture)));
  return {
    name,
    places,
    order,
    times,
    dips: places.some(p => p && p[2] < 0),
    /** @type {(time: number) => number[]} */
    at(time) {
      const k = when.findIndex(x => x > time);
      return k < 1
        ? /** @type {number[]} */ (stops.at(k))
        : interpolate(stops[k - 1], stops[k], (time - when[k - 1]) / (when[k] - when[k - 1]));
    },
  };
}

/**
 * Sets the style of each handle: served, still to be served, left out, or out of reach.
 * @param {HTMLElement} layer
 * @param {State} state
 * @param {Answer} answer
 * @param {?Tour} [tour]
 */
export function mark(layer, {time}, {start, reached}, tour) {
  for (const node of /** @type {HTMLCollectionOf<HTMLElement>} */ (layer.children)) {
    const k = Number(node.dataset.handle),
      point = node.dataset.handle !== "p0",
      served = tour ? tour.order.indexOf(k) : -1;
    node.classList.toggle("rk-away", point ? reached[k] === false : !start);
    node.classList.toggle("rk-left", point && served < 0);
    node.classList.toggle("rk-served", !!tour && served >= 0 && tour.times[served] <= time + 1e-9);
    node.style.setProperty(
      "--own",
      `var(--rk-${tour && served >= 0 ? COLORS[tour.name] : "soft"})`,
    );
  }
}

/**
 * Draws below the arm: its reach, the heights of the points, the tours, and a band where the tool
 * dips below the floor.
 * @type {(state: State, tours: (?Tour)[]) => Draw}
 */
export const below =
  ({p0, points, l1, l2}, tours) =>
  (g, {to}) => {
    const ring = Array.from({length: 73}, (_, i) => (i * Math.PI) / 36).map(x =>
      to([(l1 + l2) * Math.cos(x), (l1 + l2) * Math.sin(x), 0]),
    );
    stroke(g, ring, colors.rim, 1.2, [1.5, 4]);
    for (const [x, y, z] of [p0, ...points]) {
      stroke(g, [to([x, y, z]), to([x, y, 0])], colors.soft, 1, [2, 3]);
      spot(g, to([x, y, 0]), 2, colors.soft, colors.paper, 0.5);
    }
    // draw the dashed tour last
    for (const tour of [...tours].reverse()) {
      if (!tour) continue;
      if (tour.dips)
        stroke(
          g,
          tour.places.map(p => (p && p[2] < 0 ? to(p) : null)),
          clear(colors.alarm, 0.35),
          9,
        );
      stroke(
        g,
        tour.places.map(p => p && to(p)),
        colors[COLORS[tour.name]],
        ...LINES[tour.name],
      );
    }
  };
