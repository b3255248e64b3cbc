// The tour explorer: points to drag, and the tours that a kernel computes (live.js). The reader's
// own order, the tour through it, and the clock that moves the arm along a tour need no kernel. The
// text comes from Python (tour_explorer.py).

import {number} from "./canvas.js";
import {clockRow, runningClock} from "./clock.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {fill, plain} from "./blanks.js";
import {inScreen} from "./handles.js";
import {plus} from "./kinematics.js";
import {kernelOf, joinArrays} from "./live.js";
import {beside, menu, slider, stageOf, wordButton} from "./stage.js";
import {table} from "./table.js";
import {found} from "./own_tour.js";
import {below, mark} from "./tour_picture.js";
import {point} from "./mark.js";

/** @import {PageLink, TourPage, With} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Values} from "./live.js" */
/** @import {Stage} from "./stage.js" */
/** @import {Tour} from "./tour_picture.js" */

/** @typedef {With<TourPage, "question" | "first">} TourExplorer */
/** @typedef {"greedy" | "best" | "yours"} TourName */
/**
 * A question: a task, and whether the reader is still dragging (`held`).
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
 * A tour: the times and postures of the stops, and the points served with their times.
 * @typedef {object} FoundTour
 * @property {Values} t
 * @property {Values} q
 * @property {number[]} order
 * @property {number[]} times
 * @property {string[]} cells  its row of the table
 */
/**
 * Python's answer: see `answered` in tour_explorer.py.
 * @typedef {object} Answer
 * @property {PageLink[]} chain
 * @property {boolean} start
 * @property {boolean[]} reached
 * @property {(?(?number)[])[]} postures
 * @property {?FoundTour} greedy
 * @property {?FoundTour} best
 * @property {string} says
 * @property {string} alone
 * @property {string} among
 * @property {string[]} notes
 */
/** @typedef {{answer: Answer, question: Question}} Heard */
/**
 * `touched` is the point that was grabbed last, `chosen` the chosen row of the table, `order` the
 * reader's own order, and `best` whether the best order is shown.
 * @typedef {Question & {touched: number, chosen: number, order: number[], best: boolean,
 *   time: number, playing: boolean}} State
 */

/**
 * Builds the view in every placeholder with this id.
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
  const {words: says} = data,
    names = /** @type {TourName[]} */ (data.tours),
    home = /** @type {Question} */ (data.question);
  const state = opened(home, data.best);
  /** @type {Heard} */
  let heard = {answer: /** @type {Answer} */ (joinArrays(data.first)), question: home};
  let shown = found(data, state, heard),
    asked = JSON.stringify(question(state));
  // the clock is below the scene, so that it works while the rest is inactive
  const parts = clockRow(),
    end = () => heard.question.T,
    clock = runningClock(parts, stage.frame, state, () => [0, end()], stage.changed);
  const tell = () => {
    shown = found(data, state, heard);
    state.time = Math.min(state.time, end());
    say(stage, notes, says, shown.says, heard.answer);
    stage.changed();
  };
  /** Sets the reader's order, and shows the arm at its end. @param {number[]} order */
  const take = order => {
    [state.order, state.chosen] = [order, names.indexOf("yours")];
    tell();
    clock.set(shown.tours[state.chosen]?.times.at(-1) ?? 0);
  };
  const tap = (/** @type {number} */ k) => {
    const {order} = state;
    if (order.includes(k)) take(without(order, k));
    else if (heard.answer.reached[k]) take([...order, k]);
  };
  const setHandles = () => stage.handles.set(pointHandles(root, stage, data, state, home, tap));
  const inputs = inputsOf(stage, data, state, setHandles),
    rows = tourTable(stage, says, names, state),
    notes = element("ul", {class: "rk-notes"});
  beside(stage.side, stage.says, notes);
  parts.row.append(wordButton(says.clear, () => take([])));
  beside(stage.space, parts.row);
  holding(stage, state);
  setHandles();
  tell();
  const kernel = kernelOf(root, id, says, (/** @type {Answer} */ answer, asking) => {
    heard = {answer, question: asking};
    tell();
  });
  let last = /** @type {Tour} */ (shown.tours.find(Boolean)).at(0); // the first answer has a tour
  stage.run(() => {
    clock.pass(performance.now());
    clock.tell();
    const asking = question(state),
      text = JSON.stringify(asking);
    if (text !== asked) kernel.ask(asking);
    asked = text;
    inputs.tell();
    const {tours, cells} = shown,
      tour = tours[state.chosen] || tours.find(Boolean);
    rows.set(cells, tour ? tours.indexOf(tour) : -1, tours.map(Boolean));
    last = tour ? tour.at(state.time) : last;
    return draw(stage, state, heard.answer, tours, tour, last);
  });
}

/**
 * Marks the handles, and returns the arm to draw.
 * @param {Stage} stage
 * @param {State} state
 * @param {Answer} answer
 * @param {(?Tour)[]} tours
 * @param {?Tour | undefined} tour  the chosen tour
 * @param {number[]} q
 */
function draw(stage, state, answer, tours, tour, q) {
  mark(stage.handles.layer, state, answer, tour);
  stage.scene.things = [state.p0, ...state.points].map(at => point("", at));
  return [{name: "", chain: answer.chain, q, under: below(state, tours)}];
}

/**
 * Shows the sentences and the notes.
 * @param {Stage} stage
 * @param {HTMLElement} list  the list of notes
 * @param {TourExplorer["words"]} words
 * @param {string} text
 * @param {Answer} answer
 */
