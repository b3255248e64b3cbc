// Tables of explorers.

import {control, element} from "./elements.js";

/** @typedef {string | {text: string, past: boolean}} Cell  a table cell; `past`: past a limit */

/**
 * A table whose cells are updated without being created again.
 * @param {string[]} names  the names of the rows
 * @param {string[]} heads  the headings of the columns; if empty, there are none
 * @param {number[]} widths  one entry per column or, without heads, the cells in each row
 * @param {(row: number) => void} [take]  called with a chosen row; if given, row names are buttons
 */
export function table(names, heads, widths, take) {
  /** @type {(k: number) => number} */
  const count = k => (heads.length ? widths.length : widths[k]);
  const lines = names.map((name, k) => {
    const button = take ? control("button", {type: "button", class: "rk-choose"}, name) : null;
    const cells = Array.from({length: count(k)}, () => element("td"));
    const row = element("tr", {}, element("th", {scope: "row"}, button || name), ...cells);
    // a click on the button also reaches its row
    if (take) row.addEventListener("click", () => take(k));
    return {row, cells, button};
  });
  const head = heads.length
    ? [
        element(
          "thead",
          {},
          element(
            "tr",
            {},
            ...heads.map(text => (text ? element("th", {scope: "col"}, text) : element("td"))),
          ),
        ),
      ]
    : [];
  const node = element(
    "div",
    {class: `rk-table ${heads.length ? "rk-many" : "rk-few"}${take ? " rk-rows" : ""}`},
    element("table", {}, ...head, element("tbody", {}, ...lines.map(line => line.row))),
  );
  return {
    node,
    /**
     * @param {Cell[][]} rows
     * @param {number} [chosen]
     * @param {?boolean[]} [exists]  for each row, whether its subject exists; by default all do
     */
    set(rows, chosen = -1, exists = null) {
      rows.forEach((texts, k) => {
        const {row, cells, button} = lines[k];
        row.classList.toggle("rk-none", !!exists && !exists[k]);
        if (take) {
          if (k === chosen) row.setAttribute("aria-current", "true");
          else row.removeAttribute("aria-current");
          button?.setAttribute("aria-pressed", String(k === chosen));
        }
        texts.forEach((cell, j) => {
          const {text, past} = typeof cell === "string" ? {text: cell, past: false} : cell;
          if (cells[j].textContent !== text) cells[j].textContent = text;
          cells[j].classList.toggle("rk-past", past);
        });
      });
    },
  };
}
