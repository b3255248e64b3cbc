// Lines, shapes and text on a canvas, in the colours of the page; formatted numbers.

/** @typedef {[number, number]} Pixel  CSS pixels from the upper left corner of a canvas */
/** @typedef {number[]} Point  x, y, z in metres, base coordinates */
/** @typedef {[number, number, number, number]} Box  left, top, width, height in CSS pixels */
/** @typedef {[...box: Box, mark?: string]} Ring  the box of a handle, and the letter on it */
/** @typedef {[color: string, width: number, dash?: number[]]} Look  the style of a line */
/**
 * @typedef {[fill: string, edge?: string, width?: number]} Filling  the fill and edge of a shape
 */
/**
 * @typedef {[points: (?Pixel)[], width: number, weight: number]} Ink  a line that no label should
 *   cover; one point is a disc. `weight` says how much it matters
 */
/** @typedef {CanvasRenderingContext2D} Context */
/** @typedef {keyof typeof colors} Color */

/** The colours of palette.py by name, six hexadecimal digits each; `readColors` fills them in. */
export const colors = {
  paper: "",
  ink: "",
  soft: "",
  line: "",
  grid: "",
  border: "",
  rim: "",
  alarm: "",
  path: "",
  near: "",
  accent: "",
  chosen: "",
  button: "",
  hover: "",
  rest: "",
  edge: "",
  link: "",
  shine: "",
  rodEdge: "",
  rod: "",
  rodShine: "",
  hub: "",
  foot: "",
  footEdge: "",
  ghost: "",
  ballShine: "",
  ball: "",
  ballEdge: "",
  x: "",
  y: "",
  z: "",
  joint1: "",
  joint2: "",
  joint3: "",
  joint4: "",
  joint5: "",
  joint6: "",
};

/** The weight of words, joints and handles, which no label may cover. */
export const WORD = 200;

/** @type {Ink[]}  what has been drawn since a canvas was cleared */
export const ink = [];

let family = "sans-serif"; // the font of text; `readColors` sets it, too

/** Reads the current colours of an element in .rk from the style sheet. @param {Element} place */
export function readColors(place) {
  const style = getComputedStyle(place);
  family = style.getPropertyValue("--rk-font").trim();
  for (const name of /** @type {Color[]} */ (Object.keys(colors)))
    colors[name] = style.getPropertyValue(`--rk-${name}`).trim();
}

/** A font for text on a canvas. @type {(size: number, weight?: string | number) => string} */
export const font = (size, weight = "") => `${weight} ${size}px ${family}`;

/** The colour of a joint. @param {number} j from 0 */
export const jointColor = j => colors[/** @type {Color} */ (`joint${(j % 6) + 1}`)];

/** A joint's colour, changed so that text in it is readable. @type {(color: string) => string} */
export const shade = color => `color-mix(in srgb, ${color} 60%, ${colors.ink})`;

/**
 * A translucent colour.
 * @param {string} color
 * @param {number} share from 0 to 1
 */
export const clear = (color, share) =>
  color +
  Math.round(255 * share)
    .toString(16)
    .padStart(2, "0");

/**
 * Returns the context of a canvas, which is cleared and has the size of its place on the page at
 * the screen's resolution (at most two by two device pixels per CSS pixel). If the canvas currently
 * has no size, it keeps its picture, and the result is null.
 * @param {HTMLCanvasElement} canvas
 * @returns {?[Context, number, number]} context, width and height
 */
export function prepared(canvas) {
  const ratio = Math.min(2, window.devicePixelRatio || 1),
    w = canvas.clientWidth,
    h = canvas.clientHeight;
  if (!w || !h) return null;
  if (canvas.width !== Math.round(w * ratio) || canvas.height !== Math.round(h * ratio)) {
    canvas.width = Math.round(w * ratio);
    canvas.height = Math.round(h * ratio);
  }
  const g = /** @type {Context} */ (canvas.getContext("2d"));
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, w, h);
  ink.length = 0;
  g.lineCap = g.lineJoin = "round";
  return [g, w, h];
}

/**
 * Replaces the still picture with a frame, unless one of its canvases cannot be drawn on.
 * @param {HTMLElement} root
 * @param {HTMLElement} frame
 * @param {...HTMLCanvasElement} canvases
 */
export function replaceStill(root, frame, ...canvases) {
  if (canvases.every(canvas => canvas.getContext("2d"))) root.replaceChildren(frame);
}

/**
 * Draws a line through points; null or NaN interrupts it.
 * @param {Context} g
 * @param {(?Pixel)[]} points
 * @param {string} color
 * @param {number} width
 * @param {number[]} [dash]
 */
