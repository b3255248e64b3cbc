// Exported pages and the site. Runs before the cells are parsed.
(() => {
  // Narrow screens fold code. We close a cell while the page is being parsed, before it is painted,
  // so nothing flashes or moves; without scripts it stays open. Paper and wide screens open it
  // again, and a narrow screen then finds it as its reader left it. When a phone is turned, the
  // browser keeps the text in place that is being read (scroll anchoring).
  const narrow = matchMedia("screen and (max-width: 699.98px)");
  const left = new WeakMap(); // cell -> whether it was open
  const fold = records => {
    for (const node of records.flatMap(record => [...record.addedNodes]))
      if (node instanceof HTMLDetailsElement && node.matches(".rk-code"))
        node.open = !narrow.matches;
  };
  const parsed = new MutationObserver(fold);
  parsed.observe(document, {childList: true, subtree: true});
  narrow.addEventListener("change", () => {
    for (const cell of document.querySelectorAll("details.rk-code")) {
      if (!narrow.matches) left.set(cell, cell.open);
      cell.open = !narrow.matches || (left.get(cell) ?? false);
    }
  });

  // The keyboard reaches a box that scrolls; paper needs the width of a formula.
  const sizes = new ResizeObserver(entries => {
    for (const {target: box} of entries) {
      if (box.scrollWidth > box.clientWidth) box.setAttribute("tabindex", "0");
      else box.removeAttribute("tabindex");
      if (box.matches("math") && box.firstElementChild) {
        const [first, last] = [box.firstElementChild, box.lastElementChild];
        const wide = last.getBoundingClientRect().right - first.getBoundingClientRect().left;
        box.style.setProperty("--ems", `${wide / parseFloat(getComputedStyle(box).fontSize)}`);
      }
    }
  });
  document.addEventListener("DOMContentLoaded", () => {
    fold(parsed.takeRecords());
    parsed.disconnect();
    const boxes = "pre, table, .table-wrapper, math[display=block], p, ul, ol";
    for (const box of document.querySelectorAll(`:is(main, article) :is(${boxes})`))
      if (!box.closest(".robokin-player")) sizes.observe(box);
  });
})();
