// The explorer of plans: start, target and obstacle are taken by the hand, a kernel plans
// (live.js), and what it answers is drawn in the plane and in the cube of postures. What is said
// comes from Python (plan_explorer.py).

import {fk, origin, polyline} from "./kinematics.js";
import {least} from "./levers.js";
import {fill} from "./blanks.js";
import {clear, colors, number, polygon, prepared, spot, stroke, words} from "./canvas.js";
import {camera} from "./camera.js";
import {orbit} from "./controls.js";
import {copyButton} from "./copy.js";
import {control, element, range, waiting} from "./elements.js";
import {inScreen} from "./handles.js";
import {kernelOf, unpacked} from "./live.js";
import {menu, slider, stageOf, tick} from "./stage.js";

/** @import {PageExplorer, With} from "./page.js" */
/** @import {Color, Context, Pixel, Point} from "./canvas.js" */
/** @import {Camera} from "./camera.js" */
/** @import {Handle} from "./handles.js" */
/** @import {ThreeLeverArm} from "./levers.js" */
/** @import {Values} from "./live.js" */
/** @import {Stage} from "./stage.js" */

/**
 * @typedef {With<PageExplorer, "arm" | "branches" | "question" | "first"> & {arm: ThreeLeverArm}}
 *   PlanExplorer
 */
/**
 * What is asked; `way`: the number of one of `branches`, `sides`: whether quadrilaterals, too.
 * @typedef {object} Question
 * @property {number[]} posture
 * @property {number[]} target  x, y
 * @property {number[]} obstacle  x, y
 * @property {number} distance
 * @property {number} way
 * @property {boolean} sides
 */
/**
 * What Python answers: `_answer` of plan_explorer.py says it.
 * @typedef {object} Answer
 * @property {string} verdict
 * @property {string} words
 * @property {boolean} kept
 * @property {Values} moments
 * @property {number[][]} via
 * @property {[place: number[], text: string]} nearest
 * @property {?{quadrilaterals: number[][][], says: string}} direct
 * @property {Values} cube
 * @property {number} most
 * @property {Values} curve
 */
/** @typedef {ReturnType<typeof read>} Shown  an answer as it is drawn */
/** @typedef {{q: number[], target: Point, obstacle: Point, distance: number, way: number}} State */

const FORBIDDEN = 255; // plan_explorer.py
const CUBE = {flat: null, view: [-1.05, 0.38]}; // from where it is seen
const STEPS = 9,
  MOMENTS = 16; // of search and motion, a second

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {PlanExplorer} data
 */
export const explore = (id, data) =>
  waiting(id).forEach(root => planExplorer(stageOf(root, data), root, id, data));

/**
 * @param {Stage} stage
 * @param {HTMLElement} root
 * @param {string} id
 * @param {PlanExplorer} data
 */
