// Schedules the redraws of the canvases of a view.

import {colors, readColors} from "./canvas.js";

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
  }; // draws immediately, since printing does not wait
  function look() {
    if (root.isConnected) {
      readColors(canvases[0]); // inside .rk, which defines the colours
      theme.observe(document.body, {attributeFilter: ["data-jp-theme-light"]});
      for (const one of media) one.addEventListener("change", turned);
      ask();
    } else {
      // `root` has been removed; if it is inserted again, its canvases get a size again
      theme.disconnect();
      for (const one of media) one.removeEventListener("change", turned);
    }
  }
  // When observed again, a canvas is reported once it has a size, even if its size is unchanged.
  function watch() {
    for (const canvas of canvases) {
      sizes.unobserve(canvas);
      sizes.observe(canvas);
    }
  }
  watch();
  return ask;
}
