// Fills the blanks of the sentences from explanations.py and explorer.py with numbers in Python's
// format.

import {rint} from "./angles.js";

/** @typedef {Object<string, string | number>} Facts  the values for the blanks, by name */

/**
 * Fills in the blanks of a sentence.
 * @param {string} sentence
 * @param {Facts} facts
 * @returns {string}
 */
export const fill = (sentence, facts) =>
  sentence.replace(/\{(\w+)\}/g, (_, name) => String(facts[name]));

/**
 * Formats a number with one decimal, as in Python, which rounds a half to even.
 * @param {number} x
 */
export const oneDecimal = x => ((4 * x) % 1 === 0 ? rint(10 * x) / 10 : x).toFixed(1);

/**
 * A length as text, as `in_words` in units.py returns it.
 * @param {number} x  metres
 */
export const inWords = x => (x < 10 ? `${oneDecimal(x / 1e-3)} mm` : `${oneDecimal(x)} m`);

/**
 * A number as Python code.
 * @param {number} x
 * @param {number} decimals
 */
export const plain = (x, decimals) => String(+x.toFixed(decimals));