function planExplorer(stage, root, id, data) {
  const {words: says, unit} = data,
    first = /** @type {Question} */ (data.question);
  /** @type {ThreeLeverArm} */
  const arm = data.arm;
  /** @type {State} */
  const state = {
    q: [...first.posture],
    target: [...first.target, 0],
    obstacle: [...first.obstacle, 0],
    distance: first.distance,
    way: first.way,
  };
  let shown = read(/** @type {Answer} */ (unpacked(data.first)), first),
    asked = JSON.stringify(first);
  /** @type {{about?: Shown, looks?: string}} */
  let drawn = {}; // in the cube: drawing it takes longest
  const time = {wave: shown.most, moment: 0, playing: false, before: 0},
    seen = {view: [...CUBE.view]};

  /** @type {() => Question} */
  const question = () => ({
    posture: state.q,
    target: state.target.slice(0, 2),
    obstacle: state.obstacle.slice(0, 2),
    distance: state.distance,
    way: state.way,
    sides: sides.on(),
  });
  /** @type {(q: number[]) => Point} */
  const grip = q => origin(fk(arm.chain, q));
  /** @type {(p: Point) => string} */
  const place = p =>
    p
      .slice(0, 2)
      .map(x => number(x / unit.size, 3))
      .join(", ");

  const way = menu(says.way, data.branches, k => {
    state.way = k;
    stage.changed();
  });
  const distance = slider(data.controls[0], value => {
    state.distance = Math.min(Math.max(value, data.controls[0].low), data.controls[0].high) / 1000;
    stage.changed();
  });
  const sides = tick(says.quadrilaterals, stage.changed);
  const cube = control("canvas", {
    class: "rk-cube",
    role: "img",
    tabindex: 0,
    "aria-label": says.cube,
  });
  const play = control("button", {type: "button", class: "rk-word rk-play"}, says.play);
  const wave = range(says.search, 1),
    moment = range(says.motion, 1),
    verdict = element("p", {class: "rk-verdict"});
  /** @type {(name: string, input: HTMLElement) => HTMLElement} */
  const own = (name, input) =>
    element("label", {class: "rk-slide"}, element("span", {}, name), input);
  stage.side.append(
    distance.row,
    way.row,
    element(
      "div",
      {class: "rk-row"},
      sides.row,
      copyButton(says, () =>
        fill(data.code, {
          posture: state.q.join(", "),
          target: question().target.join(", "),
          obstacle: question().obstacle.join(", "),
          distance: state.distance,
        }),
      ),
    ),
  );
  // What needs no kernel stands beside: it lives where the rest sleeps.
  stage.side.after(
    element(
      "div",
      {class: "rk-own"},
      cube,
      element(
        "div",
        {class: "rk-run"},
        play,
        element("div", {}, own(says.search, wave), own(says.motion, moment)),
      ),
    ),
  );
  stage.title.after(verdict);
  stage.below.append(stage.says);

  const stop = () => {
    time.playing = false;
  };
  wave.addEventListener("input", () => {
    stop();
    time.wave = +wave.value;
    stage.changed();
  });
  moment.addEventListener("input", () => {
    stop();
    time.moment = +moment.value;
    stage.changed();
  });
  play.addEventListener("click", () => {
    time.playing = !time.playing;
    if (time.playing && time.moment >= last()) time.wave = time.moment = 0;
    time.before = performance.now();
    stage.changed();
  });
  const last = () => shown.moments.length - 1;
  function pass() {
    // time goes on: the search first, then the motion
    const now = performance.now(),
      passed = Math.min(0.2, (now - time.before) / 1000);
    time.before = now;
    if (time.wave < shown.most) time.wave = Math.min(shown.most, time.wave + STEPS * passed);
    else time.moment = Math.min(last(), time.moment + MOMENTS * passed);
    if (time.wave >= shown.most && time.moment >= last()) stop();
  }

  /** @type {(name: string, color: Color, at: () => Point, take: (p: Point) => void) => Handle} */
  const handle = (name, color, at, take) => {
    const home = [...at()];
    return {
      id: name,
      name: says[name],
      look: "rk-mark",
      mark: name,
      color,
      at,
      value: () => `${place(at())} ${unit.name}`,
      grab(view) {
        const to = inScreen(view, at());
        return (dx, dy) => take([...to(dx, dy).slice(0, 2), 0]);
      },
      step(right, up, big) {
        const by = ((big ? 0.1 : 0.01) * arm.reach) / 3,
          [x, y] = at();
        take([x + by * right, y + by * up, 0]);
      },
      home() {
        take(home);
      },
    };
  };
  stage.handles.set([
    handle(
      "H",
      "alarm",
      () => state.obstacle,
      p => {
        state.obstacle = p;
      },
    ),
    handle(
      "K1",
      "joint3",
      () => state.target,
      p => {
        state.target = p;
      },
    ),
    // the start follows as far as the arm reaches, with the least movement
    handle(
      "K",
      "path",
      () => grip(state.q),
      p => {
        const q = least(arm, {place: p}, state.q);
        if (q.every(Number.isFinite)) state.q = q;
      },
    ),
  ]);

  /** @type {(answer: Answer, about: Question) => void} */
  function hear(answer, about) {
    const whole = time.wave >= shown.most;
    shown = read(answer, about);
    time.wave = whole ? shown.most : Math.min(time.wave, shown.most);
    time.moment = Math.min(time.moment, last());
    tell();
  }
  function tell() {
    wave.max = String(shown.most);
    moment.max = String(last());
    verdict.textContent = shown.verdict;
    verdict.classList.toggle("rk-past", !shown.kept);
    stage.changed();
  }
  tell();
  root.addEventListener("robokin-wake", () => {
    asked = JSON.stringify(shown.about);
    stage.changed();
  });
  const live = kernelOf(root, id, says, hear);

  stage.run(
    () => {
      const now = question(),
        text = JSON.stringify(now);
      if (text !== asked) live.ask(now);
      asked = text;
      if (time.playing) pass();
      way.set(state.way);
      distance.set(state.distance * 1000);
      wave.value = String(time.wave);
      wave.setAttribute(
        "aria-valuetext",
        fill(says.steps, {n: Math.floor(time.wave), most: shown.most}),
      );
      moment.value = String(time.moment);
      moment.setAttribute(
        "aria-valuetext",
        fill(says.share, {share: Math.round((100 * time.moment) / last())}),
      );
      play.textContent = time.playing ? says.pause : says.play;
      stage.say([state.way ? "" : shown.words, shown.direct?.says || ""].join(" ").trim());
      stage.scene.marks = [state.target, state.obstacle].map(at => ({name: "", at, radius: 0}));
      const k = Math.round(time.moment),
        begun = k > 0;
      const ghosts = [
        {q: shown.moments[last()], past: true},
        ...(begun ? [{q: state.q, past: false}] : []),
      ];
      return [
        {
          name: arm.name,
          chain: arm.chain,
          q: begun ? shown.moments[k] : state.q,
          ghosts,
          under: (g, cam) =>
            drawBelow(
              g,
              cam,
              shown,
              state,
              shown.moments.map(q => polyline(arm.chain, q)),
            ),
          over: (g, cam) => drawAbove(g, cam, shown, state),
        },
      ];
    },
    [cube],
    () => {
      const steps = Math.floor(time.wave),
        k = Math.round(time.moment);
      const looks = [steps, k, state.q, seen.view, cube.clientWidth, cube.clientHeight, colors.ink];
      if (drawn.about !== shown || drawn.looks !== looks.join())
        drawCube(cube, seen.view, shown, steps, k, state.q);
      drawn = {about: shown, looks: looks.join()};
      if (time.playing) stage.changed();
    },
  );
  orbit(cube, CUBE, seen, stage.changed);
}

