// The explorer of tours: points taken by the hand, the tours that a kernel makes of them (live.js),
// and a clock along which the arm goes them; the clock needs no kernel. What is said comes from
// Python (tour_explorer.py).

import {fk, origin, plus} from "./kinematics.js";
import {clear, colors, number, spot, stroke} from "./canvas.js";
import {clockRow, runningClock} from "./clock.js";
import {copyButton} from "./copy.js";
import {control, element, waiting} from "./elements.js";
import {fill} from "./blanks.js";
import {inScreen} from "./handles.js";
import {kernelOf, unpacked} from "./live.js";
import {beside, menu, slider, stageOf, table, wordButton} from "./stage.js";
import {plain} from "./turns.js";

/** @import {PageExplorer, PageLink, With} from "./page.js" */
/** @import {Color, Context, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Values} from "./live.js" */
/** @import {Stage} from "./stage.js" */

/**
 * @typedef {With<PageExplorer, "kinds" | "tours" | "most" | "spare" | "question" | "first">}
 *   TourExplorer
 */
/** @typedef {"greedy" | "best"} TourName */
/**
 * What is asked: a task; `held`: whether the hand still moves it.
 * @typedef {object} Question
 * @property {number} l1
 * @property {number} l2
 * @property {number} T
 * @property {string} kind
 * @property {Point} p0
 * @property {Point[]} points
 * @property {boolean} held
 */
/**
 * A tour as Python has it: when the arm stops, and where; the points served, and when.
 * @typedef {object} FoundTour
 * @property {Values} t
 * @property {Values} q
 * @property {number[]} order
 * @property {number[]} times
 * @property {string[]} cells  of the table
 */
/**
 * What Python answers: `answered` of tour_explorer.py says it.
 * @typedef {object} Answer
 * @property {PageLink[]} chain
 * @property {boolean} start
 * @property {boolean[]} reached
 * @property {?FoundTour} greedy
 * @property {?FoundTour} best
 * @property {string} says
 * @property {string[]} notes
 */
/** @typedef {ReturnType<typeof toured>} Tour */
/** @typedef {{answer: Answer, question: Question, tours: (?Tour)[], cells: string[][]}} Heard */
/**
 * `touched`: the last point that was taken; `chosen`: the row of the table.
 * @typedef {Question & {touched: number, chosen: number, time: number, playing: boolean}} State
 */

const FINE = 0.05; // rad of the fastest joint between two points of a drawn path
// apart for colour-blind readers, and by their dashes
/** @type {Record<TourName, Color>} */
const COLORS = {greedy: "joint2", best: "joint1"};
/** @type {Record<TourName, [width: number, dash?: number[]]>} */
const LINES = {greedy: [2.2, [7, 7]], best: [3.4]}; // where both go the same way, both are seen

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {TourExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => tourExplorer(root, id, stageOf(root, data), data));

/**
 * @param {HTMLElement} root
 * @param {string} id
 * @param {Stage} stage
 * @param {TourExplorer} data
 */
