// The zone of a SCARA, seen from above. Its data are defined in things/zone.py.

import {clear, colors, jointColor, polygon, stroke} from "./canvas.js";

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
  above({cam: {to}}, zones, labels) {
    for (const [text, at] of zones.flatMap(({labels: own}) => own))
      labels.push({text, at: to(at), color: colors.ink});
  },
};
