// What surrounds the canvases: dragging the view, and when to draw again.

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
 * Pressing and dragging on a canvas; `first` at the press.
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
