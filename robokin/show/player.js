// The player of robokin: an arm in space beside its curves. Plain script, no library, no network.
// Python wraps this file in a function and calls play(id, data); robokin/show/player.py says how data is made.
//
// Three parts that know nothing of each other's source: sceneView and curvesView draw what they are given; play
// decodes the recorded motions, owns time, slider and buttons, and asks both views to draw. Metres and radians in the
// scene; degrees and mm (or m) in the curves. A rigid transform is 12 numbers: the rows of [R | p].
// The live views (live.js, behind this file in one module) draw with the same parts.

const INK = "#1F2933", SOFT = "#5F6B76", LINE = "#C9D0D6", GRID = "#E4E8EB", ALARM = "#B3261E", PATH = "#1B2A41",
      EDGE = "#27323C";
const AXES = ["#C62828", "#2E7D32", "#1F55C4"]; // x, y, z: red, green, blue
const FONT = "system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', sans-serif";
const MINUS = "\u2212";

// --- Kinematics -----------------------------------------------------------------------------------------------------

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

function compose(a, b) {
  const c = new Array(12);
  for (let r = 0; r < 12; r += 4)
    for (let k = 0; k < 4; k++)
      c[r + k] = a[r] * b[k] + a[r + 1] * b[4 + k] + a[r + 2] * b[8 + k] + (k === 3 ? a[r + 3] : 0);
  return c;
}

function motion({axis: [x, y, z], prismatic}, q) {
  if (prismatic) return [1, 0, 0, x * q, 0, 1, 0, y * q, 0, 0, 1, z * q];
  const c = Math.cos(q), s = Math.sin(q), v = 1 - c;
  return [c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0,
          y * x * v + z * s, c + y * y * v, y * z * v - x * s, 0,
          z * x * v - y * s, z * y * v + x * s, c + z * z * v, 0];
}

// The frames of a posture: base, after each link, the last one being the flange; as arm.frames(q) in Python.
// Where given, `joints` and `moved` receive the frame of each joint before and after its own motion.
function frames(chain, q, joints = [], moved = []) {
  const all = [IDENTITY];
  chain.forEach((link, i) => {
    joints[i] = compose(all[i], link.before);
    moved[i] = compose(joints[i], motion(link, q[i]));
    all.push(compose(moved[i], link.after));
  });
  return all;
}

const origin = m => [m[3], m[7], m[11]];
const turned = (m, [x, y, z]) => [m[0] * x + m[1] * y + m[2] * z, m[4] * x + m[5] * y + m[6] * z,
                                  m[8] * x + m[9] * y + m[10] * z];
const plus = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);

// --- Canvas ---------------------------------------------------------------------------------------------------------

// The context of a canvas, sized to its place on the page at the screen's own resolution and wiped.
function prepared(canvas) {
  const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
  if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
  }
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, w, h);
  g.lineCap = g.lineJoin = "round";
  return [g, w, h];
}

function stroke(g, points, color, width, dash = []) {
  g.strokeStyle = color;
  g.lineWidth = width;
  g.setLineDash(dash);
  g.beginPath();
  let pen = false;
  for (const p of points) {
    if (!p || Number.isNaN(p[1])) pen = false;
    else if (pen) g.lineTo(p[0], p[1]);
    else { g.moveTo(p[0], p[1]); pen = true; }
  }
  g.stroke();
  g.setLineDash([]);
}

// Fills and outlines what `draw` traces.
function shape(g, draw, fill, edge, width) {
  g.beginPath();
  draw();
  g.closePath();
  g.fillStyle = fill;
  g.fill();
  if (!width) return;
  g.strokeStyle = edge;
  g.lineWidth = width;
  g.stroke();
}

const polygon = (g, points, ...look) => shape(g, () => points.forEach(p => g.lineTo(...p)), ...look);
const dot2 = (g, [x, y], radius, fill, edge = "white", width = 1.5) =>
  shape(g, () => g.arc(x, y, radius, 0, 2 * Math.PI), fill, edge, width);

// Words with a white seam, readable over lines.
function words(g, text, x, y, color = INK, size = 12, align = "left", weight = "") {
  g.font = `${weight} ${size}px ${FONT}`;
  g.textAlign = align;
  g.lineWidth = 3.5;
  g.strokeStyle = "rgba(255,255,255,.9)";
  g.strokeText(text, x, y);
  g.fillStyle = color;
  g.fillText(text, x, y);
}

// How many columns and rows several arms take in a width.
function tiled(count, width) {
  const rows = Math.ceil(count / Math.max(1, Math.min(count, Math.floor(width / 260))));
  return [Math.ceil(count / rows), rows];
}

const number = (x, decimals) => x.toFixed(decimals).replace(/^-(?=0\.?0*$)/, "").replace("-", MINUS);

// --- The scene ------------------------------------------------------------------------------------------------------

// A parallel projection that fits the corner points into a rectangle.
function camera([azimuth, elevation], corners, [left, top, width, height]) {
  const ca = Math.cos(azimuth), sa = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
  const right = [-sa, ca, 0], up = [-se * ca, -se * sa, ce], toward = [ce * ca, ce * sa, se];
  const xs = corners.map(p => dot(p, right)), ys = corners.map(p => dot(p, up));
  const x0 = Math.min(...xs), x1 = Math.max(...xs), y0 = Math.min(...ys), y1 = Math.max(...ys);
  const scale = Math.min(width / (x1 - x0 || 1), height / (y1 - y0 || 1));
  const cx = left + width / 2 - scale * (x0 + x1) / 2, cy = top + height / 2 + scale * (y0 + y1) / 2;
  return {scale, toward, to: p => [cx + scale * dot(p, right), cy - scale * dot(p, up)],
          along: v => [scale * dot(v, right), -scale * dot(v, up)]};
}

