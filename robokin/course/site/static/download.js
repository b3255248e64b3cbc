// The reader's notebook: the lab's file with their edits, and their guesses as choices.

import {guesses} from "./edits.js";

/** @typedef {{id?: string, cell_type: string, source: string | string[]}} NotebookCell */
/** @typedef {NotebookCell & {outputs: unknown[], execution_count: ?number}} CodeCell */

const JUDGES = /^(?:check|progress)\(/m; // what they show depends on the reader's answers
const OTHER_WORDS = /\n *<!-- on the site:.*?-->/gs; // conf.py puts them in place of the line above
const ASKS = /\bpredict\(\s*(["'])([\w.]+)\1\s*\)/g;

/**
 * Returns the notebook file at `address` with these texts of cells in place of its own. A changed
 * cell has no outputs, and no cell that judges.
 * @param {string} address
 * @param {Map<string, string>} edits  texts by the ids of cells
 */
export async function notebook(address, edits) {
  const answer = await fetch(address, {cache: "no-cache"});
  if (!answer.ok) throw new Error(`${answer.status} ${answer.url}`);
  const file = await answer.json(),
    guessed = guesses();
  for (const cell of /** @type {CodeCell[]} */ (file.cells)) {
    const stored = [cell.source].flat().join("");
    if (cell.cell_type !== "code") {
      cell.source = lines(stored.replace(OTHER_WORDS, ""));
      continue;
    }
    const text = withGuesses(edits.get(cell.id ?? "") ?? stored, guessed);
    if (text === stored && !JUDGES.test(text)) continue;
    cell.source = lines(text);
    [cell.outputs, cell.execution_count] = [[], null];
  }
  return JSON.stringify(file, null, 1) + "\n";
}

/** The lines of a text, with their ends. @param {string} text */
const lines = text => text.split(/(?<=\n)/);

/**
 * predict("lab.p1") becomes predict("lab.p1", "b") if the reader guessed b.
 * @param {string} text
 * @param {Map<string, string>} guessed
 */
export const withGuesses = (text, guessed) =>
  text.replace(ASKS, (call, quote, name) => {
    const choice = guessed.get(name);
    if (choice === undefined) return call;
    const given = /^[a-z]$/.test(choice) ? `"${choice}"` : String(parseFloat(choice));
    return `predict(${quote}${name}${quote}, ${given})`;
  });

/**
 * Offers a text as a file.
 * @param {string} name
 * @param {string} text
 */
export function offer(name, text) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type: "application/x-ipynb+json"}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
