// Handles for dragging things in a scene. They are buttons over the canvas, so that touching one
// does not scroll the page, the keyboard can reach it, and a screen reader can name it.

import {cross, dot, plus} from "./kinematics.js";
import {handleChooser, large} from "./chooser.js";
import {element, control} from "./elements.js";

/** @import {Color, Pixel, Point, Ring} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */

/**
 * The distance in metres between a thing and the arrows and arcs that move it, for a camera. In
 * pixels it is the same at every scale.
 * @param {Camera} camera
 */
export const reachOf = camera => (large() ? 84 : 60) / camera.scale;

/** @typedef {(dx: number, dy: number) => void} Drag  called with the motion of a pointer in px */
/**
 * @typedef {object} Handle
 * @property {string} id
 * @property {string} [group]  its group; where there is no room for all handles, one group is shown
 * @property {string} name  its name for a screen reader: "target along x"
 * @property {string} look  the class of the button: rk-free, rk-arrow, rk-arc or rk-joint
 * @property {string} [mark]  a letter on it
 * @property {Color} [color]  a colour name of palette.py
 * @property {(camera: Camera) => Point} at  its place
 * @property {() => string} value  its current value, as text
 * @property {(camera: Camera) => Drag} grab  called when it is grabbed; returns a function to be
 *   called with the displacement of the pointer since then
 * @property {(right: number, up: number, big: boolean) => void} step  reacts to an arrow key
 * @property {() => void} home  moves it back to where it began
 * @property {() => void} [tap]  reacts to a tap, a click, Enter and Space
 * @property {(layer: HTMLElement, focused: boolean) => void} [tell]  writes on the layer
 */
/** @typedef {ReturnType<typeof handleLayer>} HandleLayer */

/** @typedef {Handle & {node: HTMLElement, shift: Pixel}} Shown  `shift` is its offset */
/**
 * The callbacks of the buttons in a layer.
 * @typedef {object} Hand
 * @property {() => Camera} camera  the camera of the last picture
 * @property {(id: ?string) => void} hold  called with the id of the grabbed handle; or with null
 *   when it is released
 * @property {() => void} changed  called when something has moved
 */

/**
 * A layer of handles over a canvas.
 * @param {HTMLElement} canvas
 * @param {() => Camera} camera  the camera of the last picture
 * @param {(held: boolean) => void} hold  called when a handle is grabbed, and when it is released
 * @param {() => void} changed  called when something has moved
 */
export function handleLayer(canvas, camera, hold, changed) {
  const layer = element("div", {class: "rk-handles"}),
    chooser = handleChooser(changed);
  /** @type {Shown[]} */
  let handles = [];
  /** @type {?string} */
  let held = null;
  /** @type {Hand} */
  const hand = {
    camera,
    changed,
    hold(id) {
      held = id;
      hold(id !== null);
    },
  };
  for (const event of ["focusin", "focusout"]) layer.addEventListener(event, changed);

  return {
    layer,
    chooser: chooser.row,
    /** @param {Handle[]} next */
    set(next) {
      chooser.set(next.map(({group = ""}) => group));
      handles = next.map(handle => ({...handle, node: button(handle, hand), shift: [0, 0]}));
      layer.replaceChildren(...handles.map(handle => handle.node));
    },
    /** For one drawing: a function that returns whether there is room for handle k. */
    shown() {
      chooser.update(canvas.clientWidth);
      return (/** @type {number} */ k) => !!chooser.stands(handles[k].group ?? "");
    },
    /**
     * Moves the handles to their places; call it after every redraw.
     * @param {Camera} [cam]
     * @returns {Ring[]}  the boxes that they cover, in the order of the handles
     */
    place(cam = camera()) {
      /** @type {Pixel[]} */
      const taken = [],
        big = large();
      // asked once: after a button has moved, the browser would have to lay out the page again
      const {clientWidth: width, clientHeight: height} = canvas;
      chooser.update(width);
      for (const {node, group = ""} of handles) node.hidden = !chooser.stands(group);
      // The grabbed handle keeps its offset, so that it stays under the pointer; the others make
      // room.
      const seen = handles.filter(({node}) => !node.hidden),
        first = [...seen].sort((a, b) => Number(b.id === held) - Number(a.id === held));
      for (const handle of first)
        taken.push(placed(handle, cam, handle.id === held ? null : taken, [width, height], big));
      for (const {node, tell} of handles) tell?.(layer, node.matches(":focus"));
      const size = big ? 32 : 26; // as drawn
      return seen.map(handle => {
        const [x, y] = taken[first.indexOf(handle)];
        return [x - size / 2, y - size / 2, size, size, handle.mark];
      });
    },
  };
}

