// Furo has its own name for the theme that a reader chose; players and explorers read JupyterLab's.
(() => {
  const body = document.body;
  const tell = () => {
    const {theme} = body.dataset;
    if (theme === "light" || theme === "dark")
      body.dataset.jpThemeLight = String(theme === "light");
    else delete body.dataset.jpThemeLight; // then they follow the reader's system, as furo does
  };
  new MutationObserver(tell).observe(body, {attributeFilter: ["data-theme"]});
  tell();
})();

// Labs run their cells in the page (lab.js), but a browser loads no modules from a folder.
(() => {
  const here = /** @type {HTMLScriptElement} */ (document.currentScript).src,
    why = document.querySelector(".rk-asleep-cells");
  if (!document.getElementById("rk-lab")) return;
  if (location.protocol !== "file:") void import(new URL("lab.js", here).href);
  else if (why) {
    why.textContent =
      "This page was opened from a folder, so its cells cannot run here. " +
      "They run if you open the page at a web address.";
    why.classList.add("rk-said");
  }
})();
