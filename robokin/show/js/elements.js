// Elements of a page, and the places that wait for an output.

/**
 * The places in the page that wait for this output: each only once, and the same one may stand
 * twice in a page.
 * @param {string} id
 * @returns {HTMLElement[]}
 */
export function waiting(id) {
  const roots = [...document.querySelectorAll(`[data-player="${id}"]:not([data-ready])`)];
  for (const root of roots) root.dataset.ready = "";
  return roots;
}

/** @returns {HTMLElement} */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...children);
  return node;
}

/**
 * JupyterLab takes arrow keys and Space for itself unless the very element with the focus forbids
 * it.
 */
export const control = (tag, attributes, ...children) =>
  element(tag, {"data-lm-suppress-shortcuts": "true", ...attributes}, ...children);

export const choice = (name, texts) =>
  control(
    "select",
    {"aria-label": name},
    ...texts.map((text, i) => element("option", {value: i}, text)),
  );

/** A slider over whole numbers from 0 on. */
export const range = (name, most) =>
  control("input", {type: "range", min: 0, max: most, step: 1, value: 0, "aria-label": name});