/**
 * An answer with all that is drawn of it.
 * @param {Answer} answer
 * @param {Question} about
 */
const read = (answer, about) => ({
  ...answer,
  about,
  moments: rows(answer.moments),
  curve: rows(answer.curve),
  faces: facesOf(answer.cube),
});

/**
 * The rows of an array, as arrays.
 * @param {Values} array
 */
const rows = ({values, shape: [count, width]}) =>
  Array.from({length: count}, (_, k) => Array.from(values.subarray(k * width, (k + 1) * width)));

/**
 * The room about H, the quadrilaterals, what the levers sweep, the gripper's path.
 * @param {Context} g
 * @param {Camera} camera
 * @param {Shown} shown
 * @param {State} state
 * @param {Point[][]} postures  the ends of the levers
 */
function drawBelow(g, {to, scale}, {kept, direct}, state, postures) {
  const [x, y] = to(state.obstacle);
  g.beginPath();
  g.arc(x, y, state.distance * scale, 0, 2 * Math.PI);
  g.fillStyle = clear(colors.ghost, 0.25);
  g.fill();
  g.strokeStyle = colors.ghost;
  g.lineWidth = 1;
  g.stroke();
  /** @type {(points: number[][]) => Pixel[]} */
  const flat = points => points.map(([x, y]) => to([x, y, 0]));
  direct?.quadrilaterals.forEach((corners, k) => {
    const color = [colors.joint3, colors.joint2][k],
      points = flat(corners);
    polygon(g, points, clear(color, 0.12), color, 1.2);
    words(g, ["AK", "BA"][k], mean(points, 0), mean(points, 1), color, 12, "center", "600");
  });
  const color = kept ? colors.accent : colors.alarm;
  stroke(
    g,
    postures.flatMap(points => [...points.map(to), null]),
    clear(color, 0.3),
    1,
  );
  stroke(
    g,
    postures.map(points => to(points[points.length - 1])),
    color,
    2,
  );
}

