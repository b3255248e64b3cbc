// A close-up of the corner of a blended motion, with a ring that pulls the path away from the via
// point. It shows how far the tool cuts the corner and how much the joints have to accelerate. The
// arm and its joint accelerations are shown beside it.

import {fill} from "./blanks.js";
import {most, topsOf} from "./blended.js";
import {number} from "./canvas.js";
import {orbit, sceneCanvas} from "./controls.js";
import {cornerOf, cornerPicture, offset} from "./corner_picture.js";
import {element} from "./elements.js";
import {plus} from "./kinematics.js";
import {panelOf} from "./motion_panels.js";
import {armAt, motionParts, notes} from "./motion_parts.js";
import {decimalsOf} from "./peaks.js";
import {sceneOf, sceneView} from "./scene.js";
import {frameOf} from "./stage.js";
import {scale} from "./ticks.js";

/** @import {MotionPage} from "./page.js" */
/** @import {Motion} from "./blended.js" */
/** @import {CornerAt} from "./corner_picture.js" */
/** @import {Handle} from "./handles.js" */
/** @import {Drawn, State} from "./motion_parts.js" */
/** @import {Shown} from "./scene.js" */

/** @typedef {{joint: number, value: number}} Hardest  a joint and its acceleration in its unit */

const ORDER = 2; // the order of the derivative that the panel shows: accelerations

/**
 * @param {HTMLElement} root
 * @param {MotionPage} data
 */
export function cornerExplorer(root, data) {
  const corner = cornerOf(data),
    canvas = element("canvas", {class: "rk-scene rk-flat", role: "img"}),
    told = toldBeside(canvas, data.words);
  /** @type {() => ReturnType<CornerAt["seen"]>} */
  const seen = () => corner.seen(state.blend, data.corners[state.corner]),
    stage = frameOf(
      root,
      data,
      cornerPicture(canvas, data, corner, seen, cam => ring.at(cam)),
    ),
    parts = motionParts(stage, data, found => hardest(data, found)),
    {state, clock, motion} = parts,
    ring = ringOf(data, state, corner, () => motion.now().near?.text ?? ""),
    small = armPicture(data, stage.ask);
  stage.frame.classList.add("rk-corner");
  stage.side.parentElement?.before(told.node);
  stage.side.after(small.canvas);
  stage.below.append(
    element("div", {class: "rk-columns"}, ...parts.inputs.rows),
    element("div", {class: "rk-row"}, element("div", {}, stage.says, stage.hint), parts.copy),
  );
  stage.handles.set([ring]);
  state.time = state.duration / 2; // the tool is at the corner
  const {a: rows, gaps} = motion.now(); // the opening motion
  /** @type {?{drawn: Drawn, arms: Shown[]}} */
  let shown = null;
  stage.run(
    now => {
      clock.pass(now);
      const found = motion.now(),
        sure = motion.searched(parts.held()),
        worst = sure ?? sampledHardest(data, found),
        arms = [{...armAt(data, found, parts.sample()), near: found.near}];
      parts.inputs.tell();
      clock.tell();
      stage.say(notes(data, {...found, jumps: []}).join(" "));
      told.tell(sentences(data, found, worst, sure !== null));
      const same = found.a.every((row, i) => row.every((a, j) => Object.is(a, rows[i][j]))),
        opening = same || state.duration !== data.start_values.duration ? null : {rows, gaps},
        panel = panelOf(data, found, found.a, ORDER, parts.sample(), opening);
      for (const line of panel.lines)
        line.faint = worst.length > 0 && !worst.some(({joint}) => joint === line.joint);
      const curves = {panels: [panel], large: 0, names: []};
      shown = {drawn: [curves, found.t, scale(0, state.duration), state.time], arms};
      return arms;
    },
    [small.canvas, parts.canvas],
    () => {
      if (!shown) return;
      parts.curves.draw(...shown.drawn);
      small.draw(shown.arms);
    },
  );
}

/**
 * Creates the line of text above the picture, which is also the picture's accessible name.
 * @param {HTMLCanvasElement} canvas
 * @param {MotionPage["words"]} words
 */
function toldBeside(canvas, {closeUp}) {
  const node = element("p", {class: "rk-told", role: "status"});
  return {
    node,
    /** @param {HTMLElement[]} said */
    tell(said) {
      const name = closeUp + said.map(({textContent}) => textContent).join(" ");
      if (canvas.ariaLabel === name) return;
      node.replaceChildren(...said);
      canvas.ariaLabel = name;
    },
  };
}

/**
 * The ring that moves the middle of the path. It is between the path and the via point.
 * @param {MotionPage} data
 * @param {State} state
 * @param {CornerAt} corner
 * @param {() => string} distance
 * @returns {Handle}
 */