function say(stage, list, {scene}, text, {reached, notes}) {
  stage.say(text);
  stage.name([fill(scene, {n: reached.length}), text, ...notes].join(" "));
  list.replaceChildren(...notes.map(note => element("li", {}, note)));
}

/** The order without point k. @type {(order: number[], k: number) => number[]} */
const without = (order, k) => order.filter(each => each !== k);

/**
 * The inputs for links, time and kind of task, and the buttons that add and remove points.
 * @param {Stage} stage
 * @param {TourExplorer} data
 * @param {State} state
 * @param {() => void} setHandles  creates the handles of the points again
 */
function inputsOf(stage, data, state, setHandles) {
  const {words: says, unit, controls, kinds, spare} = data;
  const keys = /** @type {const} */ (["l1", "l2", "T"]),
    sizes = [unit.size, unit.size, 1];
  const sliders = controls.map((spec, k) =>
    slider(spec, value => {
      state[keys[k]] = Math.min(spec.high, Math.max(spec.low, value)) * sizes[k];
      stage.changed();
    }),
  );
  const kind = menu(says.task, kinds, k => {
    state.kind = kinds[k];
    stage.changed();
  });
  /** @type {(text: string, act: () => void) => HTMLButtonElement} */
  const button = (text, act) =>
    wordButton(text, () => {
      act();
      state.touched = state.points.length - 1;
      setHandles();
      stage.changed();
    });
  const add = button(says.add, () => state.points.push([...spare[state.points.length]]));
  const remove = button("", () => {
    state.points.splice(state.touched, 1);
    state.order = without(state.order, state.touched).map(k => k - Number(k > state.touched));
  });
  const copy = copyButton(says, () => fill(data.code, inCode(state)));
  stage.side.append(
    ...sliders.map(s => s.row),
    kind.row,
    element("div", {class: "rk-row"}, add, remove, copy),
  );
  return {
    tell() {
      keys.forEach((key, k) => sliders[k].set(state[key] / sizes[k]));
      kind.set(kinds.indexOf(state.kind));
      add.disabled = state.points.length >= data.most;
      remove.disabled = state.points.length < 2;
      remove.textContent = fill(says.remove, {k: state.touched});
    },
  };
}

/**
 * @param {Stage} stage
 * @param {TourExplorer["words"]} says
 * @param {TourName[]} names
 * @param {State} state
 */
function tourTable(stage, says, names, state) {
  const rows = table(names, [says.tour, says.order, says.count, says.time], [1, 1, 1], k => {
    state.chosen = k;
    stage.changed();
  });
  rows.node.classList.add("rk-tours");
  stage.below.append(rows.node);
  return rows;
}

/**
 * Lets the handles react to taps, and records in the state whether the reader is dragging.
 * @param {Stage} stage
 * @param {State} state
 */
function holding(stage, state) {
  stage.handles.layer.classList.add("rk-taps");
  const letGo = () => {
    state.held = false;
    stage.changed();
  };
  for (const event of ["pointerup", "pointercancel", "lostpointercapture"])
    stage.handles.layer.addEventListener(event, letGo);
  stage.side.addEventListener("input", event => {
    state.held = /** @type {HTMLInputElement} */ (event.target).type === "range";
  });
  stage.side.addEventListener("change", letGo);
}

/**
 * The handles of the start and of every point. They move only while a kernel answers.
 * @param {HTMLElement} root
 * @param {Stage} stage
 * @param {TourExplorer} data
 * @param {State} state
 * @param {Question} home
 * @param {(k: number) => void} tap
 * @returns {Handle[]}
 */
function pointHandles(root, stage, {words: says, unit}, state, home, tap) {
  /** @type {(id: string, name: string, p: Point, first: Point, touch: () => void) => Handle} */
  const handle = (id, name, p, first, touch) => {
    /** @type {(place: Point) => void} */
    const move = place => {
      if (root.hasAttribute("data-awake")) p.splice(0, 3, ...place);
    };
    return {
      id,
      name,
      mark: id,
      look: "rk-point",
      at: () => p,
      value: () => `${p.map(x => number(x / unit.size, 2)).join(", ")} ${unit.name}`,
      grab(camera) {
        const to = inScreen(camera, [...p]);
        touch();
        return (dx, dy) => {
          state.held = true;
          move(to(dx, dy));
        };
      },
      step(right, up, big) {
        const camera = stage.camera(),
          by = big ? 30 : 3;
        touch();
        move(plus(p, camera.across(right * by, -up * by)));
      },
      home: () => move(first),
    };
  };
  const points = state.points.map((p, k) => {
    const made = handle(`${k}`, fill(says.takePoint, {k}), p, home.points[k] || [...p], () => {
      state.touched = k;
    });
    const value = () => {
      const rank = state.order.indexOf(k) + 1;
      return made.value() + (rank ? fill(says.rank, {rank}) : "");
    };
    return {...made, value, tap: () => tap(k)};
  });
  return [handle("p0", says.takeStart, state.p0, home.p0, () => {}), ...points];
}

/** @type {(home: Question, best: boolean) => State} */
const opened = (home, best) => ({
  ...home,
  p0: [...home.p0],
  points: home.points.map(p => [...p]),
  touched: home.points.length - 1,
  chosen: 1,
  order: [],
  best,
  time: 0,
  playing: false,
});

/** @type {(state: Question) => Question} */
const question = ({l1, l2, T, kind, p0, points, held}) => ({l1, l2, T, kind, p0, points, held});

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
