// The live views of robokin: what an arm answers to the sliders beside it. live.py sends one `picture` for every change:
// arrays of float64 and a few words.

import {origin} from "./kinematics.js";
import {number} from "./canvas.js";
import {sceneView} from "./scene.js";
import {element, orbit, pictures, sceneCanvas, STYLE} from "./controls.js";
import {start} from "./player.js";

const LIVE = `
.rk.rk.rk.rk-asked {
  & .rk-views { grid-template-columns: minmax(0, 1fr) 380px; gap: 14px; align-items: start; }
  & .rk-views.rk-broad { grid-template-columns: minmax(0, 1fr) 640px; }
  & canvas { height: clamp(340px, 40cqw, 480px); }
  & .rk-table { margin-top: 0; }
  & th:first-child { min-width: 0; white-space: nowrap; }
  & .rk-few td { padding: 5px 4px; width: 70px; }
  & .rk-few th { white-space: normal; padding-left: 0; }
  & thead th { vertical-align: bottom; white-space: normal; line-height: 1.2; }
  & .rk-many :is(th, td) { padding: 4px 5px; }
  & .rk-many :is(th, td):nth-child(-n+2) { text-align: left; }
  & .rk-many td:nth-child(2) { min-width: 7em; }
  & tr[aria-current=true] > * { background: var(--rk-chosen); font-weight: 650; color: var(--rk-ink); }
  & .rk-none > * { color: var(--rk-soft); }
  & .rk-past { color: var(--rk-alarm); text-decoration: underline 2px; text-underline-offset: 3px; }
  & .rk-says { margin: 8px 0 0; min-height: 2.8em; max-width: 62em; }
  & .rk-meant { margin: 8px 0 0; color: var(--rk-soft); max-width: 62em; }
  @container (max-width: 640px) { & .rk-views { grid-template-columns: minmax(0, 1fr); } }
  @container (max-width: 1060px) { & .rk-views.rk-broad { grid-template-columns: minmax(0, 1fr); } }
}`;

const floats = view => new Float64Array(view.buffer.slice(view.byteOffset, view.byteOffset + view.byteLength));
const row = (tag, attributes, ...cells) => element("tr", attributes,
  ...cells.map((cell, i) => cell instanceof Node ? cell
    : element(i && tag === "td" ? "td" : "th", tag === "th" ? {scope: "col"} : i ? {} : {scope: "row"}, cell)));

// One view of the model; every view draws the same pictures.
export function render({model, el}) {
  const root = element("div", {class: "robokin-live"});
  // The still picture is for readers without a kernel; while a live view stands in the page nobody needs it.
  el.append(element("style", {}, `[data-robokin-still="${model.get("still")}"] { display: none; }${LIVE}${model.get("stage").css}`), root);
  const stage = model.get("stage"), picture = () => model.get("picture");
  const show = (stage.kind === "motion" ? motionView : postureView)(root, stage, picture());
  const changed = () => show(picture());
  model.on("change:picture", changed);
  const helped = helpControls(root);
  return () => { model.off("change:picture", changed); helped.disconnect(); };
}

// A motion: the player, which takes every new motion in the place of the one before.
function motionView(root, stage, picture) {
  const data = ({page}) => ({...stage, ...page, scene: {...stage.scene, ...page.scene},
    arms: page.arms.map(arm => ({...arm, chain: stage.chain}))});
  const update = start(root, data(picture));
  return next => update(data(next));
}

