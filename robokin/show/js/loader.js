// Starts a view: unpacks its script, which an output stores compressed, and runs it. Views of one
// kind share one script, so that a page unpacks it once.

import {element} from "./elements.js";

/** @typedef {HTMLScriptElement & {exported?: unknown}} Exporting */

/** @type {Map<string, Promise<unknown>>} */
const scripts = (Object(globalThis).robokinScripts ??= new Map());

/**
 * @template T
 * @param {string} id  of the view
 * @param {string} key  of its script
 * @param {string} packed  the script, compressed by zlib, in base64
 * @param {(module: T) => void} show
 */
export function start(id, key, packed, show) {
  const nonce = document.currentScript?.nonce ?? "";
  if (!scripts.has(key))
    scripts.set(
      key,
      unpacked(packed).then(text => run(text, nonce)),
    );
  scripts
    .get(key)
    ?.then(module => show(/** @type {T} */ (module)))
    .catch(error => explain(id, error));
}

/** @param {string} packed */
async function unpacked(packed) {
  const bytes = Uint8Array.from(atob(packed), c => c.charCodeAt(0)),
    stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).text();
}

/**
 * What a script returns. It runs as an element of the page, because the policy of a report allows
 * no other code.
 * @param {string} text
 * @param {string} nonce
 */
function run(text, nonce) {
  const script = /** @type {Exporting} */ (element("script"));
  script.nonce = nonce;
  script.textContent = `document.currentScript.exported = (() => {${text}})();`;
  document.head.append(script);
  script.remove();
  return script.exported;
}

/**
 * The still stays, and says why.
 * @param {string} id
 * @param {unknown} error
 */
function explain(id, error) {
  const old = typeof DecompressionStream === "undefined";
  for (const root of document.querySelectorAll(`[data-player="${id}"]:not([data-ready]) > p`))
    root.textContent = old
      ? "A still picture. To see it move, open it in a browser of 2023 or later."
      : `A still picture: its script failed (${error}).`;
  if (!old) console.error(error);
}
