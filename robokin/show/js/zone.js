// The zone of a SCARA, seen from above. Its data are defined in things/zone.py.

import {clear, colors, jointColor, polygon, shade, stroke} from "./canvas.js";

/** @import {PageZone} from "./page.js" */
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
    for (const {joint, dash, points} of found.flat())
      stroke(g, points.map(to), joint === null ? colors.soft : jointColor(joint), 2, dash);
  },
  /** Names each side where it is free, and only next to it: it is next to other sides, too. */
  above({cam: {to}}, zones, labels) {
    for (const {text, joint, points} of zones.flatMap(({elbows}) => elbows.flat())) {
      const along = points.filter((_, k) => k % 4 === 1).map(to),
        color = shade(jointColor(joint ?? 0));
      if (text) labels.push({text, at: along[0], along, color, near: true});
    }
  },
};
