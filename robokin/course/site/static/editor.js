// The editor of a cell: prism-code-editor, or a plain box of text where it cannot be loaded.

/**
 * @typedef {object} Editor
 * @property {HTMLTextAreaElement} box
 * @property {(text: string) => void} set
 * @property {(line: number) => void} point  marks a line, counting from 1, and no other one
 */
/**
 * What we use of prism-code-editor.
 * @typedef {object} Prism
 * @property {(place: Element, options: object, ...more: object[]) => PrismEditor} createEditor
 */
/**
 * @typedef {object} PrismEditor
 * @property {HTMLElement} container
 * @property {HTMLCollection} lines  the lines of code; before them stands the textarea
 * @property {HTMLTextAreaElement} textarea
 * @property {(options: {value: string}) => void} setOptions
 */

const HELP = "rk-editor-help";

/**
 * Puts an editor into `place`.
 * @param {Element} place
 * @param {string} text
 * @param {string} label
 * @param {(text: string) => void} changed
 * @returns {Promise<Editor>}
 */
export async function editor(place, text, label, changed) {
  const made = await prism(place, text).catch(() => plain(place, text));
  const {box} = made;
  box.setAttribute("aria-label", label);
  box.setAttribute("aria-describedby", HELP);
  box.spellcheck = false;
  box.addEventListener("input", () => changed(box.value));
  help();
  return made;
}

/** @type {(place: Element, text: string) => Promise<Editor>} */
async function prism(place, text) {
  const base = new URL("../python/editor/", import.meta.url).href;
  const [{createEditor}, {defaultCommands, editHistory}] = await Promise.all([
    import(`${base}index.js`),
    import(`${base}extensions/commands/index.js`),
    import(`${base}prism/languages/python.js`),
    import(`${base}languages/python.js`),
    style(`${base}layout.css`),
  ]);
  const options = {language: "python", value: text, tabSize: 4, lineNumbers: false};
  /** @type {PrismEditor} */
  const made = createEditor(place, options, defaultCommands(), editHistory());
  return {
    box: made.textarea,
    set: value => {
      made.setOptions({value});
      made.container.scrollLeft = 0;
    },
    point: line => {
      for (const [k, each] of [...made.lines].entries())
        each.classList.toggle("rk-failed", k > 0 && k === line);
    },
  };
}

/** @type {(place: Element, text: string) => Editor} */
function plain(place, text) {
  const box = document.createElement("textarea");
  const set = (/** @type {string} */ value) => {
    box.value = value;
    box.rows = value.split("\n").length;
  };
  box.className = "rk-plain";
  box.wrap = "off";
  box.addEventListener("input", () => (box.rows = box.value.split("\n").length));
  set(text);
  place.replaceChildren(box);
  return {box, set, point: () => {}};
}

/** Loads a style sheet once. @param {string} address */
function style(address) {
  if (document.querySelector(`link[href="${address}"]`)) return;
  const link = document.createElement("link");
  Object.assign(link, {rel: "stylesheet", href: address});
  document.head.prepend(link); // ours comes later
  return new Promise((resolve, reject) => {
    link.onload = resolve;
    link.onerror = reject;
  });
}

/** The sentence about the keys, for all editors. */
function help() {
  if (document.getElementById(HELP)) return;
  const line = document.createElement("p");
  [line.id, line.hidden] = [HELP, true];
  line.textContent =
    "Shift+Enter runs the cell. Tab indents; press Escape, then Tab, to leave the editor.";
  document.body.append(line);
}