// A posture, or all the postures that reach a target: the scene and a table.
function postureView(root, stage, first) {
  const {unit} = stage, scene = {...stage.scene, unit}, joints = stage.chain.length;
  const state = {view: [...scene.view]};
  const canvas = sceneCanvas(scene, stage.alt);
  const table = element("div", {class: `rk-table ${stage.kind === "target" ? "rk-many" : "rk-few"}`});
  const says = element("p", {class: "rk-says", role: "status"});
  root.replaceChildren(element("div", {class: "rk rk-asked", role: "group", "aria-label": stage.title},
    element("style", {}, STYLE), element("div", {class: "rk-title"}, stage.title),
    element("div", {class: `rk-views${stage.kind === "target" ? " rk-broad" : ""}`}, canvas,
      element("div", {}, table, says, element("p", {class: "rk-meant"}, stage.meant)))));
  const inSpace = sceneView(canvas, scene);
  const shown = stage.chain.map(link => link.prismatic ? unit.size : Math.PI / 180);

  let arm;
  function take(picture) {
    const q = floats(picture.q);
    arm = {name: stage.name, chain: stage.chain, trace: [], tail: [], q: [...q], ghosts: [], faded: picture.faded,
           framed: stage.kind === "joint"};
    says.textContent = picture.says;
    (stage.kind === "target" ? branches : numbers)(picture);
  }

  // One posture in numbers
  function numbers(picture) {
    const values = floats(picture.numbers);
    let at = 0;
    table.replaceChildren(element("table", {}, element("tbody", {}, ...stage.rows.map(([name, heads, decimals]) =>
      row("td", {}, name, ...heads.map(head => `${head} ${number(values[at++], decimals)}`))))));
  }

  // A row for each branch
  function branches(picture) {
    const rows = floats(picture.rows), past = floats(picture.past), near = floats(picture.near);
    const travel = floats(picture.travel);
    const pose = [...floats(picture.pose)];
    if (stage.oriented) scene.targets = [{name: "target", pose}];
    else scene.marks = [{name: "target", at: origin(pose), radius: 0}];
    const body = stage.branches.map((name, k) => {
      const q = [...rows.slice(k * joints, (k + 1) * joints)], exists = q.every(Number.isFinite);
      const over = j => past[k * joints + j] > 0, chosen = k === picture.chosen;
      if (exists && !chosen) arm.ghosts.push({q, past: q.some((_, j) => over(j))});
      const cells = q.map((value, j) => {
        const text = exists ? number(value / shown[j], 1) : "\u2013";
        return exists && over(j) ? element("td", {class: "rk-past", title: "past its limit"}, text) : text;
      });
      return row("td", chosen ? {"aria-current": "true"} : exists ? {} : {class: "rk-none"},
        `${chosen ? "\u25B6 " : "\u2003"}${name}`, picture.verdicts[k], ...cells,
        exists ? number(near[k], 3) : "\u2013", exists ? number(travel[k], 1) : "\u2013");
    });
    table.replaceChildren(element("table", {}, element("thead", {}, row("th", {}, ...stage.heads)),
                                  element("tbody", {}, ...body)));
  }

  const ask = pictures(root, [canvas], () => inSpace.draw(state.view, [arm], "")); // also draws the first picture
  orbit(canvas, scene, state, ask);
  take(first);
  return picture => { take(picture); ask(); };
}

// What ipywidgets leaves open: a screen reader needs the name of a slider on its handle, and its value as it is written
// (not 0.30000000000000004); Notebook 7 takes arrow keys for itself unless the very element with the focus forbids it.
function helpControls(root) {
  const help = () => {
    const explorer = root.closest(".robokin-explorer");
    if (!explorer) return; // taken out of the page meanwhile
    for (const slider of explorer.querySelectorAll(".widget-slider")) {
      const [name, handle, value] = ["label", "[role=slider]", ".widget-readout"].map(part => slider.querySelector(part));
      if (!name || !handle || !value) continue;
      for (const part of [handle, value]) {
        part.setAttribute("aria-label", name.textContent);
        part.dataset.lmSuppressShortcuts = "true";
      }
      value.setAttribute("role", "textbox");
      const text = value.textContent;
      if (handle.getAttribute("aria-valuetext") !== text) handle.setAttribute("aria-valuetext", text);
    }
    for (const menu of explorer.querySelectorAll(".widget-dropdown select")) menu.dataset.lmSuppressShortcuts = "true";
  };
  const watch = new MutationObserver(help);
  // The view stands in the page only after `render`; the sliders may come later still.
  const wait = new ResizeObserver(() => {
    const explorer = root.closest(".robokin-explorer");
    if (!explorer) return;
    wait.disconnect();
    help();
    watch.observe(explorer.firstElementChild, {childList: true, subtree: true, attributeFilter: ["aria-valuetext"]});
  });
  wait.observe(root);
  return {disconnect() { wait.disconnect(); watch.disconnect(); }};
}
