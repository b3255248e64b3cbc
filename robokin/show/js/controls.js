// Canvases: turning the view by dragging, and scheduling redraws.

import {colors, readColors} from "./canvas.js";
import {control} from "./elements.js";

/** @import {PageScene} from "./page.js" */

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
 * Lets dragging and arrow keys turn state.view, and Home and a double click reset it; `ask`
 * requests a new picture.
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
 * Calls `take` when the pointer is pressed or dragged on a canvas; `first` is true for the press.
 * @param {HTMLCanvasElement} canvas
 * @param {(event: PointerEvent, first: boolean) => void} take
 */
export function scrubbing(canvas, take) {
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    take(event, true);
  });
  canvas.addEventListener("pointermove", event => {
    if (canvas.hasPointerCapture(event.pointerId)) take(event, false);
  });
}

/**
 * Draws once before the next frame of the screen after `ask()`, after a canvas has changed its
 * size, and after the theme has changed (with the new `colors`), but not while `root` is outside
 * the page.
 * @param {HTMLElement} root
 * @param {HTMLCanvasElement[]} canvases
 * @param {(now: number) => boolean|void} draw  returns false if there was no room; it is called
 *   again as soon as there is room
 * @returns {() => void} ask
 */
export function pictures(root, canvases, draw) {
  let asked = 0;
  const ask = () => {
    if (!asked)
      asked = requestAnimationFrame(now => {
        asked = 0;
        if (!root.isConnected) return;
        if (!colors.ink) readColors(canvases[0]); // `ask` was called before any canvas had a size
        if (draw(now) === false) watch();
      });
  };
  const media = ["(prefers-color-scheme: dark)", "print"].map(query => matchMedia(query));
  const theme = new MutationObserver(look),
    sizes = new ResizeObserver(look);
  const turned = () => {
    look();
    if (root.isConnected) draw(performance.now());
  }; // draws at once, since printing does not wait
  function look() {
    if (root.isConnected) {
      readColors(canvases[0]); // inside .rk, which defines the colours
      theme.observe(document.body, {attributeFilter: ["data-jp-theme-light"]});
      for (const one of media) one.addEventListener("change", turned);
      ask();
    } else {
      // `root` is removed; if it is inserted again, its canvases get a size again
      theme.disconnect();
      for (const one of media) one.removeEventListener("change", turned);
    }
  }
  // When observed again, a canvas is reported as soon as it has a size, even its previous one.
  function watch() {
    for (const canvas of canvases) {
      sizes.unobserve(canvas);
      sizes.observe(canvas);
    }
  }
  watch();
  return ask;
}
