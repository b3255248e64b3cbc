// A cell of the lab that the reader can change and run.

import {editor} from "./editor.js";
import {keep, kept} from "./edits.js";
import {errorLine, runScripts, sameViews, shown} from "./outputs.js";

/** @import {Editor} from "./editor.js" */
/** @import {Edit} from "./edits.js" */
/** @import {Output} from "./outputs.js" */
/**
 * @typedef {object} CellData
 * @property {string} place
 * @property {string} id
 * @property {string} source
 * @property {boolean} asks
 * @property {boolean} reports
 * @property {string[]} helps  the hints and then the solution of the exercise that it checks
 */

export const STORED_RESULT = "The result below is the lab's, not yours.";
const OLD_RESULT = `You changed this cell: press Run. ${STORED_RESULT}`;
const NEWER = "The lab has a newer text of this cell than the one that you changed.";

export class Cell {
  /**
   * @param {CellData} data
   * @param {string} name  such as "cell 3"
   * @param {HTMLElement} place
   * @param {(cell: Cell) => void} run
   * @param {() => void} stop
   * @param {(sentence: string) => void} complain  about the browser's storage
   */
  constructor(data, name, place, run, stop, complain) {
    this.data = data;
    this.name = name;
    this.place = place;
    this.run = () => run(this);
    this.complain = complain;
    this.text = data.source;
    this.stopped = this.failed = false; // its latest run
    this.stored = place.querySelector(":scope > .cell_output");
    /** @type {?HTMLElement} */
    this.own = null;
    /** @type {?Promise<Editor>} */
    this.editor = null;
    if (data.asks) {
      place.querySelector("details")?.replaceWith(label(`guess ${/\bp\d+/.exec(data.source)}`));
      return;
    }
    this.input = /** @type {HTMLElement} */ (place.querySelector(".cell_input"));
    this.says = element("p", "rk-status");
    this.says.setAttribute("role", "status");
    this.runs = this.button("Run", this.run);
    this.stops = this.button("Stop", stop);
    this.edits = this.button("Edit", () => this.edit(true));
    this.resets = this.button("Reset", () => this.reset());
    this.bar = element("div", "rk-bar");
    if (!data.reports) this.bar.append(this.runs, this.stops);
    this.bar.append(this.edits, this.resets, label(name));
    this.stops.hidden = this.resets.hidden = true;
    if (this.stored) this.stored.before(this.bar, this.says);
    else place.append(this.bar, this.says);
    this.help([...data.helps]);
    this.input.addEventListener("click", () => {
      if (!getSelection()?.toString()) this.edit(true);
    });
    place.addEventListener("keydown", event => this.press(event), true);
    this.remember(kept(data.id));
  }

  /** @type {(label: string, act: () => void) => HTMLButtonElement} */
  button(label, act) {
    const button = element("button", "");
    button.type = "button";
    button.textContent = label;
    if (this.name) button.setAttribute("aria-label", `${label} ${this.name}`);
    button.addEventListener("click", act);
    return button;
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    const inEditor =
      event.target instanceof HTMLTextAreaElement && this.input?.contains(event.target);
    if (!inEditor || event.key !== "Enter" || !event.shiftKey) return;
    event.preventDefault();
    event.stopPropagation();
    if (!this.data.reports) this.run();
  }

  /** Shows the edit that this browser has kept, or asks whether to. @param {?Edit} edit */
  remember(edit) {
    if (!edit || edit.text === this.data.source) return;
    if (edit.stored === this.data.source) return this.put(edit.text);
    this.say(NEWER, [
      ["Use my text", () => this.put(edit.text)],
      ["Use the lab's text", () => this.reset()],
    ]);
  }

  /** The text of another tab. @param {?Edit} edit */
  follow(edit) {
    const text = edit?.text ?? this.data.source;
    if (this.data.asks || text === this.text) return;
    this.put(text);
    this.say("You changed this cell in another tab. This is its text now.");
  }

  /** Replaces the text. @param {string} text */
  put(text) {
    this.changed(text);
    this.edit(false).then(made => made.set(text));
  }

