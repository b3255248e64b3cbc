// The clock of a motion: a button, a time slider, a menu of playback speeds, and the Space key.

import {number} from "./canvas.js";
import {choice, control, element} from "./elements.js";
import {range} from "./sliders.js";

const PLAY = "M3 1.5v11l9-5.5z",
  PAUSE = "M3 1.5h3v11H3zM8 1.5h3v11H8z";
const TICKS = 400,
  SPEEDS = [0.25, 0.5, 1, 2, 4];

/**
 * The visible parts of a clock: a row of the page, and its elements.
 * @typedef {ReturnType<typeof clockRow>} ClockParts
 */
/** @typedef {ReturnType<typeof runningClock>} Clock */

/**
 * @param {?{play: string, pause: string}} [names]  the button text; without it, there is an icon
 */
export function clockRow(names = null) {
  const icon = element("span"),
    scrub = range("time", TICKS),
    time = element("span", {class: "rk-value"});
  const speed = choice(
    "playback speed",
    SPEEDS.map(each => `${each}\u00D7`),
  );
  const kind = names ? "rk-word" : "rk-sign";
  const button = control(
    "button",
    {type: "button", class: kind, title: "play or pause (Space)"},
    icon,
  );
  speed.selectedIndex = SPEEDS.indexOf(1);
  const row = element(
    "div",
    {class: "rk-row rk-clock"},
    button,
    element("label", {class: "rk-long"}, scrub, time),
    element("label", {}, "playback", speed),
  );
  return {names, icon, scrub, time, speed, button, row};
}

/**
 * Runs a clock. `pass(now)` advances the time, `set(time)` goes to this time and stops, and
 * `tell()` shows the time on the page.
 * @param {ClockParts} parts
 * @param {HTMLElement} frame  the element in which the Space key plays and pauses
 * @param {{time: number, playing: boolean}} state
 * @param {() => [number, number]} span  first and last time
 * @param {() => void} ask  requests a new picture
 * @param {() => number} [pace]  seconds of `state.time` per second
 */
export function runningClock(parts, frame, state, span, ask, pace = () => 1) {
  let before = 0;
  /** @param {boolean} on */
  function run(on) {
    const [begin, end] = span();
    state.playing = on;
    if (on && state.time >= end) state.time = begin;
    before = performance.now();
    tellPlaying(parts, on);
    if (on) ask();
  }
  /** @param {number} now */
  function pass(now) {
    if (!state.playing) return;
    const end = span()[1];
    // The first time stamp may be before the click. A view that was hidden for a while continues
    // where it was.
    const passed = Math.min(500, Math.max(0, now - before)) / 1000;
    state.time = Math.min(end, state.time + passed * pace() * SPEEDS[+parts.speed.value]);
    before = Math.max(before, now);
    if (state.time >= end) run(false);
    else ask();
  }
  /** @param {number} time */
  function set(time) {
    const [begin, end] = span();
    run(false);
    state.time = Math.min(end, Math.max(begin, time));
    ask();
  }
  function tell() {
    const [begin, end] = span();
    tellPlaying(parts, state.playing);
    parts.time.textContent = `${number(state.time, 2)} s`;
    parts.scrub.value = String(Math.round((state.time - begin) / ((end - begin) / TICKS || 1)));
    parts.scrub.setAttribute("aria-valuetext", parts.time.textContent);
  }
  parts.button.addEventListener("click", () => run(!state.playing));
  parts.scrub.addEventListener("input", () => {
    const [begin, end] = span();
    set(begin + (+parts.scrub.value * (end - begin)) / TICKS);
  });
  frame.addEventListener("keydown", event => {
    if (
      event.key !== " " ||
      ["BUTTON", "SELECT"].includes(/** @type {Element} */ (event.target).tagName)
    )
      return;
    event.preventDefault();
    run(!state.playing);
  });
  run(false);
  return {pass, set, tell};
}

/**
 * @param {ClockParts} parts
 * @param {boolean} on
 */
function tellPlaying({names, icon, button}, on) {
  const name = on ? "pause" : "play";
  if (button.dataset.does === name) return;
  button.dataset.does = name;
  if (names) icon.textContent = names[name];
  else {
    icon.innerHTML =
      '<svg width="14" height="14" viewBox="0 0 14 14" aria-hidden="true">' +
      `<path d="${on ? PAUSE : PLAY}"/></svg>`;
    button.setAttribute("aria-label", name);
  }
}
