// A question that is answered before what answers it is seen. predictions.py says what it gets.

import {copyButton} from "./copy.js";
import {control, element, waiting} from "./elements.js";

/** @import {Made, Offer} from "./guesses.js" */
/** @import {PageAnswer, PageQuestion} from "./page.js" */

const COPY = {copy: "Copy my guesses for the report", copied: "Copied"};
const LETTERS = "abcdef";
/**
 * Fills every waiting place with this id.
 * @param {string} id
 * @param {PageQuestion} data
 */
export const ask = (id, data) => waiting(id).forEach(root => start(root, data));

/**
 * A question in `root`.
 * @param {HTMLElement} root
 * @param {PageQuestion} data
 */
function start(root, data) {
  const memory = memoryOf(root);
  const group = `rk${Math.random()}`; // a question may stand in a page twice
  const kept = element("p", {role: "status"});
  const answer = element("div", {class: "rk-answer", "aria-live": "polite"});
  const guess = control("button", {type: "button", disabled: ""}, "This is my guess");
  const again = control("button", {type: "button", hidden: ""}, "Ask me again");
  const clear = control("button", {type: "button", hidden: ""}, "Clear");
  const copy = copyButton(COPY, () => line(memory.read(), data.name));
  copy.classList.add("rk-copy");
  const asking = element("div", {class: "rk-asking"}, guess, again, clear, kept);
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
      else input.checked = input.value === LETTERS[at];
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
    kept.textContent = "";
    [guess.hidden, guess.disabled, again.hidden, clear.hidden] = [false, true, true, true];
  }

  /** Offers what this page remembers to the kernel of its notebook, and says what came of it. */
  function offer() {
    const before = clear.hidden ? "" : "You guessed here before. ";
    /** @type {(why: string) => void} */
    const alone = why => {
      const where = memory.lasts() ? "in this browser" : "on this page";
      kept.textContent = `${before}Kept ${where} only${why}`;
      const others = (memory.panel ?? document).querySelectorAll(".rk-copy");
      for (const each of others) each.remove(); // one in a page
      asking.append(copy);
    };
    /** @type {Offer} */
    const offered = {
      path: memory.path(),
      guesses: memory.read(),
      tell(error) {
        if (error) return alone(`: ${error}.`);
        const first = memory.read().find(([name]) => name === data.name)?.[1] ?? chosen();
        const same = judged(data, first) === judged(data, chosen());
        const counts = same ? "" : ` Your first guess, ${first.split(":")[0]}, counts.`;
        kept.textContent = `${before}Kept for your report.${counts}`;
        copy.remove();
      },
    };
    kept.textContent = `${before}Python keeps it for your report as soon as it answers.`;
    const event = new CustomEvent("robokin-guess", {cancelable: true, detail: offered});
    if (!document.dispatchEvent(event)) return;
    alone(
      memory.panel
        ? ". Run > Run All Cells, and it is kept for your report."
        : ". For your report, copy your guesses into the lab's last cell.",
    );
  }

  /** @param {string} choice */
  const settle = choice => {
    open(choice);
    const {name} = data.unit === null ? data.options[judged(data, choice)] : {};
    const made = name ? `${choice}: ${name}` : choice; // the name stays if answers change places
    memory.write([...memory.read(), [data.name, made, new Date().toISOString()]]);
    offer();
  };
  function recall(times = 50) {
    if (memory.path() === "" && times) {
      setTimeout(recall, 100, times - 1); // JupyterLab names the notebook a moment later
      return;
    }
    const [, before] = memory.read().findLast(([name]) => name === data.name) ?? [];
    if (guess.hidden || before === undefined || !valid(data, before)) return;
    open(before);
    clear.hidden = false;
    offer();
  }
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
    inputs[0].focus();
  });
  clear.addEventListener("click", () => {
    memory.write(memory.read().filter(([name]) => name !== data.name));
    close();
    inputs[0].focus();
  });
  root.addEventListener("robokin-keeps", () => {
    if (!again.hidden) offer();
  });
  root.replaceChildren(
    element(
      "div",
      {class: "rk rk-ask", role: "group", "aria-label": data.title},
      element("fieldset", {}, element("legend", {}, ...coded(data.question)), ...rows),
      asking,
      answer,
    ),
  );
  if (data.choice === null) recall();
  else open(data.choice);
}

/** @type {(data: PageQuestion, choice: string) => boolean} */
const valid = (data, choice) =>
  data.unit === null
    ? judged(data, choice) >= 0 && judged(data, choice) < data.options.length
    : choice !== "" && choice.length < 31 && Number.isFinite(+choice);

/**
 * Which answer is meant: its number; of a typed number the answer that it is near to, the right one
 * first; -1: none.
 * @param {PageQuestion} data
 * @param {string} choice
 */
function judged(data, choice) {
  if (data.unit === null) {
    const [letter, name] = choice.split(": "),
      at = data.options.findIndex(option => name && option.name === name);
    return at < 0 && letter ? LETTERS.indexOf(letter) : at;
  }
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

/**
 * The line for a report: the first guess of each prediction of the lab that `own` is of.
 * @param {Made[]} made
 * @param {string} own
 */
function line(made, own) {
  const lab = own.slice(0, own.indexOf(".") + 1);
  const said = made
    .filter(([name], k) => name.startsWith(lab) && made.findIndex(each => each[0] === name) === k)
    .map(([name, choice]) => `${name.slice(lab.length)} ${choice.split(":")[0]}`);
  return `report(who, guesses="${said.join(", ")}")`;
}

/**
 * Scripts of a player or an explorer run as soon as they are in the page.
 * @param {string} html
 */
const view = html => element("div", {}, document.createRange().createContextualFragment(html));

/** @type {Record<string, string>} */
const page = (Object(globalThis).robokinGuesses ??= {}); // what is kept where no storage is

/** The browser's, if it allows it and if notebooks have addresses: in VS Code all have the same. */
function storage() {
  if (!/^(http|file)/.test(location.protocol)) throw new Error("no storage");
  return localStorage;
}

/**
 * The guesses that the page of `root` remembers: of this notebook in JupyterLab, whose page has
 * several; elsewhere of this address.
 * @param {HTMLElement} root
 */
function memoryOf(root) {
  const panel = root.closest(".jp-NotebookPanel");
  const {baseUrl = "", serverRoot = ""} = JSON.parse(
    document.getElementById("jupyter-config-data")?.textContent || "{}",
  );
  /** Of the notebook, as its tab says it; null: there is no tab; "": it does not say it yet. */
  const path = () => {
    /** @type {?HTMLElement} */
    const tab = panel && document.querySelector(`.lm-TabBar-tab[data-id="${panel.id}"]`);
    // "Name: x.ipynb", "Path: labs/x.ipynb", in the reader's language
    const lines = tab && [...tab.title.matchAll(/^[^:\uff1a]*[:\uff1a]\s*(.+\.ipynb)$/gm)];
    return lines && (lines.at(-1)?.[1] ?? "");
  };
  const key = () => `robokin ${baseUrl} ${serverRoot} ${path() || location.pathname}`;
  return {
    panel,
    path,
    /** @returns {Made[]} */
    read() {
      try {
        return JSON.parse(page[key()] ?? storage().getItem(key())).filter(Array.isArray);
      } catch {
        return [];
      }
    },
    /** @param {Made[]} made */
    write(made) {
      delete page[key()];
      try {
        storage().setItem(key(), JSON.stringify(made));
      } catch {
        page[key()] = JSON.stringify(made);
      }
    },
    lasts: () => page[key()] === undefined,
  };
}
