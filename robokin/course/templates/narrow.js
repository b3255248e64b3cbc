// Exported pages and the site. Runs before the cells are parsed.
(() => {
  // Narrow screens fold code. We close a cell while the page is being parsed, before it is painted,
  // so nothing flashes or moves; without scripts it stays open. Paper and wide screens open it
  // again, and a narrow screen then finds it as its reader left it.
  const narrow = matchMedia("screen and (max-width: 699.98px)");
  /** @type {WeakMap<HTMLDetailsElement, boolean>} */
  const left = new WeakMap(); // cell -> whether it was open
  // A live list of the cells: checking every new node on the page would block a slow phone.
  const cells = /** @type {HTMLCollectionOf<HTMLDetailsElement>} */ (
    document.getElementsByClassName("rk-code")
  );
  let folded = 0;
  const fold = () => {
    for (; folded < cells.length; folded++) cells[folded].open = !narrow.matches;
  };
  const parsed = new MutationObserver(fold);
  parsed.observe(document, {childList: true, subtree: true});
  narrow.addEventListener("change", () => {
    for (const cell of cells) {
      if (!narrow.matches) left.set(cell, cell.open);
      cell.open = !narrow.matches || (left.get(cell) ?? false);
    }
  });

  // The keyboard reaches a box that scrolls; paper needs the width of a formula.
  const sizes = new ResizeObserver(entries => {
    for (const {target: box} of entries) {
      const {fontSize, overflowX} = getComputedStyle(box);
      if (overflowX === "auto" && box.scrollWidth > box.clientWidth)
        box.setAttribute("tabindex", "0");
      else box.removeAttribute("tabindex");
      if (!(box instanceof MathMLElement) || !box.firstElementChild) continue;
      const right = box.lastElementChild?.getBoundingClientRect().right ?? 0,
        width = right - box.firstElementChild.getBoundingClientRect().left;
      box.style.setProperty("--ems", `${width / parseFloat(fontSize)}`);
    }
  });
  document.addEventListener("DOMContentLoaded", () => {
    fold();
    parsed.disconnect();
    const boxes = "pre, table, .table-wrapper, .robokin-figure, math[display=block], p, ul, ol";
    for (const box of document.querySelectorAll(`:is(main, article) :is(${boxes})`))
      if (!box.closest(".robokin-player")) sizes.observe(box);
    for (const box of document.querySelectorAll(".robokin-spatial"))
      box.scrollLeft = (box.scrollWidth - box.clientWidth) / 2;
  });
})();