// Draws arms in space. scene: what stands still (targets, marks, floor, box to be seen, size, unit, joint colours).
// With `grows` the picture shrinks where an arm or a target leaves it.
// draw(view, arms, clock): view [azimuth, elevation]; arms [{name, chain, q, trace, tail, faded, near}]: q in
// radians and metres, trace the tool's places, tail those behind it, near where it passes "via"; and
// where given, ghosts [{q, past}]: other postures, faint, broken lines where `past` a limit; framed: show every frame.
function sceneView(canvas, scene) {
  const flat = scene.flat !== null, size = scene.size;
  const [a, b] = flat ? [0, 1, 2].filter(i => i !== scene.flat) : [0, 1]; // the axes of the grid
  const normal = flat ? scene.flat : 2;
  const [floor, ceiling] = scene.floor, {grid} = scene;
  const at = (x, y) => { const p = [0, 0, 0]; p[a] = x; p[b] = y; p[normal] = flat ? 0 : floor[2]; return p; };
  const corners = [...scene.seen];
  for (const x of [floor[a], ceiling[a]]) for (const y of [floor[b], ceiling[b]]) corners.push(at(x, y));

  function draw(view, arms, clock) {
    const [g, w, h] = prepared(canvas);
    const [columns, rows] = tiled(arms.length, w), cw = w / columns, ch = h / rows;
    arms.forEach((arm, i) => {
      const x = (i % columns) * cw, y = Math.floor(i / columns) * ch;
      g.save();
      g.beginPath();
      g.rect(x, y, cw, ch);
      g.clip();
      drawOne(g, view, arm, [x, y, cw, ch], arms.length > 1);
      g.restore();
      if (i % columns) stroke(g, [[x, y + 10], [x, y + ch - 10]], GRID, 1);
    });
    words(g, clock, w - 10, 18, INK, 13, "right", "600");
    const unit = scene.unit;
    words(g, `grid ${+(grid / unit.size).toPrecision(6)} ${unit.name}`, 10, h - 10, SOFT, 12);
  }

  function drawOne(g, view, arm, [x, y, w, h], named) {
    const joints = [], moved = [];
    const all = frames(arm.chain, arm.q, joints, moved);
    const exists = arm.q.every(Number.isFinite);
    const cam = camera(view, scene.grows ? [...corners, ...reached(arm, all)] : corners, [x + 26, y + 30, w - 52, h - 62]);
    const {to} = cam;
    drawFloor(g, to);
    const sunk = p => { const s = [...p]; s[2] = floor[2]; return to(s); };
    const rods = exists ? limbs(all, joints, moved) : [];
    const thick = Math.min(15, Math.max(5, 0.045 * size * cam.scale));
    if (!flat) {
      stroke(g, arm.trace.map(p => p && sunk(p)), "rgba(95,107,118,.16)", 1.5);
      for (const [p, q] of rods) stroke(g, [sunk(p), sunk(q)], "rgba(95,107,118,.13)", thick);
    }
    for (const mark of scene.marks) if (mark.radius) disc(g, to(mark.at), mark.radius * cam.scale);
    drawRoute(g, to);
    stroke(g, arm.trace.map(p => p && to(p)), "rgba(27,42,65,.45)", 1.4, [1, 4]);
    drawFoot(g, cam, rods.length ? 1 : 0.4);
    for (const {q, past} of arm.ghosts || []) stroke(g, frames(arm.chain, q).map(f => to(origin(f))), "rgba(71,85,99,.42)",
      Math.max(2, 0.3 * thick), past ? [3, 7] : []);
    g.globalAlpha = arm.faded ? 0.3 : 1;
    drawArm(g, cam, arm, rods, joints, thick);
    if (arm.framed) for (const frame of all) triad(g, cam, frame, 0.08 * size, 1.8, 1);
    g.globalAlpha = 1;
    if (arm.tail.length > 1) {
      stroke(g, arm.tail.map(p => p && to(p)), "rgba(255,255,255,.85)", 4.5);
      stroke(g, arm.tail.map(p => p && to(p)), PATH, 2.2);
    }
    const taken = arm.trace.filter(p => p).map(to), labels = [];
    for (const mark of scene.marks) {
      if (!mark.radius) dot2(g, to(mark.at), 3.5, PATH);
      if (mark.name) labels.push({text: mark.name, at: to(mark.at), color: SOFT});
    }
    for (const {name, pose} of scene.targets) {
      triad(g, cam, pose, 0.09 * size, 1.8, 0.95).forEach(tip => {
        const from = to(origin(pose));
        for (let k = 1; k < 8; k++) taken.push([from[0] + k / 7 * (tip[0] - from[0]), from[1] + k / 7 * (tip[1] - from[1])]);
      });
      dot2(g, to(origin(pose)), 2.6, PATH, "white", 1);
      labels.push({text: name, at: to(origin(pose)), color: INK, weight: "600"});
    }
    if (arm.near) {
      const via = scene.targets.find(t => t.name === "via"), p = to(origin(via.pose)), q = to(arm.near.place);
      if (Math.hypot(p[0] - q[0], p[1] - q[1]) > 3) stroke(g, [p, q], "#9C4A00", 1.6, [4, 3]);
      labels.push({text: arm.near.text, at: middle(p, q), color: "#9C4A00"});
    }
    if (exists) {
      g.globalAlpha = arm.faded ? 0.4 : 1;
      const flange = all[all.length - 1];
      triad(g, cam, flange, 0.13 * size, 3, 1, true);
      dot2(g, to(origin(flange)), 3.6, "white", PATH, 1.8);
      g.globalAlpha = 1;
    }
    place(g, labels, taken, [x + 4, y + 26, w - 8, h - 50]);
    compass(g, cam, [x + w - 34, y + h - 34]);
    if (named) words(g, arm.name, x + 10, y + 18, INK, 13, "left", "600");
    if (arm.faded) words(g, "no solution here", x + w / 2, y + (named ? 40 : 22), ALARM, 14, "center", "600");
  }

  function drawFloor(g, to) {
    const line = (p, q, value) => stroke(g, [to(p), to(q)], Math.abs(value) < grid / 9 ? LINE : GRID, 1);
    for (let x = floor[a]; x < ceiling[a] + grid / 9; x += grid) line(at(x, floor[b]), at(x, ceiling[b]), x);
    for (let y = floor[b]; y < ceiling[b] + grid / 9; y += grid) line(at(floor[a], y), at(ceiling[a], y), y);
  }

  // What a scene that grows has to hold besides.
  const reached = (arm, all) => [...[...all, ...scene.targets.map(target => target.pose),
    ...(arm.ghosts || []).flatMap(({q}) => frames(arm.chain, q))].map(origin), ...scene.marks.map(mark => mark.at)]
    .filter(p => p.every(Number.isFinite));

  // The straight way from target to target, where they are stations of one path.
  function drawRoute(g, to) {
    const stations = ["start", "via", "goal"].map(n => scene.targets.find(t => t.name === n)).filter(t => t);
    if (stations.length > 1) stroke(g, stations.map(t => to(origin(t.pose))), "rgba(95,107,118,.55)", 1, [7, 5]);
  }

  function drawFoot(g, cam, alpha) {
    const ring = Array.from({length: 40}, (_, i) => {
      const p = [0, 0, 0], t = i * Math.PI / 20;
      p[a] = 0.06 * size * Math.cos(t);
      p[b] = 0.06 * size * Math.sin(t);
      return cam.to(p);
    });
    g.globalAlpha = alpha;
    if (!flat && floor[2] < -1e-9) stroke(g, [cam.to([0, 0, 0]), cam.to([0, 0, floor[2]])], LINE, 6);
    polygon(g, ring, "#D3D9DE", "#8A96A1", 1.2);
    g.globalAlpha = 1;
  }

  // The straight pieces of a posture: [from, to, is the rod of a prismatic joint].
  function limbs(all, joints, moved) {
    const pieces = [];
    joints.forEach((joint, i) => {
      pieces.push([origin(all[i]), origin(joint), false], [origin(joint), origin(moved[i]), true],
                  [origin(moved[i]), origin(all[i + 1]), false]);
    });
    return pieces.filter(([p, q]) => distance(p, q) > 1e-6 * size);
  }

  // Links and joints, the farther ones first.
  function drawArm(g, cam, arm, rods, joints, thick) {
    const things = rods.map(([p, q, rod]) => ({
      depth: dot(plus(p, q), cam.toward) / 2,
      draw: () => limb(g, cam.to(p), cam.to(q), rod ? 0.55 * thick : thick, rod)}));
    if (rods.length) joints.forEach((joint, i) => {
      const axis = turned(joint, arm.chain[i].axis), p = origin(joint);
      const shrink = joints.length > 3 && i >= joints.length - 3 ? 0.72 : 1;
      const style = scene.styles[i % scene.styles.length];
      things.push({depth: dot(p, cam.toward) + 0.02 * size, draw: () => arm.chain[i].prismatic
        ? box(g, cam, p, axis, 0.8 * thick * shrink, style.color)
        : drum(g, cam, p, axis, 0.72 * thick * shrink, style.color)});
    });
    things.sort((p, q) => p.depth - q.depth).forEach(thing => thing.draw());
  }

  return {draw};
}