/**
 * @param {Handle} handle
 * @param {Hand} hand
 */
function button(handle, {camera, hold, changed}) {
  const node = control(
    "button",
    {type: "button", class: `rk-handle ${handle.look}`, "data-handle": handle.id},
    handle.mark || "",
  );
  if (handle.color) node.style.setProperty("--own", `var(--rk-${handle.color})`);
  let from = [0, 0],
    tapped = false;
  /** @type {?Drag} */
  let move = null;
  node.addEventListener("pointerdown", event => {
    event.preventDefault(); // prevents text selection and scrolling
    node.focus();
    node.setPointerCapture(event.pointerId);
    [from, move] = [[event.clientX, event.clientY], handle.grab(camera())];
    tapped = !!handle.tap;
    hold(handle.id);
  });
  node.addEventListener("pointermove", event => {
    if (!move) return;
    const dx = event.clientX - from[0],
      dy = event.clientY - from[1];
    if (tapped && Math.hypot(dx, dy) <= TAP) return;
    tapped = false;
    move(dx, dy);
    changed();
  });
  const drop = () => {
    if (!move) return;
    move = null;
    hold(null);
    changed();
  };
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
    node.addEventListener(end, drop);
  // the detail of a click is 0 if it was caused by the keyboard
  node.addEventListener("click", event => {
    if (tapped || !event.detail) handle.tap?.();
  });
  node.addEventListener("dblclick", () => {
    if (handle.tap) return; // two taps
    handle.home();
    changed();
  });
  node.addEventListener("keydown", event => {
    const way = STEPS[event.key];
    if (event.key === "Home") handle.home();
    else if (way) handle.step(...way, event.shiftKey);
    else return;
    event.preventDefault();
    event.stopPropagation();
    changed();
  });
  return node;
}

/**
 * Puts a button at the place of its handle. If this place is outside the scene, the button is at
 * the edge, where it can still be dragged.
 * @param {Shown} handle
 * @param {Camera} camera
 * @param {?Pixel[]} taken  the places to avoid; null if the handle is held
 * @param {Pixel} size  of the scene
 * @param {boolean} big  whether the buttons are large
 */
function placed(handle, camera, taken, [width, height], big) {
  const {node, name, look, at, value, shift} = handle,
    p = at(camera),
    place = camera.to(p),
    [px, py] = place,
    radius = big ? 22 : 13,
    room = big ? 40 : 25,
    half = look === "rk-free" ? 6 : radius; // a double ring stands on its point
  /** @type {(place: Pixel) => Pixel} */
  const inside = ([x, y]) => [
    Math.min(Math.max(x, half), width - half),
    Math.min(Math.max(y, half), height - half - SCALE_ROOM),
  ];
  node.hidden = !p.every(Number.isFinite);
  /** @type {Pixel} */
  const [x, y] = taken ? apart(place, taken, room, inside) : [px + shift[0], py + shift[1]];
  handle.shift = [x - px, y - py];
  const [left, top] = inside([x, y]);
  const seen = px > 0 && px < width && py > 0 && py < height;
  node.classList.toggle("rk-outside", !seen);
  node.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
  // a line leads to the place from a button that is too far from it
  const [dx, dy] = [px - left, py - top],
    far = Math.hypot(dx, dy),
    turn = `rotate(${Math.atan2(dy, dx)}rad) translate(13px)`;
  node.style.setProperty("--led", `${turn} scaleX(${seen && far > LED ? far - 13 : 0})`);
  const says = `${name}, ${value()}`;
  if (node.getAttribute("aria-label") !== says) node.setAttribute("aria-label", says);
  return /** @type {Pixel} */ ([x, y]);
}

