// The tour in the reader's own order. The page computes it without a kernel.

import {fill} from "./blanks.js";
import {toured} from "./tour_picture.js";

/** @import {Answer, FoundTour, Heard, Question, State, TourExplorer} from "./tour_explorer.js" */

/**
 * The tours that the view shows, the cells of its table, and its sentences.
 * @param {TourExplorer} data
 * @param {State} state
 * @param {Heard} heard
 */
export function found(data, state, {answer, question: asking}) {
  const {words} = data,
    mine = ownTour(data, asking, answer, state.order),
    all = answer.reached.flatMap((fine, k) => (fine ? k : []));
  state.best ||= all.length > 0 && all.every(k => state.order.includes(k));
  const own =
    mine && fill(words[asking.kind], {count: mine.cells[1], n: answer.among, t: mine.cells[2]});
  const tours = [answer.greedy, state.best ? answer.best : null, mine],
    names = /** @type {const} */ (["greedy", "best", "yours"]);
  return {
    tours: tours.map((tour, k) => tour && toured(answer.chain, tour, names[k])),
    cells: tours.map(tour => tour?.cells ?? Array(3).fill("\u2013")),
    says: [own, state.best ? answer.says : `${answer.alone} ${words.veiled}`]
      .filter(Boolean)
      .join(" "),
  };
}

/**
 * The tour through the points in the reader's order, without those out of reach. As in `itinerary`
 * (solver.py), the arm returns to the start with each point that it collects, and a free joint
 * keeps its value. Points that are reached after T are listed only in the table.
 * @param {TourExplorer} data
 * @param {Question} question
 * @param {Answer} answer
 * @param {number[]} chosen  the points in the reader's order
 * @returns {?FoundTour}  null if there is no tour
 */
function ownTour({words, speeds, slack}, {T, kind}, {postures}, chosen) {
  const order = chosen.filter(k => postures[k + 1]);
  if (!postures[0] || !order.length) return null;
  const trip = kind === "collect" ? [0] : [], // where the arm goes after each point
    each = 1 + trip.length;
  const stops = settled([0, ...order.flatMap(k => [k + 1, ...trip])].map(k => postures[k] ?? []));
  const t = [0];
  for (let k = 1; k < stops.length; k++)
    t.push(
      t[k - 1] + Math.max(...speeds.map((v, j) => Math.abs(stops[k][j] - stops[k - 1][j]) / v)),
    );
  const times = order.map((_, k) => t[each * (k + 1)]),
    count = times.filter(time => time - T <= slack * T).length;
  const parts = order.map((k, i) => `${k}\u00A0(${times[i].toFixed(2)})`),
    after = count < order.length ? [`${words.late} ${parts.slice(count).join(", ")}`] : [];
  const last = each * count + 1;
  return {
    t: {values: Float32Array.from(t.slice(0, last)), shape: [last]},
    q: {values: Float32Array.from(stops.slice(0, last).flat()), shape: [last, speeds.length]},
    order: order.slice(0, count),
    times: times.slice(0, count),
    cells: [
      [...parts.slice(0, count), ...after].join(", "),
      String(count),
      (count ? times[count - 1] : 0).toFixed(2),
    ],
  };
}

/**
 * Postures whose free joints (null) have their values at the previous stop or, at the beginning,
 * at the first stop at which they are not free.
 * @param {(?number)[][]} stops
 * @returns {number[][]}
 */
function settled(stops) {
  const now = stops[0].map((_, j) => stops.find(q => q[j] !== null)?.[j] ?? 0);
  return stops.map(q => q.map((x, j) => (now[j] = x ?? now[j])));
}
