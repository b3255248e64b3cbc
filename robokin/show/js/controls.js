// Lets a reader turn the view of a canvas by dragging, or choose a time on a canvas.

import {control} from "./elements.js";

/** @import {PageScene} from "./page.js" */

/**
 * The name of a scene for a screen reader.
 * @param {Pick<PageScene, "flat">} scene
 * @param {string} alt
 */
export const spoken = ({flat}, alt) =>
  alt + (flat === null ? " Arrow keys turn the view, Home resets it." : "");

/**
 * @param {Pick<PageScene, "flat">} scene
 * @param {string} alt
 */
export const sceneCanvas = (scene, alt) =>
  control("canvas", {
    class: `rk-scene${scene.flat === null ? "" : " rk-flat"}`,
    role: "img",
    tabindex: 0,
    "aria-label": spoken(scene, alt),
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
