// A question to answer before its view is shown. predictions.py has its data.

import {copyButton} from "./copy.js";
import {control, element, waiting} from "./elements.js";

/** @import {Made, Offer} from "./guesses.js" */
/** @import {PageAnswer, PageQuestion} from "./page.js" */

const COPY = {copy: "Copy my guesses for the report", copied: "Copied"};
const LETTERS = "abcdef";

/**
 * Shows the question in every placeholder with this id.
 * @param {string} id
 * @param {PageQuestion} data
 */
export const ask = (id, data) => waiting(id).forEach(root => new Prediction(root, data));

/** A question that is shown in `root`. */
class Prediction {
  /**
   * @param {HTMLElement} root
   * @param {PageQuestion} data
   */
  constructor(root, data) {
    this.root = root;
    this.data = data;
    this.memory = memoryOf(root);
    // A question inside the view of another question has a view of its own.
    this.view = root.querySelector(":scope > .robokin-view, :scope > details > .robokin-view");
    this.unguessed = root.querySelector(":scope > .robokin-unguessed");
    this.kept = element("p", {role: "status"});
    this.answer = element("div", {class: "rk-answer", "aria-live": "polite"});
    this.guess = control("button", {type: "button", disabled: ""}, "This is my guess");
    this.again = control("button", {type: "button", hidden: ""}, "Ask me again");
    this.clear = control("button", {type: "button", hidden: ""}, "Clear");
    this.copy = copyButton(COPY, () => line(this.memory.read(), data.name));
    this.copy.classList.add("rk-copy");
    const parts = [this.guess, this.again, this.clear, this.kept];
    this.asking = element("div", {class: "rk-asking"}, ...parts);
    this.inputs = inputsOf(data);
    this.rows = rowsOf(data, this.inputs);
    const focused = root.contains(document.activeElement);
    root.replaceChildren(
      element(
        "div",
        {class: "rk rk-ask", role: "group", "aria-label": data.title},
        element("fieldset", {}, element("legend", {}, ...coded(data.question)), ...this.rows),
        this.asking,
        this.answer,
        ...(this.unguessed ? [this.unguessed] : []),
      ),
    );
    // If the second control has the focus because the reader pressed Tab before the script started,
    // it loses the focus when it is moved.
    if (focused) this.unguessed?.querySelector("summary")?.focus();
    this.listen();
    if (data.choice === null) this.recall();
    else this.open(data.choice);
  }

  chosen() {
    const {data, inputs} = this;
    const [first] = data.unit === null ? inputs.filter(input => input.checked) : inputs;
    return first?.value ?? "";
  }

  listen() {
    const {data, inputs, guess, again, clear} = this;
    for (const input of inputs)
      input.addEventListener("input", () => {
        guess.disabled = !valid(data, this.chosen());
      });
    guess.addEventListener("click", () => this.settle(this.chosen()));
    this.root.addEventListener("keydown", event => {
      const {tagName} = /** @type {Element} */ (event.target);
      if (event.key !== "Enter" || tagName !== "INPUT") return;
      if (!valid(data, this.chosen()) || inputs[0].disabled) return;
      event.preventDefault();
      this.settle(this.chosen());
    });
    again.addEventListener("click", () => this.close());
    clear.addEventListener("click", () => {
      this.memory.write(this.memory.read().filter(([name]) => name !== data.name));
      this.close();
    });
    this.root.addEventListener("robokin-keeps", () => {
      if (!again.hidden) this.offer();
    });
  }