  /** Opens the editor. @param {boolean} focus */
  async edit(focus) {
    const {input, edits} = this;
    if (!input || !edits) throw new Error("not a cell to edit");
    const fold = input.closest("details");
    if (fold && focus) fold.open = true;
    if (!this.editor) {
      const place = element("div", "rk-editor");
      input.classList.add("rk-edited");
      this.editor = editor(place, this.text, `code of ${this.name}`, text => this.changed(text));
      await this.editor;
      input.replaceChildren(place);
      edits.hidden = true;
    }
    const opened = await this.editor;
    if (focus) opened.box.focus();
    return opened;
  }

  /** The reader has changed the text. @param {string} text */
  changed(text) {
    const {id, source} = this.data;
    this.text = text;
    this.failed = false;
    void this.point(0);
    this.complain(keep(id, text === source ? null : {stored: source, text}));
    this.mark();
    this.say(text === source || this.own || !this.stored ? "" : OLD_RESULT);
  }

  /** Gives the stored cell back; the reader can undo this. */
  reset() {
    const {source} = this.data,
      before = this.text;
    this.show(null);
    if (before === source) return this.changed(source); // there is nothing to edit
    this.put(source);
    this.say("This is the lab's cell again.", [["Undo", () => this.put(before)]]);
  }

  mark() {
    const {resets, data, name} = this;
    if (!resets) return;
    const changed = this.text !== data.source;
    resets.hidden = !changed && !this.own;
    resets.textContent = changed ? "Reset" : "Lab's result";
    resets.setAttribute("aria-label", `${resets.textContent} ${name}`);
  }

  /** Marks the line of an error; 0 is none. @param {number} line */
  async point(line) {
    if (line || this.editor) (await this.edit(false)).point(line);
  }

  /** Whether the cell shows the views of these outputs already. @param {Output[]} outputs */
  shows(outputs) {
    const now = this.own ?? (this.text === this.data.source ? this.stored : null);
    return !!now && sameViews(outputs, now);
  }

  /**
   * Shows the reader's result in the place of the stored one; without one, the stored one.
   * @param {?Output[]} outputs
   */
  show(outputs) {
    this.own?.remove();
    this.own = outputs && shown(outputs, this.stored);
    if (this.stored instanceof HTMLElement) this.stored.hidden = Boolean(this.own);
    if (this.own) {
      this.place.append(this.own);
      runScripts(this.own);
      void this.point(errorLine(outputs ?? []));
    }
    this.mark();
  }

  /** A button shows these texts one after the other, below the buttons. @param {string[]} texts */
  help(texts) {
    if (!texts.length) return;
    const helps = element("div", "rk-helps");
    const button = this.button("Hint", () => {
      const text = element(texts.length > 1 ? "p" : "div", ""); // the solution is code
      text.textContent = texts.shift() ?? "";
      helps.append(text);
      if (!texts.length) {
        this.runs?.focus();
        button.remove();
        return;
      }
      button.textContent = texts.length > 1 ? "Hint" : "Solution";
      button.setAttribute("aria-label", `${button.textContent} ${this.name}`);
    });
    helps.setAttribute("role", "status");
    this.resets?.after(button);
    this.says?.after(helps);
  }

  /** @param {boolean} running */
  busy(running) {
    this.place.toggleAttribute("data-running", running);
    const {runs, stops} = this;
    if (!runs || !stops) return;
    const focused = document.activeElement;
    stops.hidden = !running;
    if (running && focused === runs) stops.focus();
    runs.hidden = running;
    if (!running && focused === stops) runs.focus();
    stops.hidden = !running;
  }

  /**
   * Says something below the cell, with buttons.
   * @param {string} sentence
   * @param {[string, () => void][]} [choices]
   */
  say(sentence, choices = []) {
    this.says?.replaceChildren(
      sentence,
      ...choices.map(([label, act]) =>
        this.button(label, () => {
          this.say("");
          act();
        }),
      ),
    );
  }
}

/** A quiet name, such as "cell 3". @param {string} name */
function label(name) {
  const made = element("small", "rk-name");
  made.textContent = name;
  return made;
}

/**
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {string} name
 */
export function element(tag, name) {
  const node = document.createElement(tag);
  if (name) node.className = name;
  return node;
}
