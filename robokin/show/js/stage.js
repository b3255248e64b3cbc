// The common parts of all explorers: the frame in the page, the picture, sliders, tables.

import {frames, origin, plus, turned} from "./kinematics.js";
import {clear, colors, jointColor, number, replaceStill, shape, stroke} from "./canvas.js";
import {sceneOf, sceneView} from "./scene.js";
import {orbit, sceneCanvas, spoken} from "./controls.js";
import {pictures} from "./pictures.js";
import {control, element} from "./elements.js";
import {handleLayer} from "./handles.js";
import {range} from "./sliders.js";

/** @import {Control, PageExplorer} from "./page.js" */
/** @import {Context} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Draw, Shown} from "./scene.js" */

/**
 * An arm of an explorer; the first one shows the axes of all its joints or of those listed, and the
 * semi-axes of the ellipsoid of tool velocities, if it has them.
 * @typedef {Shown & {axes?: boolean | number[], ellipsoid?: number[][]}} Explored
 */
/** @typedef {ReturnType<typeof stageOf>} Stage */
/**
 * How a frame draws the state `seen`.
 * @template Seen
 * @typedef {object} Picture
 * @property {HTMLCanvasElement} canvas
 * @property {(seen: Seen) => boolean} draw  returns whether there was room
 * @property {() => Camera} camera  the camera of the last picture
 * @property {(on: boolean) => void} hold  called when a handle is grabbed, and when it is released
 */

/**
 * The frame of an explorer whose picture is a scene of arms. `name(alt)` changes the name of the
 * scene for a screen reader.
 * @param {HTMLElement} root
 * @param {PageExplorer} data
 */
export function stageOf(root, data) {
  const scene = sceneOf(data),
    state = {view: [...scene.view]};
  const canvas = sceneCanvas(scene, data.alt),
    view = sceneView(canvas, scene),
    camera = () => view.cameras()[0];
  const stage = frameOf(root, data, {
    canvas,
    camera,
    hold: view.hold,
    /** @type {(arms: Explored[]) => boolean} */
    draw([arm, ...more]) {
      /** @type {Draw} */
      const over = (g, cam) => {
        arm.over?.(g, cam);
        drawAids(g, cam, arm, scene.size);
      };
      return view.draw(state.view, [{...arm, over, handles: stage.handles.place}, ...more], "");
    },
  });
  orbit(canvas, scene, state, stage.ask);
  /** @param {string} alt */
  const name = alt => canvas.setAttribute("aria-label", spoken(scene, alt));
  return {...stage, scene, name};
}

/**
 * The frame of an explorer: a picture with handles over it, a column of controls next to it, and
 * room below.
 *
 * run(answer)  from now on, calls `answer(now)` for the state to draw, once for every picture after
 *              a change
 * changed()    reports a change
 * ask()        asks for the same state to be drawn again
 *
 * @template Seen
 * @param {HTMLElement} root
 * @param {{kind: string, title: string, meant: string}} data
 * @param {Picture<Seen>} picture
 */
export function frameOf(root, data, picture) {
  const {canvas, camera} = picture,
    handles = handleLayer(canvas, camera, picture.hold, changed);
  const parts = partsOf(data, canvas, [handles.layer, handles.chooser]);
  /** @type {Seen} */
  let seen;
  let stale = true,
    drawn = () => {};
  const ask = () => drawn();
  function changed() {
    stale = true;
    ask();
  }
  replaceStill(root, parts.frame, canvas);

  return {
    ...parts,
    handles,
    camera,
    changed,
    ask,
    /** @param {string} text */
    say(text) {
      if (parts.says.textContent !== text) parts.says.textContent = text;
    },
    /**
     * @param {(now: number) => Seen} answer
     * @param {HTMLCanvasElement[]} [canvases]  other canvases, drawn at the same time
     * @param {() => void} [draw]  draws them
     */
    run(answer, canvases = [], draw = () => {}) {
      drawn = pictures(root, [canvas, ...canvases], now => {
        if (stale) {
          stale = false; // set first, since `answer` sets it again during an animation
          seen = answer(now);
        }
        draw();
        const room = picture.draw(seen);
        if (room) handles.place();
        return room;
      });
      answer(performance.now()); // writes the texts before the page is laid out, not after
    },
  };
}

/**
 * The elements of a frame.
 * @param {{kind: string, title: string, meant: string}} data
 * @param {HTMLCanvasElement} canvas
 * @param {HTMLElement[]} handles  the layer of handles and their chooser
 */
function partsOf({kind, title: text, meant}, canvas, handles) {
  const title = element("div", {class: "rk-title"}, text),
    space = element("div", {class: "rk-space"}, canvas, ...handles);
  const side = element("div", {class: "rk-side"}),
    below = element("div", {class: "rk-below"});
  const hint = folded(meant);
  const halves = kind === "motion" ? " rk-halves" : "";
  const frame = element(
    "div",
    {class: `rk rk-${kind}`, role: "group", "aria-label": text},
    title,
    element("div", {class: `rk-views rk-asked${halves}`}, space, side),
    below,
    hint,
  );
  const says = element("p", {class: "rk-says", role: "status"});
  return {frame, title, space, side, below, says, hint};
}

