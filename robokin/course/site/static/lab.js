// Runs the cells of a lab in its page. site.js loads this module if the page comes from a server;
// conf.py writes the cells and the sizes of Python's files into the page.

import {Cell, STORED_RESULT, element} from "./cell.js";
import {notebook, offer} from "./download.js";
import {elsewhere} from "./edits.js";
import {FIGURE, errorLine} from "./outputs.js";
import {Ended, Python, mb} from "./python.js";
import {Views} from "./views.js";

/** @import {CellData} from "./cell.js" */
/** @import {File} from "./python.js" */
/** @import {Output} from "./outputs.js" */
/**
 * What conf.py writes into the page.
 * @typedef {object} LabData
 * @property {string} file  the name of the notebook
 * @property {string} version
 * @property {File[]} python
 * @property {File[]} sympy
 * @property {CellData[]} cells
 */
/** @typedef {{outputs: Output[]}} Result */

const LAST = /^(?:progress|report)\(/m; // the text next to these cells says how to hand in
const SAME = "Done. The view would be the same, so it stays as you left it.";
const ABOVE = "A cell above that this one needs ended with an error.";

class Lab {
  /** @param {LabData} data */
  constructor(data) {
    this.data = data;
    this.python = new Python([...data.python, ...data.sympy], data.version, () => this.ended());
    this.views = new Views(this.python);
    this.note = element("p", "rk-status");
    this.note.setAttribute("role", "status");
    /** @type {?Cell} */
    this.running = null;
    this.cells = data.cells.map((cell, k) => {
      const place = /** @type {HTMLElement} */ (document.getElementById(cell.place));
      const complain = (/** @type {string} */ why) => (this.note.textContent = why);
      const run = (/** @type {Cell} */ each) => void this.run(each);
      return new Cell(
        cell,
        `cell ${k + 1}`,
        place,
        run,
        () => this.python.end("stopped"),
        complain,
      );
    });
    keepGuesses();
    elsewhere((id, edit) => this.cells.find(each => each.data.id === id)?.follow(edit));
    this.introduce();
  }

  /** The lines above the lab: what one can do, what it costs, and the reader's notebook. */
  introduce() {
    const {cells, data, note} = this,
      line = element("p", "rk-intro"),
      more = data.sympy.length ? `, and SymPy, ${mb(total(data.sympy))} MB` : "",
      plain = document.querySelector("p.download");
    for (const {bar, data, says} of cells)
      if (says && LAST.test(data.source)) bar?.append(...this.handIn(says));
    line.append(
      "You can change and run the cells on this page. The first Run fetches Python once, ",
      `${mb(total(data.python))} MB${more}. `,
      ...this.handIn(note),
    );
    const link = plain?.querySelector("a");
    if (!plain || !link) return;
    plain.before(line, note);
    link.textContent = "Download the lab without my changes";
    plain.parentElement?.append(plain);
  }

  /** A button that downloads the reader's notebook, and a link. @param {HTMLElement} note */
  handIn(note) {
    const button = element("button", "rk-first"),
      link = element("a", "");
    button.type = "button";
    button.textContent = "Download my notebook";
    button.addEventListener("click", () => void this.download(note));
    [link.href, link.textContent] = ["hand_in.html", "How to hand it in"];
    return [button, link];
  }

  /** @param {HTMLElement} note  where to say what happened */
  async download(note) {
    const {cells, data} = this;
    const edited = cells.filter(({text, data}) => text !== data.source);
    try {
      const texts = new Map(edited.map(({text, data}) => [data.id, text]));
      offer(data.file, await notebook(data.file, texts));
      const failed = and(cells.filter(({failed, stopped}) => failed || stopped));
      note.textContent =
        `Downloaded ${data.file} with your changes and your guesses.` +
        (failed && ` Failed or stopped here: ${failed}. So run only the last cell there.`);
    } catch (error) {
      note.textContent = `The notebook could not be fetched (${error}).`;
    }
  }

  /** Runs what a cell needs, then the cell. @param {Cell} cell */
  async run(cell) {
    if (this.running) {
      if (this.running !== cell) cell.say(`Python is still running ${this.running.name}.`);
      return;
    }
    this.running = cell;
    cell.stopped = false;
    cell.busy(true);
    try {
      await this.python.start(sentence => cell.say(sentence));
      const needs = await this.prepare(cell);
      if (needs) {
        cell.say("Running …");
        const {outputs, stays} = await this.execute(cell, true);
        if (stays) cell.say(SAME + before(needs), [["Start again", () => cell.show(outputs)]]);
        else cell.say(result(outputs) + before(needs));
      }
    } catch (error) {
      if (!(error instanceof Ended)) throw error;
      if (error.how === "stopped") cell.stopped = true; // perhaps before it began
      this.explain(cell, error);
    } finally {
      this.running = null;
      cell.busy(false);
    }
  }

  /**
   * Runs the cells that a cell needs and returns them, or null if one of them had an error.
   * @param {Cell} cell
   */
  async prepare(cell) {
    const {cells} = this,
      texts = cells.map(({text}) => text);
    const found = await this.python.call("needs", texts, cells.indexOf(cell)),
      needs = /** @type {number[]} */ (found).map(k => cells[k]);
    const stopped = needs.find(each => each.stopped);
    if (stopped) {
      cell.say(`This cell needs ${stopped.name}, which was stopped.`, [
        ["Show it", () => reveal(stopped)],
      ]);
      return null;
    }
    for (const [done, each] of needs.entries()) {
      const left = needs.length - done;
      cell.say(`Running ${left} ${left === 1 ? "cell" : "cells"} above …`);
      if (fine((await this.execute(each, false)).outputs)) continue;
      cell.say(ABOVE, [["Show it", () => reveal(each)]]);
      return null;
    }
    return needs;
  }

  /**
   * Runs one cell and shows its result. If the cell was run only because another one needs it, and
   * is unchanged, its stored result stays. Views that are there already stay as the reader left
   * them.
   * @type {(cell: Cell, asked: boolean) => Promise<{outputs: Output[], stays: boolean}>}
   */
  async execute(cell, asked) {
    let outputs;
    try {
      const answer = await this.python.call("run", cell.text, this.cells.indexOf(cell));
      ({outputs} = /** @type {Result} */ (answer));
    } catch (error) {
      cell.stopped = true;
      throw error;
    }
    cell.failed = !fine(outputs);
    const stays = cell.shows(outputs);
    if (!stays && (asked || cell.failed || cell.text !== cell.data.source)) cell.show(outputs);
    this.views.learn(outputs);
    return {outputs, stays};
  }

  /** Says why a cell has no result. @type {(cell: Cell, why: Ended) => void} */
  explain(cell, why) {
    cell.show(null);
    if (why.how !== "check")
      return cell.say(cell.stored ? `${why.message} ${STORED_RESULT}` : why.message);
    const [, name] = /\bcheck\(\s*["']([\w.]+)["']/.exec(cell.text) ?? ["", "The answer"];
    cell.show([verdict(`${name}: does not hold.`, why.message)]);
    cell.say("Python was ended. It starts again with your next Run.");
  }

  ended() {
    this.views.sleep();
  }
}

/** @param {Output[]} outputs */
const fine = outputs => !outputs.some(({output_type}) => output_type === "error");

/** What the outputs are. @param {Output[]} outputs */
function result(outputs) {
  const line = errorLine(outputs);
  if (!fine(outputs)) return `Python stopped with an error${line ? ` in line ${line}` : ""}.`;
  if (!outputs.length) return "Done. This cell shows nothing.";
  if (outputs.every(output => "data" in output && FIGURE in output.data))
    return "Done, but this page cannot draw the picture again.";
  return "This is your result.";
}

/** Says which cells ran before one that needs them. @param {Cell[]} cells */
function before(cells) {
  const changed = and(cells.filter(({text, data}) => text !== data.source));
  return cells.length ? ` Ran before it: ${and(cells)}.${changed && ` Changed: ${changed}.`}` : "";
}

/** Their names, such as "cell 1, cell 2 and cell 4". @param {Cell[]} cells */
const and = cells => new Intl.ListFormat("en-GB").format(cells.map(({name}) => name));

/** A verdict in the style of the engine's. @type {(first: string, sentence: string) => Output} */
function verdict(first, sentence) {
  const made = element("div", "rk-verdict"),
    bold = document.createElement("b");
  bold.textContent = first;
  made.append(bold, document.createElement("br"), sentence);
  return {output_type: "display_data", data: {"text/html": made.outerHTML}};
}

/** The download has the guesses, so a question says that its guess is saved (prediction.js). */
function keepGuesses() {
  document.addEventListener("robokin-guess", event => {
    event.preventDefault();
    /** @type {CustomEvent<{tell: () => void}>} */ (event).detail.tell();
  });
  for (const root of document.querySelectorAll(".robokin-player"))
    root.dispatchEvent(new CustomEvent("robokin-keeps"));
}

/** @param {File[]} files */
const total = files => files.reduce((sum, {size}) => sum + size, 0);

/** @param {Cell} cell */
function reveal(cell) {
  cell.place.scrollIntoView();
  cell.runs?.focus({preventScroll: true});
}

const data = document.getElementById("rk-lab")?.textContent;
if (data) new Lab(JSON.parse(data));