const middle = (p, q) => [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2];

function limb(g, p, q, width, rod) {
  const [edge, body, light] = rod ? ["#5F6B76", "#AEB8C1", "#D5DCE2"] : [EDGE, "#4B5966", "#7D8B98"];
  const lift = [-0.16 * width, -0.2 * width], up = ([x, y]) => [x + lift[0], y + lift[1]];
  stroke(g, [p, q], "rgba(255,255,255,.9)", width + 3);
  stroke(g, [p, q], edge, width);
  stroke(g, [p, q], body, width - 2);
  stroke(g, [up(p), up(q)], light, 0.22 * width);
}

// A joint that turns, as a drum around its axis, with a band of the joint's colour.
function drum(g, cam, p, axis, radius, color) {
  const [cx, cy] = cam.to(p), [dx, dy] = cam.along(axis), long = Math.hypot(dx, dy) / cam.scale;
  const facing = Math.abs(dot(axis, cam.toward)), angle = Math.atan2(dy, dx);
  const half = 0.85 * radius * long, side = dot(axis, cam.toward) > 0 ? 1 : -1; // half its length on the screen
  g.save();
  g.translate(cx, cy);
  g.rotate(angle);
  const arc = (place, r, from, to) => g.ellipse(side * place, 0, r * facing + 1e-6, r, 0, from, to, side < 0);
  const body = () => { arc(half, radius, -Math.PI / 2, Math.PI / 2); arc(-half, radius, Math.PI / 2, -Math.PI / 2); };
  const face = r => () => g.ellipse(side * half, 0, r * facing + 1e-6, r, 0, 0, 2 * Math.PI);
  shape(g, body, color, "white", 3);
  shape(g, body, color, EDGE, 1.2);
  shape(g, face(radius), color, EDGE, 1);
  shape(g, face(0.45 * radius), "white");
  g.restore();
}

// A joint that shifts, as a square guide.
function box(g, cam, p, axis, radius, color) {
  const [x, y] = cam.to(p), [dx, dy] = cam.along(axis), angle = Math.atan2(dy, dx) + Math.PI / 4, r = Math.SQRT2 * radius;
  const corners = [0, 1, 2, 3].map(k => angle + k * Math.PI / 2).map(t => [x + r * Math.cos(t), y + r * Math.sin(t)]);
  polygon(g, corners, color, EDGE, 1.2);
}

function disc(g, [x, y], radius) {
  const shade = g.createRadialGradient(x - radius / 3, y - radius / 3, radius / 8, x, y, radius);
  shade.addColorStop(0, "rgba(226,189,140,.75)");
  shade.addColorStop(1, "rgba(176,124,62,.75)");
  dot2(g, [x, y], radius, shade, "#7A5426", 1.2);
}

// The axes of a frame; returns their tips on the screen.
function triad(g, cam, pose, length, width, alpha, letters = false) {
  const p = origin(pose), from = cam.to(p), before = g.globalAlpha;
  const axes = [0, 1, 2].map(k => [k, [pose[k], pose[4 + k], pose[8 + k]]]);
  axes.sort((m, n) => dot(m[1], cam.toward) - dot(n[1], cam.toward));
  g.globalAlpha = before * alpha;
  const tips = axes.map(([k, axis]) => {
    const tip = cam.to(plus(p, axis, length));
    stroke(g, [from, tip], "white", width + 2);
    stroke(g, [from, tip], AXES[k], width);
    return [k, tip];
  });
  if (letters) for (const [k, tip] of tips) {
    const d = [tip[0] - from[0], tip[1] - from[1]], l = Math.hypot(...d);
    if (l > 0.35 * length * cam.scale) words(g, "xyz"[k], tip[0] + 8 * d[0] / l, tip[1] + 8 * d[1] / l + 4, AXES[k], 12, "center", "600");
  }
  g.globalAlpha = before;
  return tips.map(([, tip]) => tip);
}