function tourExplorer(root, id, stage, data) {
  const {words: says, unit} = data,
    names = /** @type {TourName[]} */ (data.tours),
    home = /** @type {Question} */ (data.question);
  /** @type {State} */
  const state = {
    ...home,
    p0: [...home.p0],
    points: home.points.map(p => [...p]),
    touched: home.points.length - 1,
    chosen: names.indexOf("best"),
    time: 0,
    playing: false,
  };
  let heard = read(names, /** @type {Answer} */ (unpacked(data.first)), home),
    asked = JSON.stringify(question(state));

  // --- beside the scene
  const keys = /** @type {const} */ (["l1", "l2", "T"]),
    sizes = [unit.size, unit.size, 1];
  const sliders = data.controls.map((spec, k) =>
    slider(spec, value => {
      state[keys[k]] = Math.min(spec.high, Math.max(spec.low, value)) * sizes[k];
      stage.changed();
    }),
  );
  const kind = menu(says.task, data.kinds, k => {
    state.kind = data.kinds[k];
    stage.changed();
  });
  /** @type {(text: string, act: () => void) => HTMLButtonElement} */
  const button = (text, act) => {
    const node = control("button", {type: "button", class: "rk-word"}, text);
    node.addEventListener("click", () => {
      act();
      stage.handles.set(handles());
      stage.changed();
    });
    return node;
  };
  const add = button(says.add, () => {
    state.points.push([...data.spare[state.points.length]]);
    state.touched = state.points.length - 1;
  });
  const remove = button("", () => {
    state.points.splice(state.touched, 1);
    state.touched = state.points.length - 1;
  });
  stage.side.append(
    ...sliders.map(s => s.row),
    kind.row,
    element(
      "div",
      {class: "rk-row"},
      add,
      remove,
      copyButton(says, () => fill(data.code, inCode(state))),
    ),
  );
  const rows = table(names, [says.tour, says.order, says.count, says.time], [1, 1, 1], k => {
    state.chosen = k;
    stage.changed();
  });
  rows.node.classList.add("rk-tours");
  const notes = element("ul", {class: "rk-notes"});
  beside(stage.side, stage.says, notes);
  stage.below.append(rows.node);

  // --- below the scene: alive while the rest is asleep
  const parts = clockRow();
  beside(stage.space, parts.row);
  const end = () => heard.question.T;
  const clock = runningClock(parts, stage.frame, state, () => [0, end()], stage.changed);

  // --- what the hand holds
  /** @type {(on: boolean) => void} */
  const hold = on => {
    state.held = on;
  };
  const letGo = () => {
    hold(false);
    stage.changed();
  };
  for (const event of ["pointerup", "pointercancel", "lostpointercapture"])
    stage.handles.layer.addEventListener(event, letGo);
  stage.side.addEventListener("input", event =>
    hold(/** @type {HTMLInputElement} */ (event.target).type === "range"),
  );
  stage.side.addEventListener("change", letGo);
  /**
   * @param {string} name
   * @param {string} id
   * @param {string} mark
   * @param {() => Point} where  the place itself, which is written over
   * @param {Point} first
   * @param {() => void} touch
   * @returns {Handle}
   */
  const handle = (name, id, mark, where, first, touch) => ({
    id,
    name,
    mark,
    look: "rk-point",
    at: where,
    value: () =>
      `${where()
        .map(x => number(x / unit.size, 2))
        .join(", ")} ${unit.name}`,
    grab(camera) {
      const p = where(),
        to = inScreen(camera, [...p]);
      touch();
      hold(true);
      return (dx, dy) => p.splice(0, 3, ...to(dx, dy));
    },
    step(right, up, big) {
      const camera = stage.camera(),
        by = big ? 30 : 3;
      touch();
      where().splice(0, 3, ...plus(where(), camera.across(right * by, -up * by)));
    },
    home: () => {
      where().splice(0, 3, ...first);
    },
  });
  const handles = () => [
    handle(
      says.takeStart,
      "p0",
      "p0",
      () => state.p0,
      home.p0,
      () => {},
    ),
    ...state.points.map((p, k) =>
      handle(
        fill(says.takePoint, {k}),
        `${k}`,
        `${k}`,
        () => p,
        home.points[k] || [...p],
        () => {
          state.touched = k;
        },
      ),
    ),
  ];
  stage.handles.set(handles());

  // --- what Python says
  const tell = () => {
    const {answer} = heard;
    state.time = Math.min(state.time, end());
    stage.says.textContent = answer.says;
    notes.replaceChildren(...answer.notes.map(text => element("li", {}, text)));
    stage.changed();
  };
  /** @type {(answer: Answer, asking: Question) => void} */
  const hear = (answer, asking) => {
    heard = read(names, answer, asking);
    tell();
  };
  tell();
  const kernel = kernelOf(root, id, says, hear);

  let last = /** @type {Tour} */ (heard.tours.find(Boolean)).at(0); // there is one at first
  stage.run(() => {
    clock.pass(performance.now());
    clock.tell();
    const asking = question(state),
      text = JSON.stringify(asking);
    if (text !== asked) kernel.ask(asking);
    asked = text;

    keys.forEach((key, k) => sliders[k].set(state[key] / sizes[k]));
    kind.set(data.kinds.indexOf(state.kind));
    add.disabled = state.points.length >= data.most;
    remove.disabled = state.points.length < 2;
    remove.textContent = fill(says.remove, {k: state.touched});
    const {answer, tours} = heard,
      tour = tours[state.chosen] || tours.find(each => each !== null);
    rows.set(heard.cells, tour ? tours.indexOf(tour) : -1, tours.map(Boolean));
    mark(stage.handles.layer, state, heard, tour);
    last = tour ? tour.at(state.time) : last;
    stage.scene.marks = [state.p0, ...state.points].map(at => ({name: "", at, radius: 0}));
    return [
      {
        name: "",
        chain: answer.chain,
        q: last,
        faded: false,
        under: (g, cam) => below(g, cam, state, heard),
      },
    ];
  });
}

