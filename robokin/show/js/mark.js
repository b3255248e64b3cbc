// Points and balls. things/mark.py has their data.

import {clear, colors, spot} from "./canvas.js";

/** @import {PageMark} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Now} from "./recordings.js" */
/** @import {Kind} from "./scene.js" */

/** @type {Kind<PageMark>} */
export const mark = {
  seen: ({at}) => [at],
  /** Draws the balls. */
  below({g, cam}, marks) {
    for (const {at, radius} of marks) {
      if (!radius) continue;
      const [x, y] = cam.to(at),
        r = radius * cam.scale;
      const shade = g.createRadialGradient(x - r / 3, y - r / 3, r / 8, x, y, r);
      shade.addColorStop(0, clear(colors.ballShine, 0.75));
      shade.addColorStop(1, clear(colors.ball, 0.75));
      spot(g, [x, y], r, shade, colors.ballEdge, 1.2);
    }
  },
  /** Draws the points, and the names of points and balls. */
  above({g, cam}, marks, labels) {
    for (const {name, at, radius} of marks) {
      const place = cam.to(at);
      if (!radius) spot(g, place, 3.5, colors.path);
      if (name) labels.push({text: name, at: place, color: colors.soft});
    }
  },
};

/** A point that an explorer shows. @type {(name: string, at: Point) => Now<PageMark>} */
export const point = (name, at) => ({kind: "mark", name, radius: 0, at});
