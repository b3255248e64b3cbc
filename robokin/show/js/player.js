// The player: recorded motions of arms in space beside their curves. page.py has its data.

import {number, replaceStill, tiled} from "./canvas.js";
import {sceneOf, sceneView} from "./scene.js";
import {curvesView} from "./curves.js";
import {broken, motionsOf, tipOf} from "./motions.js";
import {orbit, pictures, sceneCanvas, scrubbing} from "./controls.js";
import {clockRow, runningClock} from "./clock.js";
import {choice, element, range, waiting} from "./elements.js";

/** @import {Page, PageArm} from "./page.js" */
/** @import {Column} from "./curves.js" */
/** @import {Moment, Track} from "./motions.js" */

/** @typedef {ReturnType<typeof furniture>} Parts */

/**
 * Builds the view in every place that waits for this id.
 * @param {string} id
 * @param {Page} data
 */
export const play = (id, data) => waiting(id).forEach(root => start(root, data));

/**
 * Starts a player in `root`.
 * @param {HTMLElement} root
 * @param {Page} data
 */
function start(root, data) {
  const scene = sceneOf(data),
    parts = furniture(data);
  const inSpace = sceneView(parts.scene, scene),
    overTime = curvesView(parts.curves, data.dashes);
  const state = {time: data.times[0], value: 0, choice: 0, view: [...scene.view], playing: false};
  const motions = motionsOf(data);
  let shown = motions.choose(0);

  function choose() {
    shown = motions.choose(
      state.choice * (data.slider ? data.slider.values.length : 1) + state.value,
    );
    tell(parts, data, shown, state.value);
  }
  /** @param {number} now */
  function draw(now) {
    clock.pass(now);
    sized(parts, inSpace, data.arms.length, scene.bases ? 1 : data.arms.length);
    const moment = momentAt(data.times, state.time),
      arms = shown.arms.map(arm => armAt(arm, moment));
    shown.columns.forEach((column, k) => shownAt(column, moment, shown.arms[k].gaps));
    scene.things = motions.things(shown.motion, moment.i, moment.share);
    clock.tell();
    const room = inSpace.draw(state.view, arms, `t = ${number(state.time, 2)} s`);
    overTime.draw(shown.columns, data.times, data.ticks, state.time);
    return room;
  }

  replaceStill(root, parts.frame, parts.scene, parts.curves);
  const ask = pictures(root, [parts.scene, parts.curves], draw); // also draws the first picture
  const clock = runningClock(
    parts,
    parts.frame,
    state,
    () => [data.times[0], data.times[data.times.length - 1]],
    ask,
  );
  const {slider, menu} = parts;
  slider?.addEventListener("input", () => {
    state.value = +slider.value;
    choose();
    ask();
  });
  menu?.addEventListener("change", () => {
    state.choice = +menu.value;
    choose();
    ask();
  });
  orbit(parts.scene, scene, state, ask);
  /** @type {number | undefined} */
  let held;
  scrubbing(parts.curves, (event, first) => {
    const [time, column] = overTime.timeAt(event.offsetX, event.offsetY, first ? undefined : held);
    held = column;
    clock.set(time);
  });
  tell(parts, data, shown, state.value);
}

// --- What is on the page -------------------------------------------------------------------------

/** @param {Page} data */
function furniture(data) {
  const {slider, switch: menu} = data;
  const parts = {
    scene: sceneCanvas(data.scene, data.alt),
    curves: element("canvas", {
      class: "rk-curves",
      role: "img",
      "aria-label":
        `Curves over time of ${data.arms.map(arm => arm.name).join(" and ")}: joint values, ` +
        "speeds, accelerations. The greatest values stand in the table.",
    }),
    ...clockRow(),
    table: element("div", {class: "rk-table"}),
    notes: element("ul", {class: "rk-notes"}),
    slider: slider && range(slider.label, slider.values.length - 1),
    value: element("span", {class: "rk-value"}),
    menu: menu && choice(menu.label, menu.values),
  };
  // the controls are above the pictures, so that a small screen shows the slider and the arm
  // together
  const rows = [parts.row];
  if (slider || menu) rows.unshift(element("div", {class: "rk-row"}));
  if (slider && parts.slider)
    rows[0].append(element("label", {class: "rk-long"}, slider.label, parts.slider, parts.value));
  if (menu && parts.menu) rows[0].append(element("label", {}, menu.label, parts.menu));
  const frame = element(
    "div",
    {class: "rk", role: "group", "aria-label": data.title},
    element("div", {class: "rk-title"}, data.title),
    ...rows,
    element(
      "div",
      {class: `rk-views${data.arms.length > 1 ? " rk-wide" : ""}`},
      parts.scene,
      parts.curves,
    ),
    parts.table,
    parts.notes,
  );
  return {...parts, frame};
}

/**
 * Sets the height of the curves and, if the scene has the whole width, its height to what its arms
 * fill.
 * @param {Pick<Parts, "scene" | "curves">} parts
 * @param {Pick<ReturnType<typeof sceneView>, "height">} inSpace
 * @param {number} arms  the number of arms with curves
 * @param {number} count  the number of pictures in the scene
 */
