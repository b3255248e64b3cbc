// Chooses which handles are shown in a scene that has no room for all of them.

import {control, element} from "./elements.js";

const finger = matchMedia("screen and ((pointer: coarse) or (max-width: 699px))");

/**
 * Whether handles and controls are large enough for a finger, which paper does not need. The style
 * sheets have the same rule.
 */
export const large = () => finger.matches;

const ROOM = 520; // px: a narrower scene has no room for many large handles
const FEW = 4; // the number of handles for which every scene has room

/**
 * Buttons, one for each group of handles. The handles of the chosen group are shown.
 *
 * set(groups)     sets the group of each handle
 * update(width)   shows the buttons if a scene of this width needs them; call it before `stands`
 * stands(group)   returns whether the handles of this group are shown
 *
 * @param {() => void} changed  called when the reader has chosen
 */
export function handleChooser(changed) {
  const row = element("div", {class: "rk-row rk-chooser"});
  /** @type {string[]} */
  let names = [];
  let chosen = 0,
    many = false;
  row.hidden = true;
  const tell = () =>
    [...row.children].forEach((node, k) => node.setAttribute("aria-pressed", String(k === chosen)));
  /** @type {(name: string, k: number) => HTMLElement} */
  const button = (name, k) => {
    const node = control("button", {type: "button", class: "rk-word"}, name);
    node.addEventListener("click", () => {
      chosen = k;
      tell();
      changed();
    });
    return node;
  };
  return {
    row,
    /** @param {string[]} groups */
    set(groups) {
      names = [...new Set(groups)];
      many = groups.length > FEW && names.length > 1;
      row.replaceChildren(...names.map(button));
      tell();
    },
    /** @param {number} width */
    update(width) {
      row.hidden = !(many && width < ROOM && large());
    },
    /** @param {string} group */
    stands: group => row.hidden || group === names[chosen],
  };
}
