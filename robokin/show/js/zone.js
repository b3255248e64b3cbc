// The zone of a SCARA, seen from above. Its data are defined in things/zone.py.

import {clear, colors, jointColor, polygon, shade, stroke} from "./canvas.js";

/** @import {PageZone} from "./page.js" */
/** @import {Pixel} from "./canvas.js" */
/** @import {Kind} from "./scene.js" */

/** @type {Kind<PageZone>} */
export const zone = {
  seen: ({elbows}) => elbows.flat().flatMap(({points}) => points),
  below({g, cam: {to}}, zones) {
    const found = zones.flatMap(({elbows}) => elbows);
    for (const sides of found)
      polygon(
        g,
        sides.flatMap(({points}) => points.map(to)),
        clear(colors.ghost, 0.12),
      );
    for (const {joint, dash, points} of found.flat()) {
      const line = points.map(to);
      stroke(g, line, colors.paper, 2); // else a line of the other elbow would fill the gaps
      stroke(g, line, joint === null ? colors.soft : jointColor(joint), 2, dash);
    }
  },
  /** Names each limit where it is free, and only next to its own sides. */
  above({cam: {to}}, zones, labels) {
    const sides = zones.flatMap(({elbows}) => elbows.flat());
    for (const [text, {joint}] of new Map(sides.map(side => [side.text, side]))) {
      /** @type {(own: boolean, each: number) => Pixel[]} */
      const places = (own, each) =>
        sides
          .filter(side => side.joint === joint && (side.text === text) === own)
          .flatMap(({points}) => points.filter((_, k) => k % each === 1).map(to));
      const along = places(true, 4),
        look = {color: shade(jointColor(joint ?? 0)), near: true};
      if (text) labels.push({text, at: along[0], along, apart: places(false, 2), ...look});
    }
  },
};
