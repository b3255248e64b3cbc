// The elbow explorer: the reader drags the point that an arm positions, in the plane in which the
// arm bends, and the triangle of upper arm, forearm and the line to the point follows. All text
// and the arm data come from Python (explorer_page.py: ElbowPage).

import {wrapped} from "./angles.js";
import {excess, representative, within} from "./branches.js";
import {fill, inWords, plain} from "./blanks.js";
import {number} from "./canvas.js";
import {copyButton} from "./copy.js";
import {elbowPicture} from "./elbow_picture.js";
import {element, waiting} from "./elements.js";
import {geometryOf, ik, singularities} from "./geometries.js";
import {inScreen} from "./handles.js";
import {clamp, distance2, exists} from "./rows.js";
import {frameOf, slider} from "./stage.js";
import {table} from "./table.js";
import {degrees} from "./turns.js";

/** @import {ElbowInverse, ElbowPage} from "./page.js" */
/** @import {Ring} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {ArmOf, ClosedFormArm} from "./kinematics.js" */
/** @import {Gap} from "./two_levers.js" */

/** @typedef {ClosedFormArm & ArmOf<ElbowInverse>} ElbowArm */
/** @typedef {ElbowPage & {arm: ElbowArm}} ElbowExplorer */
/**
 * The arm with one of its elbows: the joint values, the joints that exceed a limit, the elevation
 * of the upper arm, and the angle from the upper arm to the forearm.
 * @typedef {{q: number[], past: number[], alpha: number, gamma: number}} Bent
 */
/**
 * The position of the point relative to joint 2 (`u` horizontally, `w` vertically), the distance
 * `d`, and the arm with both elbows. If there is no triangle, `elbows` is empty and `gap` is the
 * reason.
 * @typedef {{u: number, w: number, d: number, elbows: Bent[], gap: ?Gap}} Triangles
 */
/** @typedef {{r: number, z: number, elbow: number}} State  `elbow`: the chosen row */
/**
 * What the picture shows.
 * @typedef {State & Triangles & {alt: string, handles: (camera: Camera) => Ring[]}} Seen
 */

/**
 * Builds the view in every placeholder with this id.
 * @param {string} id
 * @param {ElbowExplorer} data
 */
export const explore = (id, data) => waiting(id).forEach(root => elbowExplorer(root, data));

/**
 * The triangles for a point r from axis 1 (negative behind it) at the height z.
 * @param {ElbowArm} arm
 * @param {number} r
 * @param {number} z
 * @returns {Triangles}
 */
export function trianglesAt(arm, r, z) {
  const {elbow: e} = arm.geometry,
    [u, w] = [r - e.shoulder_x, z - e.shoulder_z],
    place = [r, e.lateral, z],
    first = r < 0 ? 2 : 0; // the first row with the front flag of this side
  const elbows = ik(arm, {place})
    .slice(first, first + 2)
    .filter(exists)
    .map(row => {
      const q = representative(arm, row),
        inside = within(arm, q);
      return {
        q,
        past: [1, 2].filter(j => !inside[j]),
        alpha: e.upper_angle + e.sign2 * q[1],
        gamma: wrapped(e.fore_angle - e.upper_angle + e.sign3 * q[2]),
      };
    });
  const gap = elbows.length ? null : geometryOf(arm).gap(arm, {place}, first);
  return {u, w, d: distance2(u, w), elbows, gap};
}

/**
 * @param {HTMLElement} root
 * @param {ElbowExplorer} data
 */
function elbowExplorer(root, data) {
  const {arm, controls, words, unit} = data,
    [r, z] = data.point,
    stage = frameOf(root, data, elbowPicture(data));
  /** @type {State} */
  const state = {r, z, elbow: 0};
  /** @type {(x: number, k: number) => number} */
  const inside = (x, k) => clamp(x, controls[k].low * unit.size, controls[k].high * unit.size);
  /** @type {(r: number, z: number) => void} */
  const move = (r, z) => {
    [state.r, state.z] = [inside(r, 0), inside(z, 1)];
  };
  const sliders = controls.map((spec, k) =>
    slider(spec, value => {
      if (k) move(state.r, value * unit.size);
      else move(value * unit.size, state.z);
      stage.changed();
    }),
  );
  const lengths = table([fill(words.lengths, {unit: unit.name})], [], [3]),
    elbows = table(data.elbows, data.heads, [1, 1, 1, 1], k => {
      state.elbow = k;
      stage.changed();
    });
  const copy = copyButton(words, () => fill(data.code, inCode(data, state)));
  stage.side.append(
    ...sliders.map(each => each.row),
    lengths.node,
    elbows.node,
    stage.says,
    element("div", {class: "rk-row"}, copy),
  );
  stage.handles.set([pointHandle(data, state, move)]);

  stage.run(() => {
    const found = trianglesAt(arm, state.r, state.z),
      says = told(data, state, found);
    [state.r, state.z].forEach((x, k) => sliders[k].set(x / unit.size));
    lengths.set([inUnit(data, {u: found.u, w: found.w, d: found.d})]);
    elbows.set(
      data.elbows.map((_, k) => cells(words, found.elbows[k])),
      state.elbow,
      data.elbows.map(() => !found.gap),
    );
    stage.say(says);
    const alt = `${seen(data, state, found)} ${says}`;
    return {...state, ...found, alt, handles: stage.handles.place};
  });
}