  /** @param {string} choice */
  open(choice) {
    const {data, rows} = this,
      at = judged(data, choice),
      right = data.options[data.right];
    for (const input of this.inputs) {
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
    this.answer.replaceChildren(
      ...told(data, at, right).map(text => element("p", {}, ...coded(text))),
      ...(this.view ? [this.view] : []),
    );
    this.unguessed?.setAttribute("hidden", "");
    this.guess.hidden = true;
    this.again.hidden = data.choice !== null;
  }

  close() {
    const {inputs, guess, again, clear} = this;
    for (const input of inputs) [input.disabled, input.checked] = [false, false];
    if (this.data.unit !== null) inputs[0].value = "";
    for (const row of this.rows) {
      row.classList.remove("rk-right", "rk-wrong");
      row.querySelector("b")?.remove();
    }
    if (this.view) this.unguessed?.append(this.view);
    for (const name of ["hidden", "open"]) this.unguessed?.removeAttribute(name);
    this.answer.replaceChildren();
    this.kept.textContent = "";
    [guess.hidden, guess.disabled, again.hidden, clear.hidden] = [false, true, true, true];
    inputs[0].focus();
  }

  /** Offers the remembered guesses to the kernel of the notebook, and shows the result. */
  offer() {
    const {data, memory, kept} = this;
    const before = this.clear.hidden ? "" : "You guessed here before. ";
    /** @type {Offer} */
    const offered = {
      path: memory.path(),
      guesses: memory.read(),
      tell: (error, saved = {}) => {
        if (error) return this.alone(before, `: ${error}.`);
        const own = memory.read().find(([name]) => name === data.name);
        const first = saved[data.name] ?? own?.[1] ?? this.chosen();
        const same = judged(data, first) === judged(data, this.chosen());
        const counts = same ? "" : ` Your first guess, ${first.split(":")[0]}, counts.`;
        kept.textContent = `${before}Saved for your report.${counts}`;
        this.copy.remove();
      },
    };
    kept.textContent = `${before}Python will save it for your report as soon as it answers.`;
    const event = new CustomEvent("robokin-guess", {cancelable: true, detail: offered});
    if (!document.dispatchEvent(event)) return;
    this.alone(
      before,
      memory.panel
        ? ". Run > Run All Cells saves it for your report."
        : ". For your report, copy your guesses into the lab's last cell.",
    );
  }

  /** Says that no kernel saves the guess. @type {(before: string, why: string) => void} */
  alone(before, why) {
    const {memory} = this,
      where = memory.lasts() ? "in this browser" : "on this page";
    this.kept.textContent = `${before}Saved ${where} only${why}`;
    const others = (memory.panel ?? document).querySelectorAll(".rk-copy");
    for (const each of others) each.remove(); // one copy button per page
    this.asking.append(this.copy);
  }

  /** @param {string} choice */
  settle(choice) {
    const {data, memory} = this;
    this.open(choice);
    const {name} = data.unit === null ? data.options[judged(data, choice)] : {};
    const made = name ? `${choice}: ${name}` : choice; // to find it after a reordering
    memory.write([...memory.read(), [data.name, made, new Date().toISOString()]]);
    this.offer();
    this.again.focus();
  }

  /** Opens the earlier choice, if this page remembers one. */
  recall(times = 50) {
    const {data, memory} = this;
    if (memory.path() === "" && times) {
      setTimeout(() => this.recall(times - 1), 100); // until JupyterLab knows the notebook's name
      return;
    }
    const [, before] = memory.read().findLast(([name]) => name === data.name) ?? [];
    if (this.guess.hidden || before === undefined || !valid(data, before)) return;
    this.open(before);
    this.clear.hidden = false;
    this.offer();
  }
}

/** A radio button for each answer, or a box for a number. @param {PageQuestion} data */
function inputsOf({unit, options}) {
  if (unit !== null)
    return [control("input", {type: "number", step: "any", "aria-label": `your guess, ${unit}`})];
  const name = `rk${Math.random()}`; // a question may occur twice in a page
  return options.map((_, i) => control("input", {type: "radio", name, value: LETTERS[i]}));
}

/**
 * @param {PageQuestion} data
 * @param {HTMLInputElement[]} inputs
 */
function rowsOf({unit, options}, inputs) {
  const texts =
    unit === null ? options.map(({text}, i) => coded(`${LETTERS[i]}) ${text}`)) : [[unit]];
  return inputs.map((input, i) =>
    element("label", {class: "rk-option"}, input, element("span", {}, ...texts[i])),
  );
}

/** @type {(data: PageQuestion, choice: string) => boolean} */
const valid = (data, choice) =>
  data.unit === null
    ? judged(data, choice) >= 0 && judged(data, choice) < data.options.length
    : choice !== "" && choice.length < 31 && Number.isFinite(+choice);

/**
 * The index of the chosen answer. For a typed number, this is the correct answer if the number is
 * near it, otherwise the nearest answer. The result is -1 if none is near.
 * @param {PageQuestion} data
 * @param {string} choice
 */
function judged(data, choice) {
  if (data.unit === null) {
    const [letter, name] = choice.split(": "),
      at = data.options.findIndex(option => name && option.name === name);
    return at < 0 && letter ? LETTERS.indexOf(letter) : at;
  }
  /** @type {(answer: PageAnswer) => number} */
  const off = ({value = NaN}) => Math.abs(+choice - value);
  /** @type {(answer: PageAnswer) => boolean} */
  const near = answer => off(answer) <= data.within * Math.abs(answer.value ?? NaN) + 1e-9;
  const {options, right} = data,
    nearest = options.filter(near).sort((a, b) => off(a) - off(b))[0];
  return near(options[right]) ? right : options.indexOf(nearest);
}

/**
 * @param {PageQuestion} data
 * @param {number} at  the index of the chosen answer
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
      ? ["No."]
      : [`No: ${data.options[at].confusion}. ${data.options[at].reason}`, data.options[at].second];
  return [
    ...own,
    `The right answer is ${letter}${text}${/[.!?]$/.test(text) ? "" : "."} ${right.reason}`,
  ].filter(text => text);
}

/** Formats text between backticks as code. @type {(text: string) => (string | HTMLElement)[]} */
const coded = text => text.split("`").map((part, k) => (k % 2 ? element("code", {}, part) : part));

/**
 * The line of code that reports the first guess of each prediction. A prediction of the same lab as
 * `own` is listed by its number, any other by its full id.
 * @param {Made[]} made
 * @param {string} own
 */
function line(made, own) {
  const lab = own.slice(0, own.indexOf(".") + 1);
  const said = made
    .filter(([name], k) => made.findIndex(each => each[0] === name) === k)
    .map(([name, choice]) => [name.startsWith(lab) ? name.slice(lab.length) : name, choice])
    .map(([name, choice]) => `${name} ${choice.split(":")[0]}`);
  return `report(who, guesses="${said.join(", ")}")`;
}

/** @type {Record<string, string>} */
const page = (Object(globalThis).robokinGuesses ??= {}); // the guesses, if there is no storage

/** The browser's storage, unless it is forbidden or, as in VS Code, shared by all notebooks. */
function storage() {
  if (!/^(http|file)/.test(location.protocol)) throw new Error("no storage");
  return localStorage;
}

/**
 * The guesses that the page of `root` remembers. In JupyterLab, whose page shows several notebooks,
 * they are those of this notebook; elsewhere, they are those of this address.
 * @param {HTMLElement} root
 */
function memoryOf(root) {
  const panel = root.closest(".jp-NotebookPanel");
  const {baseUrl = "", serverRoot = ""} = JSON.parse(
    document.getElementById("jupyter-config-data")?.textContent || "{}",
  );
  /**
   * The path of the notebook, read from its tab: null if there is no tab, "" if it is not known
   * yet.
   */
  const path = () => {
    /** @type {?HTMLElement} */
    const tab = panel && document.querySelector(`.lm-TabBar-tab[data-id="${panel.id}"]`);
    // lines of the title: "Name: x.ipynb", "Path: labs/x.ipynb", in the reader's language
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
