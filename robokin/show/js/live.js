// What asks the kernel. A view in the page is asleep until a kernel's model finds it
// (waking.js): events on the view's place in the page carry what both say.

import {element} from "./elements.js";

/**
 * What stands in an answer in the place of an array: its number among the buffers, or itself in
 * base64.
 * @typedef {{array: number | string, type: keyof typeof TYPES, shape: number[]}} StoredArray
 */
/**
 * The same as it is read.
 * @typedef {{values: InstanceType<typeof TYPES[keyof typeof TYPES]>, shape: number[]}} Values
 */
/** @typedef {(n: number, question: unknown) => void} Port  to the kernel */
/** @typedef {{n: number, answer: {error?: string}, buffers: DataView<ArrayBuffer>[]}} Arrived */

const PATIENCE = 4000; // ms without an answer; then the view says so
// Two questions under way: the second carries the receipt without which the first answer is held
// back for 40 ms on its way (Nagle's algorithm meets the delayed receipt).
const UNDER_WAY = 2;
// ms from question to answer: then a second one would only wait for the first, and grow old
const SLOW = 100;

/**
 * The way from a view to its kernel.
 *
 * ask(question)  whatever JSON can hold. The newest question is always answered in the end, by the
 *                next kernel if this one leaves; older ones may be skipped while it is at work.
 *
 * While asleep, controls and handles do not take a hand, and one sentence says why. `root.dataset`
 * tells: `awake`, the numbers of the last question `asked` and the last one `answered`.
 *
 * @template Question
 * @template Answer
 * @param {HTMLElement} root  in which the view has been built
 * @param {string} id  of the output
 * @param {Record<string, string>} words  asleep, waiting, failed
 * @param {(answer: Answer, question: Question) => void} hear
 * @returns {{ask: (question: Question) => void}}
 */
export function kernelOf(root, id, words, hear) {
  const says = element("p", {class: "rk-asleep", role: "status"});
  root.firstElementChild?.append(says);
  /** @type {?Port} */
  let port = null;
  /** @type {?Question} */
  let wanted = null;
  let sent = 0,
    timer = 0,
    slow = false;
  /** @type {Map<number, {question: Question, at: number}>} */
  const questions = new Map();

  /** @type {(awake: boolean, sentence?: string) => void} */
  function stir(awake, sentence = "") {
    root.toggleAttribute("data-awake", awake);
    const parts = /** @type {NodeListOf<HTMLElement>} */ (
      root.querySelectorAll(".rk-handles, .rk-side")
    );
    for (const part of parts) part.inert = !awake;
    says.textContent = sentence;
    says.hidden = !sentence;
  }
  /** Takes back what has no answer yet: the newest of it is asked again. */
  function takeBack() {
    clearTimeout(timer);
    wanted ??= [...questions.values()].at(-1)?.question ?? null;
    questions.clear();
  }
  function sleep() {
    takeBack();
    port = null;
    stir(false, words.asleep);
  }
  function pump() {
    while (port && wanted && questions.size < (slow ? 1 : UNDER_WAY)) {
      const question = wanted;
      [wanted, sent] = [null, sent + 1];
      questions.set(sent, {question, at: performance.now()});
      root.dataset.asked = String(sent);
      try {
        port(sent, question);
      } catch {
        // its kernel is gone
        return sleep();
      }
    }
    clearTimeout(timer);
    if (questions.size) timer = setTimeout(() => stir(false, words.waiting), PATIENCE);
  }
  root.addEventListener("robokin-wake", event => {
    takeBack();
    port = /** @type {CustomEvent<Port>} */ (event).detail;
    stir(true);
    pump();
  });
  root.addEventListener("robokin-sleep", sleep);
  root.addEventListener("robokin-answer", event => {
    const {n, answer, buffers} = /** @type {CustomEvent<Arrived>} */ (event).detail,
      about = questions.get(n);
    if (!port || !about) return;
    const {question, at} = about;
    slow = performance.now() - at > SLOW;
    for (const k of questions.keys()) if (k <= n) questions.delete(k);
    stir(true, answer.error ? words.failed.replace("{error}", answer.error) : "");
    if (!answer.error) hear(/** @type {Answer} */ (unpacked(answer, buffers)), question);
    root.dataset.answered = String(n);
    pump();
  });
  sleep();
  document.dispatchEvent(new CustomEvent("robokin-asks", {detail: {id, root}}));
  return {
    ask(question) {
      wanted = question;
      pump();
    },
  };
}

const TYPES = {uint8: Uint8Array, uint16: Uint16Array, int16: Int16Array, float32: Float32Array};

/**
 * An answer with its arrays: live.py sends {"array": its number, or base64, "type", "shape"} in
 * their place.
 * @param {unknown} answer
 * @param {DataView<ArrayBuffer>[]} [buffers]
 * @returns {unknown}  Values in the place of each array
 */
export function unpacked(answer, buffers = []) {
  if (Array.isArray(answer)) return answer.map(each => unpacked(each, buffers));
  if (!answer || typeof answer !== "object") return answer;
  if (!("array" in answer))
    return Object.fromEntries(
      Object.entries(answer).map(([key, value]) => [key, unpacked(value, buffers)]),
    );
  const {array, type, shape} = /** @type {StoredArray} */ (answer);
  const bytes =
    typeof array === "string"
      ? Uint8Array.from(atob(array), letter => letter.charCodeAt(0))
      : buffers[array];
  // a copy: a buffer may begin at an odd place
  const values = new TYPES[type](
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength),
  );
  return {values, shape};
}
