// Sliders. The mouse and the keyboard move a slider in the usual way. For a finger, a browser would
// move the slider as soon as the finger touches it, even if the finger is about to scroll the page.
// So this module moves it instead, if the finger drags sideways or taps.

import {control} from "./elements.js";

const SLOP = 8; // px: a finger that has moved less than this has no direction yet
const THUMB = 16; // px: the width of a slider's thumb
const FINEST = 5; // steps: the most that a slider moves when the finger moves by one pixel

/**
 * @param {string} name
 * @param {number} most
 * @param {number} [least]
 * @param {number} [step]
 */
export function range(name, most, least = 0, step = 1) {
  const bounds = {min: least, max: most, step, value: least};
  const node = control("input", {type: "range", ...bounds, "aria-label": name});
  followFinger(node);
  return node;
}

/**
 * A finger on a slider.
 * @typedef {object} Finger
 * @property {number} x  where it was last
 * @property {number} y
 * @property {number} value  the value that its drag has reached, not rounded to a step
 * @property {number} before  the value when it touched the slider
 * @property {number} under  the value at its place, to which the browser moved the slider
 * @property {?boolean} drags  whether it moves sideways; null if it has no direction yet
 */

/**
 * Lets a finger drag a slider. The drag is relative, so that the slider does not jump to the finger
 * and can move in fine steps.
 * @param {HTMLInputElement} node
 */
function followFinger(node) {
  /** @type {?Finger} */
  let finger = null;
  /** @type {(finger: Finger, value: number) => void} */
  const show = (finger, value) => {
    const before = node.value;
    node.valueAsNumber = finger.value = value;
    if (node.value !== before) node.dispatchEvent(new Event("input", {bubbles: true}));
  };
  node.addEventListener("pointerdown", ({pointerType, clientX: x, clientY: y}) => {
    const value = +node.value,
      touched = {x, y, value, before: value, under: value, drags: null};
    finger = pointerType === "touch" ? touched : null;
  });
  node.addEventListener("pointermove", ({clientX, clientY}) => {
    if (!finger) return;
    const dx = clientX - finger.x,
      [right, down] = [dx, clientY - finger.y].map(Math.abs);
    if (finger.drags) show(finger, dragged(node, finger.value, dx));
    else if (finger.drags === null && Math.max(right, down) > SLOP) finger.drags = right > down;
    if (finger.drags !== null) finger.x = clientX;
  });
  for (const end of ["pointerup", "pointercancel"])
    node.addEventListener(end, ({type}) => {
      const held = finger;
      if (!held) return;
      if (type === "pointercancel") show(held, held.before);
      else if (held.drags === null) show(held, held.under);
      node.dispatchEvent(new Event("change", {bubbles: true}));
      // after the events with which the browser ends the touch
      setTimeout(() => {
        if (finger === held) finger = null;
      });
    });
  // undo only changes that the browser makes during the touch, not those made by keys or scripts
  const undo = (/** @type {Event} */ event) => {
    if (!finger || !event.isTrusted) return;
    if (finger.drags === null) finger.under = +node.value;
    node.valueAsNumber = finger.value;
    event.stopImmediatePropagation();
  };
  node.addEventListener("input", undo, true);
}

/**
 * The value of a slider after a finger has moved by dx pixels.
 * @param {HTMLInputElement} node
 * @param {number} value
 * @param {number} dx
 */
function dragged(node, value, dx) {
  const [least, most, step] = [+node.min, +node.max, +node.step],
    perPixel = Math.min((most - least) / (node.clientWidth - THUMB), FINEST * step);
  return Math.min(most, Math.max(least, value + perPixel * dx));
}