/** @type {(state: Question) => Question} */
const question = ({l1, l2, T, kind, p0, points, held}) => ({l1, l2, T, kind, p0, points, held});

/**
 * An answer with the tours and the table that are shown of it.
 * @param {TourName[]} names
 * @param {Answer} answer
 * @param {Question} question
 * @returns {Heard}
 */
const read = (names, answer, question) => ({
  answer,
  question,
  tours: names.map(name => answer[name] && toured(answer.chain, answer[name], name)),
  cells: names.map(name => answer[name]?.cells ?? ["\u2013", "\u2013", "\u2013"]),
});

/**
 * A tour that can be drawn and gone: the places of the tool, and the posture at a time.
 * @param {PageLink[]} chain
 * @param {FoundTour} tour
 * @param {TourName} name
 */
function toured(chain, {t, q, order, times}, name) {
  const when = [...t.values],
    stops = when.map((_, k) => [...q.values.slice(3 * k, 3 * k + 3)]);
  /** @type {(a: number[], b: number[], share: number) => number[]} */
  const between = (a, b, share) => a.map((x, j) => x + share * (b[j] - x));
  const places = stops
    .flatMap((to, k) => {
      if (!k) return [to];
      const count = Math.max(
        1,
        Math.ceil(Math.max(...to.map((x, j) => Math.abs(x - stops[k - 1][j]))) / FINE),
      );
      return Array.from({length: count}, (_, i) => between(stops[k - 1], to, (i + 1) / count));
    })
    .map(posture => origin(fk(chain, posture)));
  return {
    name,
    places,
    order,
    times,
    dips: places.some(p => p[2] < 0),
    /** @type {(time: number) => number[]} */
    at(time) {
      const k = when.findIndex(x => x > time);
      return k < 1
        ? /** @type {number[]} */ (stops.at(k))
        : between(stops[k - 1], stops[k], (time - when[k - 1]) / (when[k] - when[k - 1]));
    },
  };
}

/**
 * How each handle looks: served by now, still to be served, left, out of reach; and its place in
 * both tours.
 * @param {HTMLElement} layer
 * @param {State} state
 * @param {Heard} heard
 * @param {?Tour} [tour]
 */
function mark(layer, {time}, {answer: {start, reached}, tours}, tour) {
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
    for (const each of tours.filter(each => each !== null)) {
      const rank = each.order.indexOf(k);
      node.dataset[each.name] = rank < 0 ? "" : `${rank + 1}.`;
    }
  }
}

/**
 * Below the arm: how far it reaches, how high the points stand, the tours; a band where the tool
 * dips under the floor.
 * @param {Context} g
 * @param {Camera} camera
 * @param {State} state
 * @param {Heard} heard
 */
function below(g, {to}, {p0, points, l1, l2}, {tours}) {
  const ring = Array.from({length: 73}, (_, i) => (i * Math.PI) / 36).map(x =>
    to([(l1 + l2) * Math.cos(x), (l1 + l2) * Math.sin(x), 0]),
  );
  stroke(g, ring, colors.rim, 1.2, [1.5, 4]);
  for (const [x, y, z] of [p0, ...points]) {
    stroke(g, [to([x, y, z]), to([x, y, 0])], colors.soft, 1, [2, 3]);
    spot(g, to([x, y, 0]), 2, colors.soft, colors.paper, 0.5);
  }
  for (const tour of [...tours].reverse().filter(each => each !== null)) {
    // the dashed one last
    if (tour.dips)
      stroke(
        g,
        tour.places.map(p => (p[2] < 0 ? to(p) : null)),
        clear(colors.alarm, 0.35),
        9,
      );
    stroke(g, tour.places.map(to), colors[COLORS[tour.name]], ...LINES[tour.name]);
  }
}

/** @param {Question} question */
const inCode = ({l1, l2, T, kind, p0, points}) => {
  /** @type {(p: Point) => string} */
  const list = p => `[${p.map(x => plain(x, 6)).join(", ")}]`;
  return {
    l1: plain(l1, 4),
    l2: plain(l2, 4),
    T: plain(T, 3),
    kind,
    p0: list(p0),
    points: `[${points.map(list).join(", ")}]`,
  };
};