// Where x, y and z of the base point, in a corner.
function compass(g, cam, [x, y]) {
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, k) => {
    const [dx, dy] = cam.along(axis), l = Math.hypot(dx, dy) / cam.scale;
    if (l < 0.1) return;
    const tip = [x + 18 * dx / cam.scale, y + 18 * dy / cam.scale];
    stroke(g, [[x, y], tip], AXES[k], 1.4);
    words(g, "xyz"[k], tip[0] + 7 * dx / cam.scale / l, tip[1] + 7 * dy / cam.scale / l + 3.5, AXES[k], 10, "center");
  });
}

// Writes each label beside its point where it covers least: other labels, lines, the rim.
function place(g, labels, taken, [left, top, width, height]) {
  const done = [];
  for (const label of labels) {
    g.font = `${label.weight || ""} 12px ${FONT}`;
    const w = g.measureText(label.text).width + 4, h = 16, [px, py] = label.at;
    let best = null;
    for (const gap of [5, 14, 26, 40]) for (let k = 0; k < 12; k++) {
      const c = Math.cos(k * Math.PI / 6), s = -Math.sin(k * Math.PI / 6);
      const x = px + c * (gap + w / 2) - w / 2, y = py + s * (gap + h / 2) - h / 2;
      let cost = gap / 6 + (1 - c) / 2 + (1 + s) / 2;
      for (const [qx, qy] of taken) if (qx > x - 3 && qx < x + w + 3 && qy > y - 2 && qy < y + h + 2) cost += 3;
      if (hit([x, y, w, h], done)) cost += 100;
      cost += 3 * (Math.max(0, left - x) + Math.max(0, x + w - left - width)
                   + Math.max(0, top - y) + Math.max(0, y + h - top - height));
      if (!best || cost < best[0]) best = [cost, x, y];
    }
    const [, x, y] = best;
    done.push([x, y, w, h]);
    words(g, label.text, x + 2, y + 12, label.color, 12, "left", label.weight);
  }
}

// --- The curves -----------------------------------------------------------------------------------------------------

