// The joint curves of one motion, as `plot_joints` shows them: panels without a picture of the arm.
// page.py has their data.

import {replaceStill} from "./canvas.js";
import {curvesView} from "./curves.js";
import {element, waiting} from "./elements.js";
import {pictures} from "./pictures.js";
import {unpacked} from "./unpacked.js";

/** @import {CurvePanel, PageCurves} from "./page.js" */
/** @import {Line, Panel} from "./panel.js" */

const EACH = 205, // px: the height of a panel with its name
  MOST = 495; // px: the height of all panels, so that a figure with three fits on the screen

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {PageCurves} data
 */
export const show = (id, data) => waiting(id).forEach(root => start(root, data));

/**
 * @param {HTMLElement} root
 * @param {PageCurves} data
 */
function start(root, data) {
  const {title, panels, notes} = data,
    canvas = element("canvas", {
      class: "rk-alone",
      role: "img",
      "aria-label": data.alt,
      style: `height:${Math.min(EACH * panels.length, MOST) + 50}px`,
    });
  const frame = element(
    "div",
    {class: "rk rk-figure", role: "group", "aria-label": title || "Joint curves"},
    ...(title ? [element("div", {class: "rk-title"}, title)] : []),
    element(
      "ul",
      {class: "rk-notes"},
      ...notes.map(([text, alarm]) => element("li", alarm ? {class: "rk-alarm"} : {}, text)),
    ),
    canvas,
  );
  const view = curvesView(canvas, data.dashes),
    curves = {panels: panels.map(panel => panelOf(data, panel)), large: -1, names: []};
  replaceStill(root, frame, canvas);
  pictures(root, [canvas], () => view.draw(curves, data.times, data.ticks, NaN));
}

/** @type {(data: PageCurves, panel: CurvePanel) => Panel} */
function panelOf({prismatic, times, gaps, nothing}, {label, axes, near, values, limits, marks}) {
  const samples = times.length,
    all = unpacked(values, 1, samples, nothing),
    kinds = Object.keys(axes);
  /** @type {Line[]} */
  const lines = prismatic.map((shifts, joint) => ({
    values: all.subarray(joint * samples, (joint + 1) * samples),
    opening: null,
    joint,
    arm: 0,
    axis: kinds.indexOf(shifts ? "shift" : "turn"),
    faint: false,
    gaps: new Set(gaps),
    limits: limits && [limits[joint][0], limits[joint][1]],
    now: NaN,
  }));
  return {
    label,
    axes: Object.values(axes),
    lines,
    near: near[0].map(([joint, side]) => [joint, side]),
    marks: marks.map(([time, text]) => ({time, text})),
  };
}
