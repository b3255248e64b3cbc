// Target frames. things/target.py has their data.

import {clear, colors, spot, stroke} from "./canvas.js";
import {origin} from "./kinematics.js";
import {triad} from "./triad.js";

/** @import {PageTarget} from "./page.js" */
/** @import {Now} from "./recordings.js" */
/** @import {Kind} from "./scene.js" */

/** @type {Kind<PageTarget>} */
export const target = {
  seen: ({pose}) => [origin(pose)],
  /** Draws the straight route between targets that are stations of a path. */
  below({g, cam}, targets) {
    const stations = ["start", "via", "goal"].flatMap(name =>
      targets.filter(each => each.name === name),
    );
    if (stations.length < 2) return;
    const route = stations.map(({pose}) => cam.to(origin(pose)));
    stroke(g, route, clear(colors.soft, 0.55), 1, [7, 5]);
  },
  /** Draws the frames, their names, and the distance of the path from via. */
  above({g, cam, scene, near}, targets, labels) {
    for (const {name, pose} of targets) {
      const from = cam.to(origin(pose));
      triad(g, cam, pose, 0.09 * scene.size, 1.8);
      spot(g, from, 2.6, colors.path, colors.paper, 1);
      labels.push({text: name, at: from, color: colors.ink, weight: "600"});
    }
    const via = near && targets.find(each => each.name === "via");
    if (!via) return;
    const p = cam.to(origin(via.pose)),
      q = cam.to(near.place);
    if (Math.hypot(p[0] - q[0], p[1] - q[1]) > 3) stroke(g, [p, q], colors.near, 1.6, [4, 3]);
    labels.push({text: near.text, at: [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2], color: colors.near});
  },
};

/** A frame that an explorer shows. @type {(name: string, pose: number[]) => Now<PageTarget>} */
export const frame = (name, pose) => ({kind: "target", name, pose});