// Draws columns of panels over one time axis. draw(columns, times, ticks, now): a column is {title, panels}, a panel
// {label, axes: [{unit, scale: [low, step, count, decimals], joints}], curves (per joint an array over times),
// gaps (Set of samples after which the line breaks), limits [low, high] (per joint), near [[joint, 0 low or 1 high]]:
// the limits to show, marks [{time, text}], now (per joint)}. timeAt(x, y): which time a place stands for.
function curvesView(canvas, styles) {
  let spans = [];
  const style = j => styles[j % styles.length];
  const shade = ({color}) => `color-mix(in srgb, ${color} 60%, ${INK})`; // fit for words

  function draw(columns, times, ticks, now) {
    const [g, w, h] = prepared(canvas);
    const t0 = times[0], t1 = times[times.length - 1];
    spans = [];
    const [across, rows] = tiled(columns.length, w);
    columns.forEach((column, c) => {
      const width = w / across, height = h / rows, titled = columns.length > 1;
      const left = (c % across) * width, above = Math.floor(c / across) * height;
      const right = column.panels.some(p => p.axes.length > 1) ? 46 : 16;
      const area = [left + 48, width - 48 - right];
      const below = legend(g, column, left + 48, width - 48 - right, above + (titled ? 36 : 14));
      if (titled) words(g, column.title, left + 48, above + 14, INK, 13, "left", "600");
      const bottom = above + height - 24, count = column.panels.length, tall = (bottom - below) / count;
      const x = t => area[0] + area[1] * (t - t0) / (t1 - t0);
      spans.push([area[0], area[1], t0, t1, left, above]);
      column.panels.forEach((panel, k) => {
        const top = below + k * tall + 26;
        drawPanel(g, panel, x, area, top, below + (k + 1) * tall - top - 4, times, ticks, now);
      });
      const [first, step, n, decimals] = ticks;
      for (let i = 0; i < n; i++) {
        const t = first + i * step;
        if (t < t0 - 1e-9 || t > t1 + 1e-9) continue;
        const unit = t + step > t1 + 1e-9 ? " s" : "";
        words(g, number(t, decimals) + unit, x(t) + (unit ? 4 : 0), bottom + 16, SOFT, 11, "center");
      }
    });
  }

  // Names with their lines, above the panels, evenly in as many rows as it takes; returns where the panels may begin.
  function legend(g, column, left, width, y) {
    const joints = column.panels[0].curves.length, rows = Math.ceil(joints * 38 / width), inRow = Math.ceil(joints / rows);
    const each = Math.min(56, width / inRow), long = each - 30;
    for (let j = 0; j < joints; j++) {
      const x = left + (j % inRow) * each, row = y + 16 * Math.floor(j / inRow);
      stroke(g, [[x, row - 4], [x + long, row - 4]], style(j).color, 2.2, dashes(style(j), 2.2));
      words(g, `q${j + 1}`, x + long + 4, row, INK, 12);
    }
    return y + 16 * (rows - 1) + 2;
  }

  function drawPanel(g, panel, x, [left, width], top, height, times, ticks, now) {
    const right = left + width, bottom = top + height, ys = [], units = [];
    const scales = panel.axes.map(({scale: [low, step, count], unit, joints}) => {
      const y = v => bottom - height * (v - low) / (step * (count - 1));
      for (const j of joints) { ys[j] = y; units[j] = unit; }
      return y;
    });
    words(g, panel.label, left - 40, top - 8, INK, 12, "left", "600");
    g.save();
    g.beginPath();
    g.rect(left, top - 1, width, height + 2);
    g.clip();
    const [low, step, count] = panel.axes[0].scale;
    for (let i = 0; i < count; i++) {
      const y = scales[0](low + i * step);
      stroke(g, [[left, y], [right, y]], Math.abs(low + i * step) < step / 9 ? LINE : GRID, 1);
    }
    for (let i = 0; i < ticks[2]; i++) upright(g, x(ticks[0] + i * ticks[1]), top, bottom, GRID, 1);
    for (const [j, side] of panel.near) band(g, ys[j](panel.limits[side][j]), side ? 1 : -1, left, right, style(j).color);
    for (const {time} of panel.marks) upright(g, x(time), top, bottom, ALARM, 1.2, [3, 3]);
    ys.forEach((y, j) => curve(g, panel, j, times, x, y));
    g.restore();
    g.lineWidth = 1;
    g.strokeStyle = "#9AA5AF";
    g.strokeRect(left, top, width, height);
    panel.axes.forEach(({scale: [low, step, count, decimals], unit, joints}, k) => {
      const color = k && joints.length === 1 ? shade(style(joints[0])) : SOFT;
      for (let i = 0; i < count; i++) {
        const y = scales[k](low + i * step) + 4;
        words(g, number(low + i * step, decimals), k ? right + 6 : left - 6, y, color, 11, k ? "left" : "right");
      }
      if (k) words(g, `${joints.map(j => `q${j + 1}`).join(" and ")}, ${unit}`, right + 42, top - 8, color, 12, "right", "600");
    });
    // The places of words are looked for once, not in every picture.
    const where = [left, top, width, height].join();
    if (panel.where !== where) {
      const rect = [left, right, top, bottom], notes = noted(g, panel.marks, x, rect);
      Object.assign(panel, {where, words: [...notes, ...limitWords(g, panel, ys, units, times, x, rect, notes)]});
    }
    for (const [text, [px, py, , h], color, size, weight] of panel.words) words(g, text, px, py + h - 2, color, size, "left", weight);
    upright(g, x(now), top, bottom, INK, 1.4);
    ys.forEach((y, j) => {
      const at = y(panel.now[j]);
      if (at > top - 3 && at < bottom + 3) dot2(g, [x(now), at], 4, style(j).color);
    });
    for (const {time, text} of panel.marks) if (text) for (const [y, tip] of [[top, top + 7], [bottom, bottom - 7]])
      polygon(g, [[x(time) - 5, y], [x(time) + 5, y], [x(time), tip]], ALARM);
  }

  // The words of the marks, in at most three lines: [text, [left, top, width, height], color, size, weight].
  function noted(g, marks, x, [left, right, top]) {
    const notes = [];
    g.font = `600 11px ${FONT}`;
    for (const {time, text} of marks) {
      if (!text) continue;
      const w = g.measureText(text).width;
      const px = x(time) + w + 12 > right ? Math.max(left + 3, x(time) - 6 - w) : x(time) + 6;
      const spot = [0, 1, 2].map(k => [px, top + 14 * k + 4, w, 12]).find(spot => !hit(spot, notes.map(note => note[1])));
      if (spot) notes.push([text, spot, ALARM, 11, "600"]);
    }
    return notes;
  }

  // The words of the limits, as above: beside their lines, off other words and, nearly, off the curves. At most three;
  // where there is no such place, the band alone has to do.
  function limitWords(g, panel, ys, units, times, x, [left, right, top, bottom], notes) {
    const found = [], curves = panel.curves.flatMap((curve, j) => Array.from(curve, (v, i) => [x(times[i]), ys[j](v)]));
    const each = (right - left) / times.length, lines = panel.near.map(([j, side]) => ys[j](panel.limits[side][j]));
    g.font = `10px ${FONT}`;
    panel.near.forEach(([j, side], k) => {
      const limit = panel.limits[side][j], at = lines[k], unit = units[j];
      const text = `q${j + 1} limit ${number(limit, +!Number.isInteger(limit))}${unit[0] === "\u00B0" ? "" : " "}${unit}`;
      const w = g.measureText(text).width, taken = [...notes, ...found].map(([, spot]) => spot);
      let best = null, least = 16; // pixels of curves that the words may cover
      for (const y of side ? [at - 13, at + 2] : [at + 2, at - 13]) for (let px = left + 5; px + w + 5 < right; px += 6) {
        const spot = [px, y, w, 11];
        if (y < top + 1 || y + 11 > bottom - 1 || hit([px - 4, y, w + 8, 11], taken)) continue;
        const cost = each * curves.filter(([cx, cy]) => cx > px - 3 && cx < px + w + 3 && cy > y - 1 && cy < y + 12).length
          + 20 * lines.filter(line => line > y && line < y + 11).length;
        if (cost < least) [best, least] = [spot, cost];
      }
      if (best && found.length < 3) found.push([text, best, shade(style(j)), 10]);
    });
    return found;
  }

  // The near side of what lies beyond a limit, a strip above (side 1) or below it.
  function band(g, at, side, left, right, color) {
    const fade = g.createLinearGradient(0, at, 0, at - 12 * side);
    fade.addColorStop(0, color + "59");
    fade.addColorStop(1, color + "0C");
    g.fillStyle = fade;
    g.fillRect(left, at, right - left, -12 * side);
    stroke(g, [[left, at], [right, at]], color, 1);
  }

  function curve(g, panel, j, times, x, y) {
    const {color} = style(j), points = [], beyond = [];
    panel.curves[j].forEach((value, i) => {
      const p = Number.isNaN(value) ? null : [x(times[i]), y(value)];
      const over = p && panel.limits && (value < panel.limits[0][j] - 1e-3 || value > panel.limits[1][j] + 1e-3);
      points.push(p);
      beyond.push(over ? p : null);
      if (panel.gaps.has(i)) { points.push(null); beyond.push(null); }
    });
    if (beyond.some(p => p)) stroke(g, beyond, "rgba(179,38,30,.35)", 7);
    g.lineCap = "butt";
    stroke(g, points, color, 2, dashes(style(j), 2));
    g.lineCap = "round";
  }

  // The time of a place on the canvas, in the column under it or, with `held`, in that column whatever the place;
  // and the number of the column.
  function timeAt(px, py, held = spans.findLastIndex(([, , , , left, above]) => px >= left && py >= above)) {
    const [left, width, t0, t1] = spans[Math.max(0, held)];
    return [t0 + (t1 - t0) * Math.min(1, Math.max(0, (px - left) / width)), Math.max(0, held)];
  }

  return {draw, timeAt};
}