function sized({scene, curves}, inSpace, arms, count) {
  const [, rows] = tiled(arms, curves.clientWidth),
    whole = scene.offsetTop !== curves.offsetTop;
  curves.style.height = rows > 1 ? `${rows * 330}px` : "";
  const width = scene.clientWidth;
  if (!whole || !width) {
    scene.style.height = "";
    return;
  }
  const most = tiled(count, width)[1] * (count > 1 ? 290 : 340),
    filled = Math.max(190, inSpace.height(count, width));
  scene.style.height = `${Math.round(Math.min(most, filled))}px`;
}

/**
 * Shows the numbers of a motion, as a table and in words.
 * @param {Parts} parts
 * @param {Page} data
 * @param {{arms: Track[], motion: number}} shown
 * @param {number} value  the index of the slider value
 */
function tell(parts, data, {arms, motion}, value) {
  const {slider} = data;
  /** @type {(arm: {name: string}) => string} */
  const whose = arm => (data.arms.length > 1 ? `${arm.name}: ` : "");
  const near = arms
    .flatMap(arm => (arm.near ? [`${whose(arm)}path passes via at ${arm.near.text}`] : []))
    .concat(data.sampled)
    .join("; ");
  const most = Math.max(...data.arms.map(arm => arm.chain.length));
  const head = element(
    "tr",
    {},
    element("th", {scope: "col"}, near),
    ...Array.from({length: most}, (_, j) => element("th", {scope: "col"}, `joint ${j + 1}`)),
  );
  const body = data.arms.flatMap(arm => lines(data, arm, whose(arm), motion));
  parts.table.replaceChildren(
    element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)),
  );
  parts.notes.replaceChildren(
    ...data.arms.flatMap(arm =>
      (arm.notes[motion] || []).map(text => element("li", {}, whose(arm) + text)),
    ),
  );
  if (!slider) return;
  parts.value.textContent = number(slider.values[value], slider.decimals);
  parts.slider?.setAttribute("aria-valuetext", parts.value.textContent);
}

/**
 * The rows of an arm in the table.
 * @param {Page} data
 * @param {PageArm} arm
 * @param {string} whose
 * @param {number} motion
 */
function lines({unit, decimals}, arm, whose, motion) {
  const units = [...new Set(arm.chain.map(link => (link.prismatic ? unit.name : "\u00B0")))];
  /**
   * @param {string} name
   * @param {string} time
   * @param {boolean} limited
   * @param {(j: number) => HTMLElement} cell
   */
  const line = (name, time, limited, cell) => {
    const per = units.map(u => `${u}/${time}`).join(" or "),
      text = `${whose}${name}, ${per}${limited ? " (of limit)" : ""}`;
    const cells = arm.chain.map((_, j) => cell(j));
    return element("tr", {}, element("th", {scope: "row"}, text), ...cells);
  };
  return [
    line("greatest speed", "s", !!arm.share, j => {
      const share = arm.share ? ` (${arm.share[motion][j]}\u00A0%)` : "";
      return element("td", {}, number(arm.speed[motion][j], decimals[0]) + share);
    }),
    line("greatest acceleration", "s\u00B2", false, j => {
      const most = arm.acceleration[motion][j];
      return typeof most === "string"
        ? element("td", {class: "rk-jump"}, most)
        : element("td", {}, number(most, decimals[1]));
    }),
  ];
}

// --- A moment ------------------------------------------------------------------------------------

/** @type {(times: number[], time: number) => Moment} */
function momentAt(times, time) {
  const last = times.length - 1;
  let i = 0;
  for (let step = 1 << 10; step; step >>= 1)
    if (i + step <= last && times[i + step] <= time) i += step;
  return {i, share: i < last ? (time - times[i]) / (times[i + 1] - times[i]) : 0};
}

/**
 * The arm for the scene; if there is no posture, the last one before it, faded.
 * @param {Track} arm
 * @param {Moment} moment
 */
function armAt(arm, {i, share}) {
  const gap = arm.gaps.has(i);
  let q = arm.q(i, gap ? 0 : share);
  const faded = !q.every(Number.isFinite) || (gap && share > 0 && !arm.places[i + 1]);
  for (let back = i; !q.every(Number.isFinite) && back >= 0; back--) q = arm.q(back, 0);
  return {
    ...arm,
    q,
    faded,
    tail: [...broken(arm.places.slice(0, i + 1), arm.gaps), tipOf(arm.chain, q)],
  };
}

/**
 * @param {Column} column
 * @param {Moment} moment
 * @param {Set<number>} gaps
 */
function shownAt(column, {i, share}, gaps) {
  for (const panel of column.panels)
    panel.now = panel.curves.map(curve =>
      share && !gaps.has(i) ? curve[i] + share * (curve[i + 1] - curve[i]) : curve[i],
    );
}
