// Starts a view as soon as it is close to the visible part of the page: decompresses the script
// that the output contains, and runs it. All views of one kind share one script, so a page
// decompresses it only once.

/** @typedef {HTMLScriptElement & {exported?: unknown}} Exporting */

/** @type {Map<string, Promise<unknown>>} */
const scripts = (Object(globalThis).robokinScripts ??= new Map());
const MARGIN = {scrollMargin: "50%"}; // of the page, too: a rootMargin would be added to it
/**
 * What all views of the page share: `last` resolves after the latest view has started, `tell` are
 * the callbacks of placeholders, and `seen` calls them, in the order of the page.
 * @type {{
 *   last: Promise<unknown>,
 *   tell: WeakMap<Element, (close: boolean) => void>,
 *   seen: IntersectionObserver,
 * }}
 */
const turn = (Object(globalThis).robokinTurn ??= {last: Promise.resolve()});
turn.tell ??= new WeakMap(); // the loader of an older notebook in the same window makes only `last`
turn.seen ??= new IntersectionObserver(
  entries => entries.forEach(entry => turn.tell.get(entry.target)?.(entry.isIntersecting)),
  MARGIN,
);

/**
 * @template T
 * @param {string} id  the id of the view
 * @param {string} key  the key of its script
 * @param {string} deflated  the script, compressed with zlib, in base64
 * @param {(module: T) => void} show
 */
export function start(id, key, deflated, show) {
  const nonce = document.currentScript?.nonce ?? "";
  const begin = () =>
    near(id)
      .then(() => {
        const script = scripts.get(key) ?? inflated(deflated).then(text => run(text, nonce));
        scripts.set(key, script);
        return inTurn(async () => {
          const module = /** @type {T} */ (await script);
          // the views above may have grown and moved this one away
          if (await close(id)) show(module);
          else begin();
        });
      })
      .catch(error => explain(id, error));
  begin();
}

/**
 * Starts one view at a time, and lets the browser redraw the page in between, so that a slow phone
 * can scroll and respond to a touch before the next view starts.
 * @param {() => void} act
 */
function inTurn(act) {
  const done = turn.last.then(act);
  turn.last = done
    .catch(() => {})
    .then(() => new Promise(resolve => requestAnimationFrame(() => setTimeout(resolve))));
  return done;
}

/**
 * The placeholders of a view that has not started, or elements in them.
 * @param {string} id
 * @param {string} [inside]  a selector
 */
const placesOf = (id, inside = "") =>
  document.querySelectorAll(`[data-player="${id}"]:not([data-ready])${inside}`);

/**
 * Waits until one of the placeholders of a view is at most half the height of the window away. A
 * long page would be busy for seconds if all its views started together. If the page contains the
 * same view twice, only the later call returns; its `show` starts both.
 * @param {string} id
 * @returns {Promise<void>}
 */
const near = id =>
  new Promise(resolve => {
    const places = placesOf(id);
    for (const place of places) {
      turn.tell.set(place, here => {
        if (!here) return;
        for (const each of places) turn.seen.unobserve(each);
        resolve();
      });
      turn.seen.observe(place);
    }
  });

/**
 * Whether one of the placeholders of a view is that close now.
 * @param {string} id
 * @returns {Promise<boolean>}
 */
const close = id =>
  new Promise(resolve => {
    const places = placesOf(id);
    const seen = new IntersectionObserver(entries => {
      seen.disconnect();
      resolve(entries.some(entry => entry.isIntersecting));
    }, MARGIN);
    for (const place of places) seen.observe(place);
    if (!places.length) resolve(false);
  });

/** @param {string} deflated */
async function inflated(deflated) {
  const text = atob(deflated),
    bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  return new Response(
    new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate")),
  ).text();
}

/**
 * Runs a script and returns its result. The script has to be an element of the page, because the
 * security policy of a report allows no other code.
 * @param {string} text
 * @param {string} nonce
 */
function run(text, nonce) {
  const script = /** @type {Exporting} */ (document.createElement("script"));
  script.nonce = nonce;
  script.textContent = `document.currentScript.exported = (() => {${text}})();`;
  document.head.append(script);
  script.remove();
  return script.exported;
}

/**
 * Keeps the still picture of the view, and says in its last line why the view did not start.
 * @param {string} id
 * @param {unknown} error
 */
function explain(id, error) {
  console.error(error);
  const reason =
    typeof DecompressionStream === "undefined"
      ? "This view needs a browser from 2023 or later."
      : `The script of this view failed: ${error}.`;
  for (const line of placesOf(id, ">p:last-of-type")) line.textContent = reason;
}
