// The player: recorded motions of arms in space next to their curves. page.py defines its data.

import {apart} from "./arm_picture.js";
import {number, replaceStill} from "./canvas.js";
import {sceneOf, sceneView} from "./scene.js";
import {curvesView} from "./curves.js";
import {broken, motionsOf, pastNow, tipOf} from "./motions.js";
import {orbit, sceneCanvas, scrubbing} from "./controls.js";
import {pictures} from "./pictures.js";
import {clockRow, runningClock} from "./clock.js";
import {choice, control, element, waiting} from "./elements.js";
import {numberTable} from "./player_table.js";
import {range} from "./sliders.js";

/** @import {Page} from "./page.js" */
/** @import {Panel} from "./panel.js" */
/** @import {Moment, Track} from "./motions.js" */

/** @typedef {ReturnType<typeof furniture>} Parts */

/**
 * Builds the view in every placeholder with this id.
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
  const motions = motionsOf(data),
    names = data.arms.length > 1 ? data.arms.map(arm => arm.name) : [],
    first = hidden(data);
  let shown = motions.choose(0, 0);

  function choose() {
    shown = motions.choose(state.value, state.choice);
    state.time = Math.min(state.time, shown.end);
    tell(parts, data, shown, state.value);
    ask();
  }
  /** @param {number} now */
  function draw(now) {
    clock.pass(now);
    sized(parts, inSpace, scene.bases ? 1 : data.arms.length);
    const moment = momentAt(data.times, state.time),
      {panels} = shown;
    for (const panel of panels) showAt(panel, moment);
    const arms = shown.arms.map((arm, k) => ({...armAt(arm, moment), past: pastNow(panels[0], k)}));
    scene.things = motions.things(shown.motion, moment.i, moment.share);
    clock.tell();
    const room = inSpace.draw(state.view, arms, `t = ${number(state.time, 2)} s`);
    const large = +parts.watch.value;
    overTime.draw({panels: panels.slice(first), large, names}, data.times, data.ticks, state.time);
    return room;
  }

  replaceStill(root, parts.frame, parts.scene, parts.curves);
  const ask = pictures(root, [parts.scene, parts.curves], draw); // also draws the first picture
  const clock = runningClock(parts, parts.frame, state, () => [data.times[0], shown.end], ask);
  const {slider, menu, watch} = parts;
  slider?.addEventListener("input", () => {
    state.value = +slider.value;
    choose();
  });
  menu?.addEventListener("change", () => {
    state.choice = +menu.value;
    choose();
  });
  watch.addEventListener("change", ask);
  orbit(parts.scene, scene, state, ask);
  scrubbing(parts.curves, event => clock.set(overTime.timeAt(event.offsetX)));
  reserve(parts, data);
  tell(parts, data, shown, state.value);
}

// --- The elements of the page --------------------------------------------------------------------

/** @param {Page} data */
function furniture(data) {
  const {slider, switch: menu, arms} = data,
    // it scrolls on a narrow screen, so the keyboard must reach it
    table = element("div", {
      class: "rk-table",
      tabindex: 0,
      role: "group",
      "aria-label": "greatest values",
    });
  const parts = {
    scene: sceneCanvas(data.scene, data.alt),
    curves: element("canvas", {
      class: "rk-curves",
      role: "img",
      "aria-label":
        `Curves over time of ${arms.map(arm => arm.name).join(" and ")}: ` +
        `${labelsOf(data).join(", ")}. The button "numbers" shows the greatest values.`,
    }),
    ...clockRow(),
    watch: choice("large panel", labelsOf(data)),
    table,
    says: element("div", {class: "rk-says"}),
    slider: slider && range(slider.label, slider.values.length - 1),
    value: element("span", {class: "rk-value"}),
    menu: menu && choice(menu.label, menu.values),
  };
  parts.watch.value = String(data.watch.panel - hidden(data));
  parts.row.append(element("label", {}, "watch", parts.watch), folding("numbers", table));
  // the controls are above the pictures, so that the slider and the arm are both visible on a small
  // screen
  const rows = [parts.row, parts.says];
  if (slider || menu) rows.unshift(element("div", {class: "rk-row"}));
  if (slider && parts.slider)
    rows[0].append(element("label", {class: "rk-long"}, slider.label, parts.slider, parts.value));
  if (menu && parts.menu) rows[0].append(element("label", {}, menu.label, parts.menu));
  // arms at the same place need no more width than one arm
  const {scene} = data,
    size = apart(scene) ? " rk-wide" : arms.length > 1 && !scene.bases ? " rk-several" : "";
  const frame = element(
    "div",
    {class: "rk rk-player", role: "group", "aria-label": data.title},
    element("div", {class: "rk-title"}, data.title),
    ...rows,
    element("div", {class: `rk-views${size}`}, parts.scene, parts.curves),
    table,
  );
  return {...parts, frame};
}