/**
 * Lengths as text, with their names.
 * @param {ElbowExplorer} data
 * @param {Record<string, number>} lengths
 */
const inUnit = ({unit, controls: [{decimals}]}, lengths) =>
  Object.entries(lengths).map(([name, x]) => `${name} ${number(x / unit.size, decimals)}`);

/** An angle as text, in degrees. @type {(angle: number) => string} */
const inDegrees = angle => number(degrees(angle), 1);

/**
 * The cells in the table row of an elbow.
 * @param {ElbowExplorer["words"]} words
 * @param {Bent} [bent]
 */
function cells({none}, bent) {
  if (!bent) return [none, none, none, none];
  const {gamma, alpha, q, past} = bent;
  return [
    inDegrees(gamma),
    inDegrees(alpha),
    ...[1, 2].map(j => ({text: inDegrees(q[j]), past: past.includes(j)})),
  ];
}

/** @type {(k: number) => string} */
const flagOf = k => (k ? "\u22121" : "+1");

/**
 * Says what is special about the position of the point, and which joints exceed their limits. The
 * chosen elbow comes first.
 * @param {ElbowExplorer} data
 * @param {State} state
 * @param {Triangles} found
 */
function told({arm, words}, {r, elbow}, {elbows, gap}) {
  const says =
    r < 0 ? [words.behind] : r === 0 && !arm.geometry.elbow.lateral ? [words.onAxis] : [];
  if (gap) {
    const text = gap.kind === "stretched" ? words.tooFar : words.tooNear;
    return [fill(text, {gap: inWords(gap.metres)}), ...says].join(" ");
  }
  const {q, gamma} = elbows[elbow],
    one = singularities(arm, q).elbow;
  if (one) says.push(Math.cos(gamma) > 0 ? words.stretched : words.folded);
  for (const k of one ? [elbow] : [elbow, 1 - elbow]) {
    const {q, past} = elbows[k],
      facts = past.map(j => excess(arm, q, j)).join(words.and);
    says.push(fill(past.length ? words.past : words.inside, {flag: flagOf(k), facts}));
  }
  return says.join(" ").replace(/-(?=\d)/g, "\u2212");
}

/**
 * The numbers of the picture as sentences.
 * @param {ElbowExplorer} data
 * @param {State} state
 * @param {Triangles} found
 */
function seen({arm, words, unit, controls: [{decimals}]}, {r, z}, {d, elbows}) {
  const [rText, zText, dText] = [r, z, d].map(x => number(x / unit.size, decimals));
  const facts = {name: arm.name, point: arm.carried, unit: unit.name, r: rText, z: zText, d: dText};
  const bent = elbows.map(({q, alpha, gamma}, k) => {
    const [alphaText, gammaText, q2, q3] = [alpha, gamma, q[1], q[2]].map(inDegrees);
    return fill(words.bent, {flag: flagOf(k), alpha: alphaText, gamma: gammaText, q2, q3});
  });
  return [fill(words.seen, facts), ...bent].join(" ");
}

/**
 * @param {ElbowExplorer} data
 * @param {State} state
 */
const inCode = ({unit}, {r, z, elbow}) => ({
  r: plain(r / unit.size, 3),
  z: plain(z / unit.size, 3),
  elbow: elbow ? "-1" : "+1",
});

/**
 * @param {ElbowExplorer} data
 * @param {State} state
 * @param {(r: number, z: number) => void} move
 * @returns {Handle}
 */
function pointHandle(data, state, move) {
  const {words, unit, controls, point} = data,
    fine = controls[0].step * unit.size;
  return {
    id: "point",
    name: words.take,
    look: "rk-free",
    at: () => [state.r, 0, state.z],
    value: () => `${inUnit(data, {r: state.r, z: state.z}).join(", ")} ${unit.name}`,
    grab(camera) {
      const to = inScreen(camera, [state.r, 0, state.z]);
      return (dx, dy) => {
        const [r, , z] = to(dx, dy);
        move(r, z);
      };
    },
    step(right, up, big) {
      const by = fine * (big ? 10 : 1);
      move(state.r + by * right, state.z + by * up);
    },
    home: () => move(point[0], point[1]),
  };
}