export function stroke(g, points, color, width, dash = []) {
  // a label may cover a halo and a hatching
  if (!color.startsWith(colors.paper) && (width > 1 || isSolid(color)))
    ink.push([points, width, Math.min(9, width)]);
  g.strokeStyle = color;
  g.lineWidth = width;
  g.setLineDash(dash);
  g.beginPath();
  let pen = false;
  for (const p of points) {
    if (!p || Number.isNaN(p[1])) pen = false;
    else if (pen) g.lineTo(p[0], p[1]);
    else {
      g.moveTo(p[0], p[1]);
      pen = true;
    }
  }
  g.stroke();
  g.setLineDash([]);
}

/**
 * Draws a line that is seen on any ground.
 * @type {(g: Context, points: (?Pixel)[], color: string, width: number) => void}
 */
export function haloed(g, points, color, width) {
  stroke(g, points, colors.paper, width + 2);
  stroke(g, points, color, width);
}

/**
 * @type {(g: Context, x: number, top: number, bottom: number, ...look: Look) => void}
 */
export const upright = (g, x, top, bottom, ...look) =>
  stroke(
    g,
    [
      [x, top],
      [x, bottom],
    ],
    ...look,
  );

/**
 * @type {(g: Context, y: number, left: number, right: number, ...look: Look) => void}
 */
export const level = (g, y, left, right, ...look) =>
  stroke(
    g,
    [
      [left, y],
      [right, y],
    ],
    ...look,
  );

/**
 * Fills and outlines the path that `draw` traces.
 * @param {Context} g
 * @param {() => void} draw
 * @param {string | CanvasGradient} fill
 * @param {string} [edge]
 * @param {number} [width]
 */
export function shape(g, draw, fill, edge, width) {
  g.beginPath();
  draw();
  g.closePath();
  g.fillStyle = fill;
  g.fill();
  if (!width) return;
  if (edge) g.strokeStyle = edge;
  g.lineWidth = width;
  g.stroke();
}

/**
 * @type {(g: Context, points: Pixel[], ...look: Filling) => void}
 */
export function polygon(g, points, ...look) {
  ink.push([[...points, points[0]], 1, isSolid(look[0]) ? 4 : 1]);
  shape(g, () => points.forEach(p => g.lineTo(...p)), ...look);
}

/** @param {string | CanvasGradient} fill */
const isSolid = fill => !(/** @type {string} */ (fill).length > 7);

/**
 * Draws a disc.
 * @param {Context} g
 * @param {Pixel} place
 * @param {number} radius
 * @param {string | CanvasGradient} fill
 * @param {string} [edge]
 * @param {number} [width]
 */
export function spot(g, [x, y], radius, fill, edge = colors.paper, width = 1.5) {
  if (isSolid(fill)) ink.push([[[x, y]], 2 * radius, 9]);
  shape(g, () => g.arc(x, y, radius, 0, 2 * Math.PI), fill, edge, width);
}

/** The ink of words in a box. @type {(box: Ring) => Ink} */
export const wordInk = ([x, y, w, h]) => [
  [
    [x + h / 2, y + h / 2],
    [x + Math.max(h / 2, w - h / 2), y + h / 2],
  ],
  h,
  WORD,
];

/**
 * Writes text with an outline, so that it is readable over lines.
 * @param {Context} g
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {string} [color]
 * @param {number} [size]
 * @param {"left" | "center" | "right"} [align]
 * @param {string | number} [weight]
 */
export function write(g, text, x, y, color = colors.ink, size = 12, align = "left", weight = "") {
  g.font = font(size, weight);
  g.textAlign = align;
  g.lineWidth = 3.5;
  g.strokeStyle = clear(colors.paper, 0.9);
  g.strokeText(text, x, y);
  g.fillStyle = color;
  g.fillText(text, x, y);
  const wide = g.measureText(text).width,
    left = x - {left: 0, center: 0.5, right: 1}[align] * wide;
  ink.push(wordInk([left, y - 0.9 * size, wide, 1.2 * size]));
}

/**
 * Formats a number with this many decimals, a real minus sign and no negative zero.
 * @param {number} x
 * @param {number} decimals
 */
export const number = (x, decimals) =>
  x
    .toFixed(decimals)
    .replace(/^-(?=0\.?0*$)/, "")
    .replace("-", "\u2212");

/**
 * Whether a box [left, top, width, height] overlaps one of several others.
 * @param {Box} box
 * @param {Ring[]} boxes
 */
export const hit = ([x, y, w, h], boxes) =>
  boxes.some(([ox, oy, ow, oh]) => x < ox + ow && ox < x + w && y < oy + oh && oy < y + h);

/**
 * The numbers of columns and rows into which `count` pictures are arranged at this width.
 * @param {number} count
 * @param {number} width
 * @returns {[number, number]}
 */
export function tiled(count, width) {
  const rows = Math.ceil(count / Math.max(1, Math.min(count, Math.floor(width / 260))));
  return [Math.ceil(count / rows), rows];
}
