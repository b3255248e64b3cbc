// What surrounds the canvases: the style sheet, dragging the view, and when to draw again.

import {colors, FONT, readColors} from "./canvas.js";
import {control} from "./elements.js";

/** @import {PageScene} from "./page.js" */

/**
 * Colours are those of palette.py. JupyterLab styles tables, labels and buttons of its own:
 * .rk.rk.rk outdoes it.
 */
export const STYLE = `
.rk.rk.rk { box-sizing: border-box; background: var(--rk-paper); color: var(--rk-ink);
  border: 1px solid var(--rk-border);
  border-radius: 8px; padding: 10px 14px; font: 13px/1.4 ${FONT}; container-type: inline-size;
  max-width: 1400px;
  & * { box-sizing: border-box; }
  & .rk-title { font-weight: 650; font-size: 15px; margin: 0 0 6px; }
  & .rk-views { display: grid; grid-template-columns: minmax(0, 9fr) minmax(0, 10fr); gap: 8px; }
  & .rk-views.rk-wide { grid-template-columns: minmax(0, 1fr); }
  & canvas { display: block; width: 100%; height: clamp(380px, 48cqw, 450px); border-radius: 4px;
    margin: 0; }
  & .rk-wide .rk-curves { height: 300px; }
  & .rk-scene { cursor: grab; touch-action: pan-y; }
  & .rk-scene.rk-flat { cursor: default; }
  & .rk-curves { cursor: crosshair; touch-action: pan-y; }
  & .rk-row { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; margin-top: 8px; }
  & .rk-row label { display: flex; align-items: center; gap: 8px; color: var(--rk-ink); margin: 0;
    font: inherit; }
  & .rk-row label.rk-long { flex: 1 1 240px; min-width: 0; }
  & input[type=range] { flex: 1; min-width: 60px; width: 100%; margin: 0; height: 24px;
    accent-color: var(--rk-accent);
    cursor: pointer; }
  & .rk-value { min-width: 4.6em; text-align: right; font-variant-numeric: tabular-nums;
    white-space: nowrap; }
  & button, & select { font: inherit; color: var(--rk-ink); background: var(--rk-button);
    border: 1px solid var(--rk-rest);
    border-radius: 6px; height: 30px; padding: 0 8px; margin: 0; cursor: pointer; }
  & button { width: 42px; }
  & button:hover, & select:hover { background: var(--rk-hover); }
  & button svg { display: block; margin: auto; fill: currentColor; }
  & :focus-visible { outline: 3px solid var(--rk-accent); outline-offset: 2px; }
  & .rk-table { overflow-x: auto; margin-top: 10px; }
  & table { border-collapse: collapse; width: 100%; margin: 0; font: inherit; color: var(--rk-ink);
    border: 0;
    table-layout: auto; }
  & tr { background: none; border: 0; }
  & th, & td { padding: 4px 5px; text-align: right; border: 0;
    border-top: 1px solid var(--rk-grid); font-weight: 400;
    font-variant-numeric: tabular-nums; white-space: nowrap; background: none; max-width: none;
    line-height: 1.3; }
  & thead th { border-top: 0; color: var(--rk-soft); }
  & th:first-child { text-align: left; color: var(--rk-soft); white-space: normal;
    min-width: 14.5em; padding-left: 0; }
  & .rk-jump { color: var(--rk-alarm); }
  & .rk-notes { margin: 6px 0 0; padding: 0; list-style: none; color: var(--rk-alarm);
    min-height: 0; }
  & .rk-notes li { margin: 2px 0; padding: 0; }
  @container (max-width: 640px) {
    & .rk-views { grid-template-columns: minmax(0, 1fr); }
    & canvas, & .rk-wide .rk-curves { height: 340px; }
    & th, & td { padding: 3px 4px; font-size: 11.5px; white-space: normal; }
    & th:first-child { min-width: 6.5em; }
  }
  @media print {
    & { border: 0; break-inside: avoid; }
    & .rk-clock, & input { display: none; }
    & .rk-row label.rk-long { flex: none; }
    & .rk-value { min-width: 0; }
    & select { appearance: none; background: none; border: 0; padding: 0; }
  }
}`;

/**
 * @param {Pick<PageScene, "flat">} scene
 * @param {string} alt
 */
export const sceneCanvas = (scene, alt) =>
  control("canvas", {
    class: `rk-scene${scene.flat === null ? "" : " rk-flat"}`,
    role: "img",
    tabindex: 0,
    "aria-label": alt + (scene.flat === null ? " Arrow keys turn the view, Home resets it." : ""),
  });

/** @type {Object<string, [number, number]>} */
const KEYS = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

/**
 * Dragging, arrow keys, Home and a double click turn state.view; `ask` gets it drawn.
 * @param {HTMLCanvasElement} canvas
 * @param {Pick<PageScene, "flat" | "view">} scene
 * @param {{view: number[]}} state  azimuth and elevation
 * @param {() => void} ask
 */
export function orbit(canvas, scene, state, ask) {
  if (scene.flat !== null) return;
  /** @type {(dx: number, dy: number) => void} */
  const turn = (dx, dy) => {
    state.view = [state.view[0] - dx, Math.min(1.57, Math.max(-0.3, state.view[1] + dy))];
    ask();
  };
  const reset = () => {
    state.view = [...scene.view];
    ask();
  };
  let grip = [0, 0];
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    grip = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointermove", event => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    turn((event.clientX - grip[0]) / 120, (event.clientY - grip[1]) / 120);
    grip = [event.clientX, event.clientY];
  });
  canvas.addEventListener("dblclick", reset);
  canvas.addEventListener("keydown", event => {
    if (event.key in KEYS) turn(-KEYS[event.key][0] * 0.08, KEYS[event.key][1] * 0.08);
    else if (event.key === "Home") reset();
    else return;
    event.preventDefault();
  });
}

/**
 * When to draw: once before the next picture of the screen after `ask()`, after one of the canvases
 * has got another size, and after the theme has changed (then `colors` has the new ones). Nothing
 * while `root` is not in the page.
 * @param {HTMLElement} root
 * @param {HTMLCanvasElement[]} canvases
 * @param {(now: number) => boolean|void} draw  false: there was no room. It is called again as soon
 *   as there is
 * @returns {() => void} ask
 */
export function pictures(root, canvases, draw) {
  let asked = 0;
  const ask = () => {
    if (!asked)
      asked = requestAnimationFrame(now => {
        asked = 0;
        if (!root.isConnected) return;
        if (!colors.ink) readColors(canvases[0]); // asked for before any canvas has told its size
        if (draw(now) === false) watch();
      });
  };
  const media = ["(prefers-color-scheme: dark)", "print"].map(query => matchMedia(query));
  const theme = new MutationObserver(look),
    sizes = new ResizeObserver(look);
  const turned = () => {
    look();
    if (root.isConnected) draw(performance.now());
  }; // paper does not wait
  function look() {
    if (root.isConnected) {
      readColors(canvases[0]); // inside .rk, which has them
      theme.observe(document.body, {attributeFilter: ["data-jp-theme-light"]});
      for (const one of media) one.addEventListener("change", turned);
      ask();
    } else {
      // taken out; if it is put back, its canvases get a size again
      theme.disconnect();
      for (const one of media) one.removeEventListener("change", turned);
    }
  }
  // Observed anew, a canvas is reported as soon as it has a size, even one that it had before.
  function watch() {
    for (const canvas of canvases) {
      sizes.unobserve(canvas);
      sizes.observe(canvas);
    }
  }
  watch();
  return ask;
}