const upright = (g, x, top, bottom, ...look) => stroke(g, [[x, top], [x, bottom]], ...look);
const hit = ([x, y, w, h], boxes) => boxes.some(([ox, oy, ow, oh]) => x < ox + ow && ox < x + w && y < oy + oh && oy < y + h);
const dashes = (style, width) => style.dash.map(x => x * width);

// --- Recorded motions -----------------------------------------------------------------------------------------------

// base64 -> whole numbers of 16 bits; what is such numbers already stays.
function integers(text) {
  if (typeof text !== "string") return text;
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Int16Array(bytes.buffer);
}

// One arm's motions. quantity(k, motion) -> per joint a Float64Array over the samples, in shown units, NaN where there
// is no value; q(motion, sample, share) -> joint values in radians and metres between two samples.
function recording(arm, samples, unit) {
  const n = arm.chain.length, whole = arm.data.map(integers);
  const inner = arm.chain.map(link => link.prismatic ? unit.size : Math.PI / 180);
  const value = (k, motion, i, j) => {
    const x = whole[k][(motion * samples + i) * n + j];
    return x === -32768 ? NaN : x * arm.steps[k][j];
  };
  return {
    quantity: (k, motion) => arm.chain.map((_, j) => Float64Array.from({length: samples}, (_, i) => value(k, motion, i, j))),
    q: (motion, i, share = 0) => arm.chain.map((_, j) => {
      const x = value(0, motion, i, j);
      return inner[j] * (share ? x + share * (value(0, motion, i + 1, j) - x) : x);
    }),
  };
}

// --- The page -------------------------------------------------------------------------------------------------------

const STYLE = `
.robokin-player { color-scheme: light; }
.rk.rk.rk { box-sizing: border-box; background: #fff; color: ${INK}; border: 1px solid #D5DADF; border-radius: 8px;
  padding: 12px 14px; font: 13px/1.4 ${FONT}; container-type: inline-size; max-width: 1400px;
  & * { box-sizing: border-box; }
  & .rk-title { font-weight: 650; font-size: 15px; margin: 0 0 6px; }
  & .rk-views { display: grid; grid-template-columns: minmax(0, 9fr) minmax(0, 10fr); gap: 8px; }
  & .rk-views.rk-wide { grid-template-columns: minmax(0, 1fr); }
  & canvas { display: block; width: 100%; height: clamp(400px, 52cqw, 560px); border-radius: 4px; margin: 0; }
  & .rk-scene { cursor: grab; touch-action: pan-y; }
  & .rk-scene.rk-flat { cursor: default; }
  & .rk-curves { cursor: crosshair; touch-action: pan-y; }
  & .rk-row { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; margin-top: 8px; }
  & .rk-row label { display: flex; align-items: center; gap: 8px; color: ${INK}; margin: 0; font: inherit; }
  & .rk-row label.rk-long { flex: 1 1 240px; min-width: 0; }
  & input[type=range] { flex: 1; min-width: 60px; width: 100%; margin: 0; height: 24px; accent-color: #0072B2; cursor: pointer; }
  & .rk-value { min-width: 4.6em; text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
  & button, & select { font: inherit; color: ${INK}; background: #F4F6F8; border: 1px solid #A9B3BC; border-radius: 6px;
    height: 30px; padding: 0 8px; margin: 0; cursor: pointer; }
  & button { width: 42px; }
  & button:hover, & select:hover { background: #E8ECEF; }
  & button svg { display: block; margin: auto; }
  & :focus-visible { outline: 3px solid #0072B2; outline-offset: 2px; }
  & .rk-table { overflow-x: auto; margin-top: 10px; }
  & table { border-collapse: collapse; width: 100%; margin: 0; font: inherit; color: ${INK}; border: 0; table-layout: auto; }
  & tr { background: none; border: 0; }
  & th, & td { padding: 4px 5px; text-align: right; border: 0; border-top: 1px solid #E4E8EB; font-weight: 400;
    font-variant-numeric: tabular-nums; white-space: nowrap; background: none; max-width: none; line-height: 1.3; }
  & thead th { border-top: 0; color: ${SOFT}; }
  & th:first-child { text-align: left; color: ${SOFT}; white-space: normal; min-width: 14.5em; padding-left: 0; }
  & .rk-jump { color: ${ALARM}; }
  & .rk-notes { margin: 6px 0 0; padding: 0; list-style: none; color: ${ALARM}; min-height: 0; }
  & .rk-notes li { margin: 2px 0; padding: 0; }
  @container (max-width: 640px) {
    & .rk-views { grid-template-columns: minmax(0, 1fr); }
    & canvas { height: 380px; }
    & th, & td { padding: 3px 4px; font-size: 11.5px; white-space: normal; }
    & th:first-child { min-width: 6.5em; }
  }
  @media print {
    & { border: 0; break-inside: avoid; }
    & .rk-views + .rk-row, & input { display: none; }
    & .rk-row label.rk-long { flex: none; }
    & .rk-value { min-width: 0; }
    & select { appearance: none; background: none; border: 0; padding: 0; }
  }
}`;

const PLAY = "M3 1.5v11l9-5.5z", PAUSE = "M3 1.5h3v11H3zM8 1.5h3v11H8z";
const KEYS = {ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};

function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

// JupyterLab takes arrow keys and Space for itself unless the very element with the focus forbids it.
const control = (tag, attributes, ...children) =>
  element(tag, {"data-lm-suppress-shortcuts": "true", ...attributes}, ...children);

const choice = (name, texts) => control("select", {"aria-label": name},
  ...texts.map((text, i) => element("option", {value: i}, text)));

