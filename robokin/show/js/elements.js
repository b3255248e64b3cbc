// Creates elements of a page, and finds the placeholders of a view.

/** @typedef {Record<string, string | number>} Attributes */

/**
 * Returns the placeholders of this view in the page. Each is returned only once; a page may have
 * two of them for the same view.
 * @param {string} id
 * @returns {HTMLElement[]}
 */
export function waiting(id) {
  const roots = /** @type {NodeListOf<HTMLElement>} */ (
    document.querySelectorAll(`[data-player="${id}"]:not([data-ready])`)
  );
  for (const root of roots) root.dataset.ready = "";
  return [...roots];
}

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Attributes} [attributes]
 * @param {...(string | Node)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, String(value));
  node.append(...children);
  return node;
}

/**
 * An input element. JupyterLab handles arrow keys and Space itself unless the focused element
 * forbids it. Shift+Enter and Ctrl+S do what they do in the rest of the notebook.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Attributes} attributes
 * @param {...(string | Node)} children
 * @returns {HTMLElementTagNameMap[T]}
 */
export function control(tag, attributes, ...children) {
  const forbids = "data-lm-suppress-shortcuts",
    /** @type {HTMLElement & HTMLElementTagNameMap[T]} */
    node = element(tag, {[forbids]: "true", ...attributes}, ...children);
  node.addEventListener("keydown", event => {
    const {key, shiftKey, ctrlKey, metaKey} = event;
    const passes = shiftKey ? key === "Enter" : (ctrlKey || metaKey) && /^s$/i.test(key);
    if (!event.isTrusted || !passes) return;
    event.preventDefault(); // a button would be pressed, or the browser would save the page
    node.removeAttribute(forbids);
    node.dispatchEvent(new KeyboardEvent("keydown", event));
    node.setAttribute(forbids, "true");
  });
  return node;
}

/**
 * A menu. Its value is the index of the chosen option.
 * @param {string} name
 * @param {string[]} texts
 */
export const choice = (name, texts) =>
  control(
    "select",
    {"aria-label": name},
    ...texts.map((text, i) => element("option", {value: i}, text)),
  );
