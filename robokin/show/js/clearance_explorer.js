// The clearance explorer: the reader drags an obstacle H and the gripper's via points, and sees how
// near the levers come to H during the motion. All text and the arm data come from Python
// (explorer_page.py: ClearancePage).

import {approachOf, jointsOf, motionOf, nearestAt, postureAt} from "./approach.js";
import {drawApproach} from "./approach_curve.js";
import {fill, inWords, plain} from "./blanks.js";
import {clear, colors, number, spot, stroke} from "./canvas.js";
import {scrubbing} from "./controls.js";
import {copyButton} from "./copy.js";
import {element, waiting} from "./elements.js";
import {letterHandle} from "./letters.js";
import {fk, origin} from "./kinematics.js";
import {least, outside} from "./levers.js";
import {point} from "./mark.js";
import {clamp} from "./rows.js";
import {slider, stageOf, wordButton} from "./stage.js";
import {degrees} from "./turns.js";

/** @import {ClearancePage} from "./page.js" */
/** @import {Least, Motion} from "./approach.js" */
/** @import {Pixel, Point} from "./canvas.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Draw} from "./scene.js" */
/** @import {Explored, Stage} from "./stage.js" */

/** @typedef {ClearancePage & {arm: ThreeLeverArm}} ClearanceExplorer */
/**
 * The reader's settings. `share` is the fraction of the motion at which the arm is drawn, or null
 * for the moment at which it is nearest to H.
 * @typedef {{obstacle: Point, vias: Point[], share: ?number}} State
 */
/**
 * The result of the settings: the motion and the distances during it, the nearest lever at the
 * current moment, and the names of the via points. If a point is out of reach: only the reason.
 * @typedef {ReturnType<typeof approachOf> & {
 *   motion: Motion, now: Least, wanted: number, vias: string[], why?: undefined,
 * }} Passing
 */
/** @typedef {Passing | {why: string}} Found */

const LEVERS = ["OB", "BA", "AK"],
  TOUCHES = 5e-5; // m: a shorter distance is shown as 0.0 mm

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {ClearanceExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => clearanceExplorer(stageOf(root, data), data));

/**
 * @param {Stage} stage
 * @param {ClearanceExplorer} data
 */
function clearanceExplorer(stage, data) {
  const {words: says, controls} = data,
    pathAt = paths(data);
  /** @type {State} */
  const state = {obstacle: [...data.obstacle], vias: data.vias.map(via => [...via]), share: null};
  /** @type {(share: ?number) => void} */
  const go = share => {
    state.share = share === null ? null : clamp(share, 0, 1);
    stage.changed();
  };
  const moment = slider(controls[0], value => go(value / 100)),
    [big, where] = [element("b"), element("span")],
    canvas = element("canvas", {class: "rk-curves", role: "img"});
  /** @type {ReturnType<typeof drawApproach>} */
  let plot = null;
  /** @type {Found} */
  let found;
  stage.side.append(
    element("p", {class: "rk-least"}, element("span", {}, says.leastIs), big, where),
    canvas,
    moment.row,
    element(
      "div",
      {class: "rk-row"},
      wordButton(says.toLeast, () => go(null)),
      copyButton(says, () => pythonOf(data, state)),
    ),
    stage.says,
  );
  scrubbing(canvas, event => plot && go(plot.shareAt(event.offsetX)));
  stage.handles.set(handlesOf(data, state));

  stage.run(
    () => {
      found = foundOf(data, pathAt(state.vias), state);
      const text = told(data, found);
      moment.set(100 * (found.why === undefined ? found.now.share : 0));
      [big.textContent, where.textContent] = [text.distance, text.where];
      big.classList.toggle("rk-past", !text.kept);
      stage.say(text.says);
      stage.name(fill(says.scene, {title: data.title, says: `${text.where} ${text.says}`}));
      canvas.setAttribute("aria-label", text.curve);
      stage.scene.things = thingsOf(data, state, found);
      return [armOf(data, state, found)];
    },
    [canvas],
    () => {
      plot = drawApproach(canvas, says, found.why === undefined ? found : null);
    },
  );
}

/**
 * Returns a function that maps via points to the postures of the path, up to the first point that
 * is out of reach. It caches the last result, which changes only with the via points.
 * @param {ClearanceExplorer} data
 * @returns {(vias: Point[]) => {path: number[][], motion: Motion}}
 */
export function paths({arm, q, target}) {
  let known = "";
  /** @type {{path: number[][], motion: Motion}} */
  let made;
  return vias => {
    const asked = vias.join();
    if (made && asked === known) return made;
    known = asked;
    const path = [[...q]];
    for (const place of [...vias, target.place]) {
      const next = least(arm, {place}, path[path.length - 1]);
      if (!next.every(Number.isFinite)) break;
      path.push(next);
    }
    made = {path, motion: motionOf(arm, path)};
    return made;
  };
}

/**
 * @param {ClearanceExplorer} data
 * @param {{path: number[][], motion: Motion}} made
 * @param {State} state
 * @returns {Found}
 */
export function foundOf({arm, words, target, distance}, {path, motion}, state) {
  const {obstacle, vias, share} = state,
    names = vias.map((_, k) => `K${k + 2}`);
  if (path.length < vias.length + 2) {
    const k = path.length - 1,
      place = [...vias, target.place][k];
    return {why: `${[...names, "K1"][k]}: ${outside(words, arm, place)}`};
  }
  const found = approachOf(arm, motion, obstacle),
    now = share === null ? found.least : nearestAt(arm, motion, obstacle, share);
  return {...found, motion, now, wanted: distance, vias: names};
}

