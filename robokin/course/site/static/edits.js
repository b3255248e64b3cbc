// What the reader has changed on this page, kept in the browser until they reset it.

/** @typedef {{stored: string, text: string}} Edit  `stored`: the lab's text when it was changed */

/** @type {(id: string) => string} */
const key = id => `robokin edit ${location.pathname} ${id}`;

/**
 * The reader's edit of a cell, or null.
 * @param {string} id
 * @returns {?Edit}
 */
export function kept(id) {
  try {
    return parsed(localStorage.getItem(key(id)));
  } catch {
    return null;
  }
}

/**
 * Keeps an edit, or forgets it if it is null. Returns a sentence if the browser refuses.
 * @param {string} id
 * @param {?Edit} edit
 */
export function keep(id, edit) {
  try {
    if (edit) localStorage.setItem(key(id), JSON.stringify(edit));
    else localStorage.removeItem(key(id));
    return "";
  } catch (error) {
    const full = error instanceof DOMException && error.name === "QuotaExceededError";
    const why = full ? "has no more room for this site" : "does not let this page store anything";
    return (
      `Your browser ${why}, so your changes are lost when you close the page. ` +
      'Press "Download my notebook" to keep them.'
    );
  }
}

/**
 * Reports edits that are made in another tab.
 * @param {(id: string, edit: ?Edit) => void} hear
 */
export function elsewhere(hear) {
  const start = key("");
  addEventListener("storage", event => {
    if (event.key?.startsWith(start)) hear(event.key.slice(start.length), parsed(event.newValue));
  });
}

/**
 * The reader's first guess at each question of this page. The questions keep them (prediction.js).
 * @returns {Map<string, string>}
 */
export function guesses() {
  const name = `robokin   ${location.pathname}`,
    all = new Map();
  try {
    const text = Object(globalThis).robokinGuesses?.[name] ?? localStorage.getItem(name) ?? "[]";
    for (const [question, choice] of JSON.parse(text))
      if (!all.has(question)) all.set(question, String(choice).split(":")[0]);
  } catch {
    // a forbidden storage has no guesses
  }
  return all;
}

/** @param {?string} text */
function parsed(text) {
  try {
    const {stored, text: own} = JSON.parse(text ?? "");
    return typeof stored === "string" && typeof own === "string" ? {stored, text: own} : null;
  } catch {
    return null;
  }
}
