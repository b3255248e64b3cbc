// A button that copies text.

import {control} from "./elements.js";

/**
 * @param {Record<string, string>} words  the text of the button: `copy`, and `copied` after it has
 *   copied
 * @param {() => string} text
 */
export function copyButton(words, text) {
  const button = control("button", {type: "button", class: "rk-word"}, words.copy);
  const area = control("textarea", {readonly: "", "aria-label": words.copy});
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text());
    } catch {
      // a page opened from a file may not use the clipboard API: use the deprecated command or, if
      // that fails too, let the reader copy the text
      area.value = text();
      button.after(area);
      area.select();
      if (!document.execCommand("copy")) return;
      button.focus();
    }
    area.remove();
    button.textContent = words.copied;
    setTimeout(() => {
      button.textContent = words.copy;
    }, 1500);
  });
  return button;
}
