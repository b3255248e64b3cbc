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