/**
 * The texts for this state.
 * @param {ClearanceExplorer} data
 * @param {Found} found
 */
function told({words: says}, found) {
  if (found.why !== undefined)
    return {distance: says.none, where: "", kept: false, says: found.why, curve: found.why};
  const {least: nearest, gripperLeast, wanted, motion, now} = found,
    {distance, index, share} = nearest,
    kept = distance >= wanted;
  const facts = {
    lever: LEVERS[index],
    percent: number(100 * share, 0),
    distance: inWords(distance),
    wanted: inWords(wanted),
    gripper: inWords(gripperLeast.distance),
    S: number(degrees(motion.S), 1),
  };
  const shown = fill(says.now, {
    percent: number(100 * now.share, 0),
    lever: LEVERS[now.index],
    distance: inWords(now.distance),
  });
  const touches = distance < TOUCHES;
  return {
    distance: facts.distance,
    where: fill(touches ? says.hits : says.where, facts),
    kept,
    says: fill(kept ? says.kept : says.notKept, facts) + (now === nearest ? "" : ` ${shown}`),
    curve: fill(says.curveSays, facts),
  };
}

/**
 * The points of the scene. Those without a handle have a label: the start, the target, and the
 * nearest point of a lever.
 * @param {ClearanceExplorer} data
 * @param {State} state
 * @param {Found} found
 */
function thingsOf({arm, q, target}, {obstacle, vias}, found) {
  const ends = [
    point("K", origin(fk(arm.chain, q))),
    point("K1", target.place),
    ...[obstacle, ...vias].map(place => point("", place)),
  ];
  if (found.why !== undefined) return ends;
  const {index, distance, place} = found.now,
    text = `${LEVERS[index]} ${number(distance / 1e-3, 0)} mm`;
  return [...ends, point(text, [...place, 0])];
}

/**
 * The arm at the current moment, with the area that its levers sweep.
 * @param {ClearanceExplorer} data
 * @param {State} state
 * @param {Found} found
 * @returns {Explored}
 */
function armOf({arm, q, distance, words}, state, found) {
  const {name, chain} = arm;
  /** @type {Draw} */
  const circle = (g, {to, scale}) =>
    spot(g, to(state.obstacle), distance * scale, clear(colors.ghost, 0.25), colors.ghost, 1);
  if (found.why !== undefined)
    return {name, chain, q, faded: true, nowhere: words.none, under: circle};
  const {motion, now} = found,
    {path} = motion,
    shown = postureAt(motion, now.share);
  return {
    name,
    chain,
    q: shown,
    labels: jointsOf(arm, shown)
      .slice(0, 3)
      .map((at, k) => ({text: "OBA"[k], at: [...at, 0], color: colors.ink})),
    ghosts: [
      {q: path[0], past: false},
      {q: path[path.length - 1], past: true},
    ],
    under(g, camera) {
      circle(g, camera);
      drawSwept(found)(g, camera);
      if (!state.vias.length) drawSides(motion)(g, camera);
    },
    over: (g, {to}) => stroke(g, [to(state.obstacle), to([...now.place, 0])], colors.near, 2),
  };
}

/**
 * Draws the levers at several moments, and the path of the gripper.
 * @type {(found: Passing) => Draw}
 */
const drawSwept =
  ({motion: {points}, least: {distance}, wanted}) =>
  (g, {to}) => {
    const color = distance < wanted ? colors.alarm : colors.accent;
    /** @type {(p: Pixel) => Pixel} */
    const flat = ([x, y]) => to([x, y, 0]);
    const some = points.filter((_, i) => i % 6 === 0).flatMap(one => [...one.map(flat), null]);
    stroke(g, some, clear(color, 0.3), 1);
    stroke(
      g,
      points.map(one => flat(one[3])),
      color,
      2,
    );
  };

/**
 * Draws the sides A A1 and K K1 of the quadrilateral of lever AK: the others are the lever before
 * and after the motion.
 * @type {(motion: Motion) => Draw}
 */
const drawSides =
  ({points}) =>
  (g, {to}) => {
    const after = points[points.length - 1];
    for (const k of [2, 3])
      stroke(g, [to([...points[0][k], 0]), to([...after[k], 0])], colors.ink, 1.4, [2, 4]);
  };

/**
 * The handles of the obstacle and of the via points.
 * @param {ClearanceExplorer} data
 * @param {State} state
 */
function handlesOf({arm, words: says, unit}, state) {
  const step = (0.01 * arm.reach) / 3;
  return [
    letterHandle(
      {letter: "H", name: says.H, color: "alarm", unit, step},
      () => state.obstacle,
      place => {
        state.obstacle = place;
      },
    ),
    ...state.vias.map((_, k) =>
      letterHandle(
        {letter: `K${k + 2}`, name: fill(says.via, {k: k + 2}), color: "path", unit, step},
        () => state.vias[k],
        place => {
          state.vias[k] = place;
        },
      ),
    ),
  ];
}

/**
 * The Python code that computes the same distances.
 * @param {ClearanceExplorer} data
 * @param {State} state
 */
function pythonOf({code, target}, {obstacle, vias}) {
  /** @type {(place: Point) => string} */
  const text = place =>
    `(${place
      .slice(0, 2)
      .map(x => plain(x, 6))
      .join(", ")})`;
  return fill(code, {
    places: [...vias, target.place].map(text).join(", "),
    obstacle: text(obstacle),
  });
}
