// A question that is answered before what answers it is seen. predictions.py says what it gets.

import {control, element, waiting} from "./elements.js";

/** @import {PageAnswer, PageQuestion} from "./page.js" */

const LETTERS = "abcdef";
const STYLE = `
.rk.rk.rk.rk-ask { box-sizing: border-box; max-width: 860px; padding: 10px 14px;
  border: 1px solid var(--rk-border); border-radius: 8px;
  background: var(--rk-paper); color: var(--rk-ink);
  font: 14px/1.4 system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', sans-serif;
  & fieldset { border: 0; margin: 0; padding: 0; min-width: 0; }
  & > fieldset * { box-sizing: border-box; }
  & legend { font-weight: 650; font-size: 15px; padding: 0; margin: 0 0 8px; white-space: normal; }
  & .rk-option { display: flex; align-items: baseline; gap: 10px; padding: 7px 8px;
    border-radius: 6px; cursor: pointer;
    margin: 0; min-height: 36px; }
  & .rk-option:hover { background: var(--rk-hover); }
  & .rk-option input[type=radio] { margin: 0; accent-color: var(--rk-accent); width: 17px;
    height: 17px; flex: none;
    transform: translateY(3px); }
  & .rk-option.rk-right { box-shadow: inset 4px 0 var(--rk-joint3); }
  & .rk-option.rk-wrong { box-shadow: inset 4px 0 var(--rk-alarm); }
  & .rk-option b { white-space: nowrap; }
  & > fieldset input[type=number] { font: inherit; width: 9em; padding: 5px 8px;
    color: var(--rk-ink); background: var(--rk-paper);
    border: 1px solid var(--rk-rest); border-radius: 6px; }
  & > .rk-asking { display: flex; gap: 12px; margin-top: 8px; }
  & > .rk-asking > button { font: inherit; color: var(--rk-ink); background: var(--rk-button);
    border: 1px solid var(--rk-rest);
    border-radius: 6px; width: auto; height: auto; min-height: 36px; padding: 0 14px; margin: 0;
    cursor: pointer; }
  & > .rk-asking > button[hidden] { display: none; }
  & > .rk-asking > button:hover { background: var(--rk-hover); }
  & > .rk-asking > button:disabled { opacity: 0.5; cursor: default; }
  & :focus-visible { outline: 3px solid var(--rk-accent); outline-offset: 2px; }
  & .rk-answer > p { margin: 8px 0; max-width: 68ch; }
  & .rk-answer > div { margin: 10px 0; overflow-x: auto; }
  & .rk-answer > div > p { margin: 3px 0; }
  & .rk-answer > div > img { max-width: 100%; height: auto; }
  & code { font: 12.5px ui-monospace, Menlo, Consolas, monospace; background: var(--rk-button);
    color: var(--rk-ink);
    padding: 2px 5px; border-radius: 4px; }
  @media print { & > .rk-asking > button { display: none; } }
}`;

/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {PageQuestion} data
 */
export const ask = (id, data) =>
  waiting(id).forEach((root, copy) => start(root, data, `${id}-${copy}`));

/**
 * A question in `root`.
 * @param {HTMLElement} root
 * @param {PageQuestion} data
 * @param {string} group  a name for the answers that belong together
 */
