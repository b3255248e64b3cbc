// Furo says which theme a reader chose in its own words; players and explorers listen to JupyterLab's.
(() => {
  const body = document.body;
  const tell = () => {
    if (["light", "dark"].includes(body.dataset.theme)) body.dataset.jpThemeLight = String(body.dataset.theme === "light");
    else delete body.dataset.jpThemeLight; // then they follow the reader's system, as furo does
  };
  new MutationObserver(tell).observe(body, {attributeFilter: ["data-theme"]});
  tell();
})();