/** @type {(points: Pixel[], k: number) => number} */
const mean = (points, k) => points.reduce((sum, p) => sum + p[k], 0) / points.length;

/**
 * The obstacle, via points, and how near the levers come.
 * @param {Context} g
 * @param {Camera} camera
 * @param {Shown} shown
 * @param {State} state
 */
function drawAbove(g, {to}, {via, nearest: [at, text], kept}, state) {
  const [x, y] = to(state.obstacle),
    p = to([...at, 0]),
    far = Math.hypot(p[0] - x, p[1] - y);
  for (const side of [-1, 1])
    stroke(
      g,
      [
        [x - 6, y - 6 * side],
        [x + 6, y + 6 * side],
      ],
      colors.alarm,
      3.5,
    );
  if (far > 3) stroke(g, [[x, y], p], colors.near, 2);
  spot(g, p, 3.5, colors.near);
  // where it is swept, to the left: the tool's frame points to the right
  const left = p[0] <= x + 1;
  words(
    g,
    text,
    p[0] + (left ? -16 : 9),
    p[1] + (far > 3 ? (p[1] < y ? -8 : 17) : 34),
    kept ? colors.near : colors.alarm,
    12.5,
    left ? "right" : "left",
    "600",
  );
  via.forEach((point, k) => {
    const place = to([...point, 0]);
    spot(g, place, 4, colors.path);
    words(g, `K${k + 2}`, place[0] - 8, place[1] + (k ? 15 : -5), colors.path, 12, "right", "600");
  });
}

/**
 * The faces of the forbidden body by direction (axis and side): cells [i, j, k] that have one
 * there.
 * @param {Values} cube
 */
function facesOf({values, shape: [n]}) {
  /** @type {(i: number, j: number, k: number) => boolean} */
  const forbidden = (i, j, k) =>
    Math.min(i, j, k) >= 0 && Math.max(i, j, k) < n && values[(i * n + j) * n + k] === FORBIDDEN;
  const faces = [0, 1, 2].map(() => /** @type {number[][][]} */ ([[], []]));
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++)
      for (let k = 0; k < n; k++) {
        if (!forbidden(i, j, k)) continue;
        for (let axis = 0; axis < 3; axis++)
          for (const side of [0, 1]) {
            /** @type {[number, number, number]} */
            const next = [i, j, k];
            next[axis] += side ? 1 : -1;
            if (!forbidden(...next)) faces[axis][side].push([i, j, k]);
          }
      }
  return faces;
}

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map(k => [k & 1, (k >> 1) & 1, k >> 2]);
const RING = [
  [-0.5, -0.5],
  [0.5, -0.5],
  [0.5, 0.5],
  [-0.5, 0.5],
];

/**
 * The cube of postures, its side being 1: the body, the wave after so many steps, target, path and
 * posture.
 * @param {HTMLCanvasElement} canvas
 * @param {number[]} view
 * @param {Shown} shown
 * @param {number} steps
 * @param {number} moment
 * @param {number[]} q
 */
