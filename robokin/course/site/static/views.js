// Views that ask Python (live.js in robokin.show): the page is their kernel. A view says its id
// when it is created; it is active while Python knows the id.

/** @import {Output} from "./outputs.js" */
/** @import {Python} from "./python.js" */

const VIEW = /data-player=\\"([0-9a-f]{12})\\"/g;

export class Views {
  /** @param {Python} python */
  constructor(python) {
    this.python = python;
    /** @type {Set<string>} */
    this.known = new Set();
    /** @type {Set<HTMLElement>} */
    this.active = new Set();
    document.addEventListener("robokin-asks", event => {
      const {id, root} = /** @type {CustomEvent<{id: string, root: HTMLElement}>} */ (event).detail;
      if (this.known.has(id)) this.wake(id, root);
    });
  }

  /** Activates the views in these outputs, where they are in the page. @param {Output[]} outputs */
  learn(outputs) {
    for (const [, id] of JSON.stringify(outputs).matchAll(VIEW)) {
      this.known.add(id);
      const roots = /** @type {NodeListOf<HTMLElement>} */ (
        document.querySelectorAll(`[data-player="${id}"][data-ready]`)
      );
      for (const root of roots) this.wake(id, root);
    }
  }

  /** @type {(id: string, root: HTMLElement) => void} */
  wake(id, root) {
    this.active.add(root);
    /** @type {(n: number, question: unknown) => void} */
    const send = (n, question) =>
      void this.python.call("ask", id, question).then(
        answer =>
          root.dispatchEvent(new CustomEvent("robokin-answer", {detail: {n, answer, buffers: []}})),
        () => {}, // Python ended, and the view has been told
      );
    root.dispatchEvent(new CustomEvent("robokin-wake", {detail: send}));
  }

  /** Python has ended. */
  sleep() {
    this.known.clear();
    for (const root of this.active) root.dispatchEvent(new CustomEvent("robokin-sleep"));
    this.active.clear();
  }
}
