// Polygons behind the arms. things/faces.py has their data.

import {colors, polygon} from "./canvas.js";
import {dot} from "./kinematics.js";

/** @import {PageFaces} from "./page.js" */
/** @import {Point} from "./canvas.js" */
/** @import {Kind} from "./scene.js" */

/** @type {Kind<PageFaces>} */
export const faces = {
  seen: ({corners}) => corners.flat(),
  /** Draws the polygons, the farthest first. */
  below({g, cam}, things) {
    /** @type {(face: Point[]) => number} */
    const depth = face => face.reduce((sum, p) => sum + dot(p, cam.toward), 0) / face.length;
    for (const face of things.flatMap(thing => thing.corners).sort((p, q) => depth(p) - depth(q)))
      polygon(g, face.map(cam.to), colors.foot, colors.footEdge, 1);
  },
  above() {},
};