function drawCube(
  canvas,
  view,
  {
    cube: {
      values,
      shape: [n],
    },
    faces,
    curve,
    moments,
    kept,
  },
  steps,
  moment,
  q,
) {
  const ready = prepared(canvas);
  if (!ready) return;
  const [g, w, h] = ready,
    {to, toward, scale} = camera(view, CORNERS, [20, 10, w - 40, h - 34]);
  /** @type {(p: Point) => number} */
  const depth = ([x, y, z]) => x * toward[0] + y * toward[1] + z * toward[2];
  /** @type {(q: number[]) => Point} */
  const unit = q => q.map(x => x / Math.PI);
  /** @type {{depth: number, draw: () => void}[]} */
  const things = [];
  /** @type {(at: Point, draw: () => void) => number} */
  const put = (at, draw) => things.push({depth: depth(at), draw});
  for (const [i, a] of CORNERS.entries())
    for (const b of CORNERS.slice(i + 1))
      if (a.reduce((sum, x, k) => sum + Math.abs(x - b[k]), 0) === 1)
        stroke(g, [to(a), to(b)], colors.line, 1);
  const shades = [colors.shine, colors.rod, colors.rodShine];
  for (let axis = 0; axis < 3; axis++) {
    const side = toward[axis] > 0 ? 1 : 0,
      [a, b] = [0, 1, 2].filter(k => k !== axis);
    for (const cell of faces[axis][side]) {
      const at = [...cell];
      at[axis] += side - 0.5;
      put(
        at.map(x => x / (n - 1)),
        () =>
          polygon(
            g,
            RING.map(([s, t]) => {
              const corner = [...at];
              corner[a] += s;
              corner[b] += t;
              return to(corner.map(x => Math.min(1, Math.max(0, x / (n - 1)))));
            }),
            shades[axis],
            clear(colors.paper, 0.5),
            0.5,
          ),
      );
    }
  }
  const dot = Math.max(2, (0.28 * scale) / n);
  for (let i = 0; i < n; i++)
    for (let j = 0; j < n; j++)
      for (let k = 0; k < n; k++) {
        if (values[(i * n + j) * n + k] !== steps) continue;
        const at = [i, j, k].map(x => x / (n - 1));
        put(at, () => {
          const [x, y] = to(at);
          g.fillStyle = clear(colors.accent, 0.65);
          g.fillRect(x - dot / 2, y - dot / 2, dot, dot);
        });
      }
  const color = kept ? colors.joint2 : colors.alarm,
    way = moments.map(unit);
  for (let k = 1; k < way.length; k++)
    put(way[k], () => stroke(g, [to(way[k - 1]), to(way[k])], color, 3));
  for (const at of curve.map(unit))
    put(at, () => {
      const [x, y] = to(at);
      polygon(
        g,
        [
          [x, y - 5],
          [x + 4, y + 3],
          [x - 4, y + 3],
        ],
        colors.joint3,
        colors.paper,
        0.5,
      );
    });
  things.sort((a, b) => a.depth - b.depth).forEach(thing => thing.draw());
  stroke(g, way.map(to), clear(color, 0.5), 1, [3, 3]); // what lies behind the body, too
  spot(g, to(unit(moment ? moments[moment] : q)), 5, colors.path);
  /** @type {[string, Point][]} */
  const angles = [
    ["\u03B3", [0.5, 0, 0]],
    ["\u03B2", [1, 0.5, 0]],
    ["\u03B1", [0, 0, 0.5]],
  ];
  for (const [name, at] of angles) {
    const [x, y] = to(at),
      [mx, my] = to([0.5, 0.5, 0.5]),
      far = Math.hypot(x - mx, y - my) || 1;
    words(
      g,
      `${name} 0\u2013180\u00B0`,
      x + (14 * (x - mx)) / far,
      y + (18 * (y - my)) / far + 4,
      colors.soft,
      12,
      x < mx - 40 ? "right" : x > mx + 40 ? "left" : "center",
    );
  }
}