/** How many panels are hidden: those of the joints, if no joint is watched. @param {Page} data */
const hidden = ({watch, panels}) => (watch.joints?.length === 0 ? panels.length : 0);

/** The names of the panels. @param {Page} data */
const labelsOf = data =>
  [...data.panels, ...data.quantities].map(({label}) => label).slice(hidden(data));

/**
 * A button that shows and hides a part of the page; in print the part is always shown.
 * @param {string} name
 * @param {HTMLElement} part
 */
function folding(name, part) {
  const button = control(
    "button",
    {type: "button", class: "rk-word", "aria-label": name, "aria-expanded": "false"},
    name,
  );
  part.hidden = true;
  button.addEventListener("click", () => {
    part.hidden = !part.hidden;
    button.setAttribute("aria-expanded", String(!part.hidden));
  });
  return button;
}

/**
 * Sets the height of a full-width scene to the height that its arms fill.
 * @param {Pick<Parts, "scene" | "curves">} parts
 * @param {Pick<ReturnType<typeof sceneView>, "height">} inSpace
 * @param {number} count  the number of pictures in the scene
 */
function sized({scene, curves}, inSpace, count) {
  const width = scene.clientWidth,
    whole = scene.offsetTop !== curves.offsetTop;
  if (!width) return;
  const most = width > 640 ? 222 : count > 1 ? 420 : 320;
  scene.style.height = whole
    ? `${Math.round(Math.min(most, Math.max(190, inSpace.height(count, width))))}px`
    : "";
}

/**
 * Reserves room for the sentences of every motion, so that the pictures stay in place while a
 * slider moves.
 * @param {Parts} parts
 * @param {Page} data
 */
function reserve({says}, {arms}) {
  const lines = arms[0].speed.map((_, motion) =>
    arms.reduce((n, {via, notes}) => n + +!!via?.[motion] + (notes[motion] || []).length, 0),
  );
  says.style.minHeight = `${1.4 * Math.min(2, Math.max(...lines))}em`;
}

/**
 * Shows the numbers of a motion, as sentences and in the table.
 * @param {Parts} parts
 * @param {Page} data
 * @param {{arms: Track[], motion: number}} shown
 * @param {number} value  the index of the slider value
 */
function tell(parts, data, {arms, motion}, value) {
  const {slider} = data;
  /** @type {(arm: {name: string}) => string} */
  const whose = arm => (data.arms.length > 1 ? `${arm.name}: ` : "");
  const near = arms.flatMap(arm =>
    arm.near ? [`${whose(arm)}The path passes ${arm.near.text} from via.`] : [],
  );
  const notes = data.arms.flatMap(arm =>
    (arm.notes[motion] || []).map(text => element("li", {}, `${whose(arm)}${text} `)),
  );
  parts.says.replaceChildren(
    ...near.map(text => element("div", {}, `${text} `)),
    element("ul", {class: "rk-notes rk-alarm"}, ...notes),
  );
  parts.table.replaceChildren(numberTable(data, whose, motion));
  if (!slider) return;
  parts.value.textContent = number(slider.values[value], slider.decimals);
  parts.slider?.setAttribute("aria-valuetext", parts.value.textContent);
}

// --- The state at one moment ---------------------------------------------------------------------

/** @type {(times: number[], time: number) => Moment} */
function momentAt(times, time) {
  const i = times.findLastIndex((t, k) => !k || t <= time);
  // after the last sample there is no step, and the fraction is NaN
  return {i, share: (time - times[i]) / (times[i + 1] - times[i]) || 0};
}

/**
 * The arm for the scene. If there is no posture, the last posture before it is shown faded.
 * @param {Track} arm
 * @param {Moment} moment
 */
function armAt(arm, {i, share}) {
  const gap = arm.gaps.has(i);
  let q = arm.q(i, gap ? 0 : share);
  const faded = !q.every(Number.isFinite) || (gap && share > 0 && !arm.places[i + 1]);
  for (let back = i + 1; !q.every(Number.isFinite) && back--;) q = arm.q(back, 0);
  return {
    ...arm,
    q,
    faded,
    row: faded ? "" : arm.row(i),
    tail: [...broken(arm.places.slice(0, i + 1), arm.gaps), tipOf(arm.chain, q)],
  };
}

/**
 * @param {Panel} panel
 * @param {Moment} moment
 */
function showAt(panel, {i, share}) {
  for (const line of panel.lines) {
    const {values, gaps, steps} = line;
    line.now = values[i];
    if (share && !steps && !gaps.has(i)) line.now += share * (values[i + 1] - values[i]);
  }
}
