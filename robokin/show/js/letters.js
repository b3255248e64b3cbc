// Handles with a letter, for points in the plane z = 0.

import {number} from "./canvas.js";
import {inScreen} from "./handles.js";
import {plus} from "./kinematics.js";

/** @import {Color, Point} from "./canvas.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Unit} from "./page.js" */

/**
 * The handle of a point in the plane z = 0, with a letter on it.
 * @param {{letter: string, name: string, color: Color, unit: Unit, step: number}} look  `step` is
 *   the distance in metres that an arrow key moves the point; with Shift it is ten times as long
 * @param {() => Point} at
 * @param {(place: Point) => void} take
 * @returns {Handle}
 */
export function letterHandle({letter, name, color, unit, step}, at, take) {
  const home = [...at()];
  const value = () => {
    const [x, y] = at().map(each => number(each / unit.size, 3));
    return `${x}, ${y} ${unit.name}`;
  };
  return {
    id: letter,
    name,
    look: "rk-mark",
    mark: letter,
    color,
    at,
    value,
    grab(view) {
      const to = inScreen(view, at());
      return (dx, dy) => take([...to(dx, dy).slice(0, 2), 0]);
    },
    step: (right, up, big) => take(plus(at(), [right, up, 0], big ? 10 * step : step)),
    home: () => take(home),
    // while it has the focus, its coordinates are in a corner of the scene
    tell(layer, focused) {
      if (focused) layer.dataset.at = `${letter}: ${value()}`;
      else if (layer.dataset.at?.startsWith(`${letter}:`)) delete layer.dataset.at;
    },
  };
}