function ringOf(
  {words, corners, controls: [{low, high, step: fine, decimals}], start_values},
  state,
  corner,
  distance,
) {
  const kind = () => corners[state.corner];
  /** @type {(blend: number) => void} */
  const take = blend => {
    // rounded, so that all numbers are for the displayed value of the blend
    state.blend = +Math.min(Math.max(blend, low), high).toFixed(decimals);
  };
  return {
    id: "blend",
    name: words.takeBlend,
    look: "rk-free",
    at: camera => plus(corner.middle(state.blend, kind()), corner.right, offset() / camera.scale),
    value: () => fill(words.blendIs, {blend: number(state.blend, decimals), distance: distance()}),
    grab({scale}) {
      const from = state.blend,
        per = corner.perMetre(kind()) / scale;
      return dx => take(from - dx * per);
    },
    step(right, up, big) {
      take(state.blend + (up - right) * fine * (big ? 10 : 1));
    },
    home() {
      state.blend = start_values.blend;
    },
  };
}

/**
 * A small picture of the whole arm. The reader can turn the view.
 * @param {MotionPage} data
 * @param {() => void} ask
 */
function armPicture(data, ask) {
  const scene = sceneOf(data),
    canvas = sceneCanvas(scene, data.alt),
    view = sceneView(canvas, scene),
    state = {view: [...scene.view]};
  orbit(canvas, scene, state, ask);
  return {
    canvas,
    /** @param {Shown[]} arms */
    draw: arms => view.draw(state.view, arms, ""),
  };
}

/**
 * The revolute and the prismatic joint with the greatest accelerations, since angles cannot be
 * compared with lengths.
 * @param {MotionPage} data
 * @param {number[]} accelerations  without signs; NaN where there are none
 * @returns {Hardest[]}
 */
const hardestOf = ({arm, units}, accelerations) =>
  [false, true].flatMap(slides => {
    let best = {joint: -1, value: -Infinity};
    for (const [joint, x] of accelerations.entries()) {
      const value = x / units[joint].size;
      if (arm.prismatic[joint] === slides && value > best.value) best = {joint, value};
    }
    return best.joint < 0 ? [] : best;
  });

/**
 * These joints at the samples; none if the speeds jump.
 * @param {MotionPage} data
 * @param {Motion} motion
 */
const sampledHardest = (data, {a, jumps}) =>
  jumps.length
    ? []
    : hardestOf(
        data,
        data.units.map((_, j) => most(a, j)),
      );

/**
 * These joints, including what is between the samples; null if they are uncertain.
 * @param {MotionPage} data
 * @param {Motion} motion
 */
function hardest(data, motion) {
  /** @type {(slopes: number[][]) => Hardest[]} */
  const at = ([, accelerations]) => hardestOf(data, accelerations.map(Math.abs));
  const quantities = sampledHardest(data, motion).map(({value: about}, k) => ({
    of: /** @param {number[][]} slopes */ slopes => at(slopes)[k].value,
    about,
  }));
  const found = topsOf(data, motion, quantities);
  return found && found.map(({slopes}, k) => at(slopes)[k]);
}

/**
 * Sentences about the distance of the path from the via point, the greatest acceleration (of the
 * revolute joints, if there are any) and jumps in speed. The numbers of the first two are in bold.
 * @param {MotionPage} data
 * @param {Motion} motion
 * @param {Hardest[]} worst
 * @param {boolean} sure
 */
function sentences({arm, words, units}, {near, jumps}, worst, sure) {
  /** @type {HTMLElement[]} */
  const said = [];
  if (near) said.push(bold(words.near, "distance", {distance: near.text}));
  for (const {joint, value} of worst.slice(0, 1)) {
    const {name} = units[joint],
      most = `${number(value, decimalsOf(value))}${name === "°" ? "" : " "}${name}/s²`;
    const sentence = arm.prismatic.includes(true) ? words.hardestOfKind : words.hardest;
    said.push(bold(sentence, "value", {joint: joint + 1, value: sure ? most : `≈ ${most}`}));
  }
  for (const {time} of jumps)
    said.push(element("span", {class: "rk-alarm"}, fill(words.jump, {time: number(time, 2)})));
  return said;
}

/**
 * A sentence with its blanks filled, one of them in bold.
 * @param {string} sentence
 * @param {string} name
 * @param {Record<string, string | number>} facts
 */
function bold(sentence, name, facts) {
  const [before, after] = sentence.split(`{${name}}`).map(part => fill(part, facts));
  return element("span", {}, before, element("b", {}, String(facts[name])), after);
}