const seenIn = (scene, alt) => alt + (scene.flat === null ? " Arrow keys turn the view, Home resets it." : "");
const sceneCanvasOf = (scene, alt) => control("canvas", {class: `rk-scene${scene.flat === null ? "" : " rk-flat"}`,
  role: "img", tabindex: 0, "aria-label": seenIn(scene, alt)});

// Dragging, arrow keys, Home and a double click turn state.view; `ask` gets it drawn.
function orbit(canvas, scene, state, ask) {
  if (scene.flat !== null) return;
  const turn = (dx, dy) => {
    state.view = [state.view[0] - dx, Math.min(1.57, Math.max(-0.3, state.view[1] + dy))];
    ask();
  };
  const reset = () => { state.view = [...scene.view]; ask(); };
  let grip = null;
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    grip = [event.clientX, event.clientY];
  });
  canvas.addEventListener("pointermove", event => {
    if (!canvas.hasPointerCapture(event.pointerId)) return;
    turn((event.clientX - grip[0]) / 120, (event.clientY - grip[1]) / 120);
    grip = [event.clientX, event.clientY];
  });
  canvas.addEventListener("dblclick", reset);
  canvas.addEventListener("keydown", event => {
    if (event.key in KEYS) turn(-KEYS[event.key][0] * 0.08, KEYS[event.key][1] * 0.08);
    else if (event.key === "Home") reset();
    else return;
    event.preventDefault();
  });
}

// Fills every waiting place with this id; the same player may stand twice in a page.
function play(id, data) {
  for (const root of document.querySelectorAll(`[data-player="${id}"]:not([data-ready])`)) {
    root.dataset.ready = "";
    start(root, data);
  }
}

