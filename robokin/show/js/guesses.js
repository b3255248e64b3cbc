// The page's part in saving guesses (guesses.py): the model of a widget without a view, one for
// each kernel. A page may show several notebooks; each guess goes to the kernel of its notebook.

/** @typedef {[string, string, string]} Made  a prediction, the choice, and its time */
/**
 * The detail of the event "robokin-guess" of a question; the hub that handles the event cancels it.
 * `path` is the path of the notebook, or "" or null if the page does not contain it. `tell` is
 * called once, with the reason for a failure or with the saved first guesses, if they are known.
 * @typedef {(error?: string, first?: Record<string, string>) => void} Tell
 * @typedef {{path: ?string, guesses: Made[], tell: Tell}} Offer
 */
/**
 * JupyterLab's context of a notebook. Other front ends have none.
 * @typedef {{path: string, localPath: string, isDisposed: boolean}} Context
 */
/** @typedef {{n: number, error?: string, first?: Record<string, string>}} Told */
/**
 * @typedef {object} Model
 * @property {{context?: Context}} [widget_manager]
 * @property {(content: {n: number, path: ?string, guesses: Made[]}) => void} send
 * @property {(name: string, call: (content: Told) => void) => void} on
 */
/** @typedef {{context?: Context}} Hub */

/** @type {Set<Hub>} */
const hubs = (Object(globalThis).robokinHubs ??= new Set());

/**
 * The hub of the notebook at `path`. If the page or the hub does not know its path, this is the
 * only existing hub.
 * @param {?string} path
 */
function hubOf(path) {
  for (const hub of hubs) if (hub.context?.isDisposed) hubs.delete(hub);
  const all = [...hubs];
  const own = all.findLast(
    ({context}) => path && (context?.localPath === path || context?.path === path),
  );
  return own ?? (all.length === 1 && !(path && all[0].context) ? all[0] : undefined);
}

/** @param {{model: Model}} given */
export function initialize({model}) {
  const {context} = model.widget_manager ?? {};
  const hub = {context};
  /** @type {Map<number, Offer["tell"]>} */
  const asked = new Map();
  let sent = 0;
  /** @param {Event} event */
  function hear(event) {
    const {path, guesses, tell} = /** @type {CustomEvent<Offer>} */ (event).detail;
    if (hubOf(path) !== hub) return;
    try {
      model.send({n: sent + 1, path: context?.localPath ?? null, guesses});
    } catch {
      return; // its kernel has ended
    }
    asked.set(++sent, tell);
    event.preventDefault();
  }
  function end() {
    hubs.delete(hub);
    document.removeEventListener("robokin-guess", hear);
    for (const tell of asked.values()) tell("Python ended before it answered");
    asked.clear();
  }
  hubs.add(hub);
  document.addEventListener("robokin-guess", hear);
  model.on("msg:custom", ({n, error, first}) => {
    asked.get(n)?.(error, first);
    asked.delete(n);
  });
  model.on("comm_live_update", end);
  for (const root of document.querySelectorAll(".robokin-player"))
    root.dispatchEvent(new CustomEvent("robokin-keeps"));
  return end;
}