function start(root, data, group) {
  const answer = element("div", {class: "rk-answer", "aria-live": "polite"});
  const guess = control("button", {type: "button", disabled: ""}, "This is my guess");
  const again = control("button", {type: "button", hidden: ""}, "Ask me again");
  const inputs =
    data.unit === null
      ? data.options.map((_, i) =>
          control("input", {type: "radio", name: group, value: LETTERS[i]}),
        )
      : [control("input", {type: "number", step: "any", "aria-label": `your guess, ${data.unit}`})];
  const rows =
    data.unit === null
      ? data.options.map(({text}, i) =>
          element(
            "label",
            {class: "rk-option"},
            inputs[i],
            element("span", {}, ...coded(`${LETTERS[i]}) ${text}`)),
          ),
        )
      : [element("label", {class: "rk-option"}, inputs[0], element("span", {}, data.unit))];
  const chosen = () =>
    (data.unit === null ? inputs.find(input => input.checked)?.value : inputs[0].value) ?? "";

  /** @param {string} choice */
  function open(choice) {
    const at = judged(data, choice),
      right = data.options[data.right];
    for (const input of inputs) {
      input.disabled = true;
      if (data.unit !== null) input.value = choice;
      else input.checked = input.value === choice;
    }
    if (data.unit === null)
      rows.forEach((row, i) => {
        const marks = [...(i === data.right ? ["right"] : []), ...(i === at ? ["your guess"] : [])];
        row.classList.toggle("rk-right", i === data.right);
        row.classList.toggle("rk-wrong", i === at && at !== data.right);
        if (marks.length) row.append(element("b", {}, `\u2190 ${marks.join(", ")}`));
      });
    answer.replaceChildren(
      ...told(data, at, right).map(text => element("p", {}, ...coded(text))),
      ...(data.view ? [view(data.view)] : []),
      ...(data.choice === null
        ? [
            element(
              "p",
              {},
              "For your report, make it the cell's line: ",
              element("code", {}, line(data, choice)),
            ),
          ]
        : []),
    );
    guess.hidden = true;
    again.hidden = data.choice !== null;
  }
  function close() {
    for (const input of inputs) [input.disabled, input.checked] = [false, false];
    if (data.unit !== null) inputs[0].value = "";
    for (const row of rows) {
      row.classList.remove("rk-right", "rk-wrong");
      row.querySelector("b")?.remove();
    }
    answer.replaceChildren();
    [guess.hidden, guess.disabled, again.hidden] = [false, true, true];
  }

  /** @param {string} choice */
  const settle = choice => {
    open(choice);
    keep(data.name, choice);
  };
  for (const input of inputs)
    input.addEventListener("input", () => {
      guess.disabled = !valid(data, chosen());
    });
  guess.addEventListener("click", () => {
    settle(chosen());
    again.focus();
  });
  root.addEventListener("keydown", event => {
    if (
      event.key !== "Enter" ||
      /** @type {Element} */ (event.target).tagName !== "INPUT" ||
      !valid(data, chosen()) ||
      inputs[0].disabled
    )
      return;
    event.preventDefault();
    settle(chosen());
    again.focus();
  });
  again.addEventListener("click", () => {
    close();
    keep(data.name, "");
    inputs[0].focus();
  });
  root.replaceChildren(
    element(
      "div",
      {class: "rk rk-ask", role: "group", "aria-label": data.title},
      element("style", {}, STYLE),
      element("fieldset", {}, element("legend", {}, ...coded(data.question)), ...rows),
      element("div", {class: "rk-asking"}, guess, again),
      answer,
    ),
  );
  const before = data.choice ?? kept(data.name);
  if (before !== null && valid(data, before)) open(before);
}

/** @type {(data: PageQuestion, choice: string) => boolean} */
const valid = (data, choice) =>
  data.unit === null
    ? choice !== "" && LETTERS.indexOf(choice) < data.options.length && LETTERS.includes(choice)
    : choice !== "" && Number.isFinite(+choice);

/**
 * Which answer is meant: its number; of a typed number the answer that it is near to, the right one
 * first; -1: none.
 * @param {PageQuestion} data
 * @param {string} choice
 */
function judged(data, choice) {
  if (data.unit === null) return LETTERS.indexOf(choice);
  /** @type {(answer: PageAnswer) => boolean} */
  const near = ({value = NaN}) => Math.abs(+choice - value) <= data.within * Math.abs(value) + 1e-9;
  return near(data.options[data.right]) ? data.right : data.options.findIndex(near);
}

/**
 * @param {PageQuestion} data
 * @param {number} at  which answer was meant
 * @param {PageAnswer} right
 */
function told(data, at, right) {
  const letter = data.unit === null ? `${LETTERS[data.right]}) ` : "";
  const text =
    data.unit === null
      ? right.text
      : right.text.replace("-", "\u2212") + (data.unit[0] === "\u00B0" ? "" : " ") + data.unit;
  if (at === data.right) return [`Right. ${right.reason}`];
  const own =
    at < 0
      ? ["Not so."]
      : [
          `Not so: ${data.options[at].confusion}. ${data.options[at].reason}`,
          data.options[at].second,
        ];
  return [
    ...own,
    `Right is ${letter}${text}${/[.!?]$/.test(text) ? "" : "."} ${right.reason}`,
  ].filter(text => text);
}

/** Words between back-ticks are code. @type {(text: string) => (string | HTMLElement)[]} */
const coded = text => text.split("`").map((part, k) => (k % 2 ? element("code", {}, part) : part));

/** @type {(data: PageQuestion, choice: string) => string} */
const line = (data, choice) =>
  `predict("${data.name}", ${data.unit === null ? `"${choice}"` : +choice})`;

/**
 * Scripts of a player or an explorer run as soon as they are in the page.
 * @param {string} html
 */
const view = html => element("div", {}, document.createRange().createContextualFragment(html));

/**
 * The browser may forbid it, or forget: then nothing is remembered.
 * @type {(name: string, choice: string) => void}
 */
const keep = (name, choice) => {
  try {
    localStorage.setItem(`robokin ${name}`, choice);
  } catch {
    /* forbidden */
  }
};
/** @type {(name: string) => ?string} */
const kept = name => {
  try {
    return localStorage.getItem(`robokin ${name}`) || null;
  } catch {
    return null;
  }
};