// Returns the function that takes other motions of the same arms, in the same scene: view and time stay.
function start(root, data) {
  const {slider, switch: menu, unit} = data, scene = {...data.scene, unit, styles: data.styles};
  let times, last, recordings, begin, end, tick;
  function take() {
    ({times} = data);
    last = times.length - 1;
    recordings = data.arms.map(arm => recording(arm, times.length, unit));
    [begin, end] = [times[0], times[last]];
    tick = (end - begin) / 400;
  }
  take();
  const state = {time: begin, value: 0, choice: 0, view: [...scene.view], playing: false};

  // What is on the page
  const sceneCanvas = sceneCanvasOf(scene, data.alt);
  const curvesCanvas = element("canvas", {class: "rk-curves", role: "img", "aria-label":
    `Curves over time of ${data.arms.map(a => a.name).join(" and ")}: joint values, speeds, accelerations. ` +
    "The greatest values stand in the table."});
  const icon = element("span");
  const button = control("button", {type: "button", "aria-label": "play", title: "play or pause (Space)"}, icon);
  const scrub = control("input", {type: "range", min: 0, max: 400, step: 1, value: 0, "aria-label": "time"});
  const clock = element("span", {class: "rk-value"});
  const speeds = [0.25, 0.5, 1, 2, 4], speed = choice("playing speed", speeds.map(s => `${s}\u00D7`));
  speed.value = 2;
  const rows = [element("div", {class: "rk-row"}, button, element("label", {class: "rk-long"}, scrub, clock),
                        element("label", {}, "playback", speed))];
  let range, shown, select;
  if (slider || menu) {
    const row = element("div", {class: "rk-row"});
    if (slider) {
      range = control("input", {type: "range", min: 0, max: slider.values.length - 1, step: 1, value: 0,
                                "aria-label": slider.label});
      shown = element("span", {class: "rk-value"});
      row.append(element("label", {class: "rk-long"}, slider.label, range, shown));
    }
    if (menu) row.append(element("label", {}, menu.label, select = choice(menu.label, menu.values)));
    rows.push(row);
  }
  const table = element("div", {class: "rk-table"}), notes = element("ul", {class: "rk-notes"});
  const views = element("div", {class: `rk-views${data.arms.length > 1 ? " rk-wide" : ""}`}, sceneCanvas, curvesCanvas);
  const frame = element("div", {class: "rk", role: "group", "aria-label": data.title},
    element("style", {}, STYLE), element("div", {class: "rk-title"}, data.title), views, ...rows, table, notes);
  root.replaceChildren(frame);

  const inSpace = sceneView(sceneCanvas, scene);
  const overTime = curvesView(curvesCanvas, data.styles);

  // A motion: everything that changes with slider and switch
  let motion, arms, columns;
  function choose() {
    motion = state.choice * (slider ? slider.values.length : 1) + state.value;
    arms = data.arms.map((arm, k) => {
      const gaps = new Set(arm.gaps[motion]), trace = [];
      for (let i = 0; i <= last; i++) {
        const q = recordings[k].q(motion, i);
        trace.push(q.every(Number.isFinite) ? origin(frames(arm.chain, q).at(-1)) : null);
      }
      const via = arm.via && arm.via[motion];
      return {name: arm.name, chain: arm.chain, trace, gaps,
              line: trace.flatMap((p, i) => gaps.has(i) ? [p, null] : [p]),
              near: via && {place: via.slice(1), text: `${number(via[0], unit.size < 1 ? 1 : 3)} ${unit.name}`}};
    });
    columns = data.arms.map((arm, k) => ({title: arm.name, panels: data.panels.map((panel, order) => ({
      label: panel.label + (panel.own && slider ? `   (scale follows ${slider.label})` : ""),
      axes: ["turn", "shift"].filter(kind => panel[kind]).map(kind => ({
        unit: panel[kind].unit, scale: panel[kind].scales[panel[kind].of ? panel[kind].of[motion] : 0],
        joints: arm.chain.flatMap((link, j) => link.prismatic === (kind === "shift") ? [j] : [])})),
      curves: recordings[k].quantity(order, motion),
      gaps: arms[k].gaps,
      limits: order === 0 ? arm.limits
        : order === 1 && arm.speedLimits ? [arm.speedLimits.map(x => -x), arm.speedLimits] : null,
      near: panel.near[k],
      marks: [...(arm.leaps[motion] || []).map(([time, text]) => ({time, text: order ? "" : text})),
              ...(arm.jumps[motion] || []).map(([time, text]) => ({time, text: order === 2 ? text : ""}))],
    }))}));
    tell();
  }

  // The numbers, as a table and in words
  function tell() {
    const near = data.arms.map((arm, k) => arms[k].near && `${data.arms.length > 1 ? `${arm.name}: ` : ""}` +
      `path passes via at ${arms[k].near.text}`).filter(text => text).join("; ");
    const most = Math.max(...data.arms.map(arm => arm.chain.length));
    const head = element("tr", {}, element("th", {scope: "col"}, near),
      ...Array.from({length: most}, (_, j) => element("th", {scope: "col"}, `joint ${j + 1}`)));
    const body = data.arms.flatMap((arm, k) => {
      const whose = data.arms.length > 1 ? `${arm.name}: ` : "";
      const units = [...new Set(arm.chain.map(link => link.prismatic ? unit.name : "\u00B0"))];
      const line = (name, per, cell) => element("tr", {}, element("th", {scope: "row"},
        `${whose}${name}, ${units.map(u => `${u}/${per}`).join(" or ")}${arm.share && per === "s" ? " (of limit)" : ""}`), ...arm.chain.map((_, j) => cell(j)));
      return [
        line("greatest speed", "s", j => element("td", {}, number(arm.speed[motion][j], data.decimals[0]) +
          (arm.share ? ` (${arm.share[motion][j]}\u00A0%)` : ""))),
        line("greatest acceleration", "s\u00B2", j => typeof arm.acceleration[motion][j] === "string"
          ? element("td", {class: "rk-jump"}, arm.acceleration[motion][j])
          : element("td", {}, number(arm.acceleration[motion][j], data.decimals[1]))),
      ];
    });
    table.replaceChildren(element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
    notes.replaceChildren(...data.arms.flatMap(arm => (arm.notes[motion] || []).map(text =>
      element("li", {}, data.arms.length > 1 ? `${arm.name}: ${text}` : text))));
    if (slider) {
      shown.textContent = number(slider.values[state.value], slider.decimals);
      range.setAttribute("aria-valuetext", shown.textContent);
    }
  }

  // One picture
  function draw() {
    for (const canvas of [sceneCanvas, curvesCanvas]) {
      const [, rows] = tiled(data.arms.length, canvas.clientWidth);
      canvas.style.height = rows > 1 ? `${rows * 330}px` : "";
    }
    let i = 0;
    for (let step = 1 << 10; step; step >>= 1) if (i + step <= last && times[i + step] <= state.time) i += step;
    const share = i < last ? (state.time - times[i]) / (times[i + 1] - times[i]) : 0;
    arms.forEach((arm, k) => {
      const broken = arm.gaps.has(i);
      let q = recordings[k].q(motion, i, broken ? 0 : share);
      arm.faded = !q.every(Number.isFinite) || broken && share > 0 && !arm.trace[i + 1];
      for (let back = i; !q.every(Number.isFinite) && back >= 0; back--) q = recordings[k].q(motion, back);
      arm.q = q;
      const tip = q.every(Number.isFinite) ? origin(frames(arm.chain, q).at(-1)) : null;
      arm.tail = [...arm.trace.slice(0, i + 1).flatMap((p, at) => arm.gaps.has(at) ? [p, null] : [p]), tip];
      for (const panel of columns[k].panels) panel.now = panel.curves.map(curve =>
        share && !broken ? curve[i] + share * (curve[i + 1] - curve[i]) : curve[i]);
    });
    clock.textContent = `${number(state.time, 2)} s`;
    scrub.value = Math.round((state.time - begin) / tick);
    scrub.setAttribute("aria-valuetext", clock.textContent);
    inSpace.draw(state.view, arms.map(arm => ({...arm, trace: arm.line})), `t = ${clock.textContent}`);
    overTime.draw(columns, times, data.ticks, state.time);
  }

  // Time
  let asked = 0, before = 0;
  function ask() {
    if (!asked) asked = requestAnimationFrame(step);
  }
  function step(now) {
    asked = 0;
    if (!root.isConnected) { state.playing = false; return; } // the cell was run again: nothing goes on behind it
    if (state.playing) {
      // The first stamp may lie before the click.
      state.time = Math.min(end, state.time + Math.max(0, now - before) / 1000 * speeds[speed.value]);
      before = Math.max(before, now);
      if (state.time >= end) run(false);
    }
    draw();
    if (state.playing) ask();
  }
  function run(on) {
    state.playing = on;
    if (on && state.time >= end) state.time = begin;
    before = performance.now();
    icon.innerHTML = `<svg width="14" height="14" viewBox="0 0 14 14" aria-hidden="true"><path d="${on ? PAUSE : PLAY}"/></svg>`;
    button.setAttribute("aria-label", on ? "pause" : "play");
    if (on) ask();
  }

  button.addEventListener("click", () => run(!state.playing));
  scrub.addEventListener("input", () => { run(false); state.time = Math.min(end, begin + scrub.value * tick); ask(); });
  range?.addEventListener("input", () => { state.value = +range.value; choose(); ask(); });
  select?.addEventListener("change", () => { state.choice = +select.value; choose(); ask(); });
  frame.addEventListener("keydown", event => {
    if (event.key === " " && !["BUTTON", "SELECT"].includes(event.target.tagName)) {
      event.preventDefault();
      run(!state.playing);
    }
  });

  orbit(sceneCanvas, scene, state, ask);
  let held = null;
  const scrubbed = event => {
    [state.time, held] = overTime.timeAt(event.offsetX, event.offsetY, held ?? undefined);
    ask();
  };
  curvesCanvas.addEventListener("pointerdown", event => {
    curvesCanvas.setPointerCapture(event.pointerId);
    run(false);
    held = null;
    scrubbed(event);
  });
  curvesCanvas.addEventListener("pointermove", event => {
    if (curvesCanvas.hasPointerCapture(event.pointerId)) scrubbed(event);
  });

  new ResizeObserver(ask).observe(frame); // also draws the first picture
  run(false);
  choose();
  return next => {
    data = next;
    scene.targets = data.scene.targets;
    take();
    state.time = Math.min(end, Math.max(begin, state.time));
    sceneCanvas.setAttribute("aria-label", seenIn(scene, data.alt));
    choose();
    ask();
  };
}