/**
 * A text of which only the first sentence is shown; a click reveals the rest.
 * @param {string} text
 */
function folded(text) {
  const [first, ...more] = text.split(/(?<=\.) /);
  if (!more.length) return element("p", {class: "rk-meant"}, text);
  const summary = control("summary", {}, first);
  return element("details", {class: "rk-meant"}, summary, more.join(" "));
}

/**
 * Wraps `node` in a box and puts `more` after it, in the same box.
 * @param {HTMLElement} node
 * @param {...HTMLElement} more
 */
export function beside(node, ...more) {
  const box = element("div", {});
  node.replaceWith(box);
  box.append(node, ...more);
}

/**
 * A button with text.
 * @param {string} text
 * @param {() => void} act
 */
export function wordButton(text, act) {
  const node = control("button", {type: "button", class: "rk-word"}, text);
  node.addEventListener("click", act);
  return node;
}

/**
 * Draws the optional parts: the axes of the joints, and the ellipsoid of tool velocities, whose
 * outline is the ellipse of its projected semi-axes.
 * @param {Context} g
 * @param {Camera} camera
 * @param {Explored} arm
 * @param {number} size
 */
function drawAids(g, camera, {chain, q, axes, ellipsoid}, size) {
  if (!q.every(Number.isFinite)) return;
  /** @type {number[][]} */
  const joints = [],
    all = frames(chain, q, joints),
    tip = origin(all[all.length - 1]);
  if (axes)
    joints.forEach((joint, j) => {
      if (axes !== true && !axes.includes(j)) return;
      const way = turned(joint, chain[j].axis),
        ends = [-0.22, 0.22].map(k => camera.to(plus(origin(joint), way, k * size)));
      stroke(g, ends, jointColor(j), 1.6, [7, 3, 1.5, 3]);
    });
  if (!ellipsoid) return;
  const [a, b, c] = [
    [0, 0],
    [0, 1],
    [1, 1],
  ].map(([i, j]) =>
    ellipsoid.map(axis => camera.along(axis)).reduce((sum, s) => sum + s[i] * s[j], 0),
  );
  const middle = (a + c) / 2,
    apart = Math.hypot((a - c) / 2, b),
    [x, y] = camera.to(tip);
  const draw = () =>
    g.ellipse(
      x,
      y,
      Math.sqrt(middle + apart),
      Math.sqrt(Math.max(0, middle - apart)),
      Math.atan2(2 * b, a - c) / 2,
      0,
      2 * Math.PI,
    );
  shape(g, draw, clear(colors.accent, 0.14), colors.accent, 1.6);
}

/**
 * A slider with a number box for its value.
 * @param {Control} spec
 * @param {(value: number) => void} take
 */
export function slider({name, unit, low, high, step, decimals}, take) {
  const label = [name, unit].filter(Boolean).join(", ");
  const track = range(label, high, low, step);
  const exact = control("input", {type: "number", step, "aria-label": `${label}, exactly`});
  const row = element(
    "div",
    {class: "rk-slide"},
    element("span", {}, name),
    track,
    exact,
    element("span", {}, unit),
  );
  track.addEventListener("input", () => take(+track.value));
  let typing = false; // while true, `set` does not overwrite what is being typed
  exact.addEventListener("input", () => {
    typing = true;
  });
  const taken = () => {
    typing = false;
    if (Number.isFinite(exact.valueAsNumber)) take(exact.valueAsNumber);
  };
  exact.addEventListener("change", taken);
  exact.addEventListener("keydown", event => {
    if (event.key === "Enter") taken();
  }); // in JupyterLab, Enter does not cause a change event
  return {
    row,
    /** @param {number} value */
    set(value) {
      const text = String(+value.toFixed(decimals));
      track.value = String(value);
      track.setAttribute("aria-valuetext", `${number(value, decimals)} ${unit}`.trim());
      if (!typing && exact.value !== text) exact.value = text;
    },
  };
}

/**
 * A menu with one option for each text.
 * @param {string} name
 * @param {string[]} texts
 * @param {(k: number) => void} take
 */
export function menu(name, texts, take) {
  const select = control(
    "select",
    {"aria-label": name},
    ...texts.map((text, k) => element("option", {value: k}, text)),
  );
  select.addEventListener("change", () => take(+select.value));
  return {
    row: element("label", {class: "rk-slide"}, element("span", {}, name), select),
    /** @param {number} k */
    set(k) {
      select.value = String(k);
    },
  };
}

/**
 * A check box.
 * @param {string} name
 * @param {() => void} take
 * @param {boolean} [on]  whether it is initially ticked
 */
export function tick(name, take, on = false) {
  const box = control("input", {type: "checkbox"});
  box.checked = on;
  box.addEventListener("change", take);
  return {row: element("label", {}, box, name), on: () => box.checked};
}