const SCALE_ROOM = 20; // px: the scale of the grid stands below all handles
const LED = 16; // px: a button this far from its place has a line to it
const TAP = 4; // px: a pointer movement shorter than this counts as a tap
/** @type {Object<string, [number, number]>} */
const STEPS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

/**
 * A place inside the scene and at least `room` pixels away from the places already taken.
 * @param {Pixel} place
 * @param {Pixel[]} taken
 * @param {number} room
 * @param {(place: Pixel) => Pixel} inside  moves a place into the scene
 * @returns {Pixel}
 */
function apart(place, taken, room, inside) {
  /** @type {(place: Pixel) => Pixel | undefined} */
  const nearTo = ([x, y]) => taken.find(([a, b]) => Math.hypot(x - a, y - b) < 0.99 * room);
  let [x, y] = inside(place);
  for (let i = 0; i < 8; i++) {
    const near = nearTo([x, y]);
    if (!near) return [x, y];
    const [dx, dy] = [x - near[0] || 1, y - near[1] || i - 3],
      length = Math.hypot(dx, dy);
    [x, y] = inside([near[0] + (room * dx) / length, near[1] + (room * dy) / length]);
  }
  // in a corner of the scene, the edges push the handle back, so it takes the nearest free place
  for (let far = room; far < 5 * room; far += room / 2)
    for (let k = 0; k < 12; k++) {
      const angle = (k * Math.PI) / 6;
      const free = inside([x + far * Math.cos(angle), y + far * Math.sin(angle)]);
      if (!nearTo(free)) return free;
    }
  return [x, y];
}

/**
 * A drag that changes one number, whose handle moves along a curve. The handle stays at the point
 * of the curve that is nearest to the pointer on the screen.
 * @param {Camera} camera
 * @param {(value: number) => Point} place  the place of the handle for a value
 * @param {number} value  its value at the start
 * @param {number} step  a small change of the value
 * @returns {(dx: number, dy: number) => number}  the value after this displacement of the pointer
 */
export function alongCurve(camera, place, value, step) {
  const start = camera.to(place(value));
  let now = value;
  return (dx, dy) => {
    const wanted = [start[0] + dx, start[1] + dy];
    // Newton steps to the point of the curve that is nearest to the pointer. No step is made where
    // the curve points at the camera. The steps include the curvature; without it, they would
    // oscillate if the pointer is far outside a ring.
    for (let i = 0; i < 40; i++) {
      const [before, here, after] = [-step, 0, step].map(x => camera.to(place(now + x)));
      const along = [0, 1].map(k => (after[k] - before[k]) / (2 * step));
      const bend = [0, 1].map(k => (after[k] - 2 * here[k] + before[k]) / (step * step));
      const off = [0, 1].map(k => wanted[k] - here[k]),
        length = along[0] ** 2 + along[1] ** 2;
      if (length < MOVES ** 2) break;
      const rise = length - off[0] * bend[0] - off[1] * bend[1];
      const way = (off[0] * along[0] + off[1] * along[1]) / (rise > 0.1 * length ? rise : length);
      now += Math.max(-20 * step, Math.min(20 * step, way));
      if (Math.abs(way) < 0.01 * step) break;
    }
    return now;
  };
}
// px on the screen per unit of the value: below this, the curve points at the camera
const MOVES = 5;

/**
 * A drag that moves a point freely in the plane of the screen.
 * @param {Camera} camera
 * @param {Point} place  its place at the start
 * @returns {(dx: number, dy: number) => Point}
 */
export const inScreen = (camera, place) => (dx, dy) => plus(place, camera.across(dx, dy));

/**
 * A vector perpendicular to `axis`, and one perpendicular to both.
 * @param {number[]} axis
 * @returns {number[][]}
 */
export function squareTo(axis) {
  const least = axis.map(Math.abs).indexOf(Math.min(...axis.map(Math.abs)));
  const other = [0, 1, 2].map(k => Number(k === least));
  const a = plus(other, axis, -dot(other, axis)),
    length = Math.sqrt(dot(a, a));
  const first = a.map(x => x / length);
  return [first, cross(axis, first)];
}
