// The page's part of the widget that activates a view (live.py): a model without a view of its own.
// The model finds the view even if the view is created later than the model or is shown twice.

/** @import {Arrived} from "./live.js" */

/**
 * @typedef {object} Model
 * @property {(content: {to: number, n: number, question: unknown}) => void} send  `to`: index in
 *   `roots`
 * @property {Hear} on
 */
/**
 * @typedef {{
 *   (name: "msg:custom", call: (content: Reply, buffers: Arrived["buffers"]) => void): void,
 *   (name: "comm_live_update", call: () => void): void,
 * }} Hear
 */
/** @typedef {{to: number} & Omit<Arrived, "buffers">} Reply */

/**
 * Initialises the widget of the view `id` with its model, and returns the function that ends it.
 * @param {string} id
 * @returns {(given: {model: Model}) => () => void}
 */
export const model =
  id =>
  ({model}) => {
    /** @type {HTMLElement[]} */
    const roots = [];
    /** @param {HTMLElement} root */
    function meet(root) {
      if (roots.includes(root)) return;
      roots.push(root);
      const to = roots.length - 1;
      /** @type {(n: number, question: unknown) => void} */
      const send = (n, question) => model.send({to, n, question});
      root.dispatchEvent(new CustomEvent("robokin-wake", {detail: send}));
    }
    function sleep() {
      document.removeEventListener("robokin-asks", asks);
      for (const root of roots.splice(0)) root.dispatchEvent(new CustomEvent("robokin-sleep"));
    }
    /** @param {Event} event */
    function asks(event) {
      const {detail} = /** @type {CustomEvent<{id: string, root: HTMLElement}>} */ (event);
      if (detail.id === id) meet(detail.root);
    }
    const views = /** @type {NodeListOf<HTMLElement>} */ (
      document.querySelectorAll(`[data-player="${id}"][data-ready]`)
    );
    views.forEach(meet);
    document.addEventListener("robokin-asks", asks);
    model.on("msg:custom", ({to, n, answer}, buffers) =>
      roots[to]?.dispatchEvent(new CustomEvent("robokin-answer", {detail: {n, answer, buffers}})),
    );
    model.on("comm_live_update", sleep);
    return sleep;
  };
