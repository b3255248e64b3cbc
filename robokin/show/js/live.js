// Sends questions to the kernel. A view is inactive until the model of a kernel finds it
// (waking.js). They communicate through events on the view's element in the page.

import {element} from "./elements.js";

/**
 * The replacement for an array in an answer: its index among the buffers, or its data in base64.
 * @typedef {{array: number | string, type: keyof typeof TYPES, shape: number[]}} StoredArray
 */
/**
 * An array that has been decoded.
 * @typedef {{values: InstanceType<typeof TYPES[keyof typeof TYPES]>, shape: number[]}} Values
 */
/** @typedef {(n: number, question: unknown) => void} Port  sends a question to the kernel */
/** @typedef {{n: number, answer: {error?: string}, buffers: DataView<ArrayBuffer>[]}} Arrived */

const PATIENCE = 4000; // ms: if no answer arrives within this time, the view says so
// Up to two questions may be under way: the second carries the acknowledgement without which the
// first answer is delayed by 40 ms (Nagle's algorithm with delayed acknowledgements).
const UNDER_WAY = 2;
// ms: if an answer takes longer than this, a second question would only wait and become stale
const SLOW = 100;

/**
 * The connection from a view to its kernel.
 *
 * ask(question)  asks anything that JSON can represent. The newest question is always answered in
 *                the end, by the next kernel if this one ends; older ones may be skipped while the
 *                kernel is busy.
 *
 * While the view is inactive, its controls and handles are disabled, and a sentence says why.
 * Handles that also react to taps (`rk-taps`) stay enabled; they check `awake` before they move.
 * When it becomes inactive, its element gets the event `robokin-slept`.
 * `root.dataset` contains `awake` while it is active, and the numbers of the last question `asked`
 * and of the last question `answered`.
 *
 * @template Question
 * @template Answer
 * @param {HTMLElement} root  the element in which the view has been built
 * @param {string} id  the id of the output
 * @param {Record<string, string>} words  the sentences `asleep`, `waiting` and `failed`
 * @param {(answer: Answer, question: Question) => void} hear
 * @returns {{ask: (question: Question) => void}}
 */
export function kernelOf(root, id, words, hear) {
  /** @type {Questions<Question>} */
  const questions = new Questions(root, words);
  root.addEventListener("robokin-wake", event =>
    questions.wake(/** @type {CustomEvent<Port>} */ (event).detail),
  );
  root.addEventListener("robokin-sleep", () => questions.sleep());
  root.addEventListener("robokin-answer", event => {
    const {n, answer, buffers} = /** @type {CustomEvent<Arrived>} */ (event).detail,
      about = questions.answered(n);
    if (!about) return;
    questions.stir(true, answer.error ? words.failed.replace("{error}", answer.error) : "");
    questions.send(); // before the answer is drawn, so that Python and the page work side by side
    if (!answer.error) hear(/** @type {Answer} */ (joinArrays(answer, buffers)), about.question);
    root.dataset.answered = String(n);
  });
  questions.sleep();
  document.dispatchEvent(new CustomEvent("robokin-asks", {detail: {id, root}}));
  return {ask: question => questions.ask(question)};
}

/**
 * The questions of a view: the next one, those that have been sent, and the port to the kernel.
 * @template Question
 */
class Questions {
  /**
   * @param {HTMLElement} root
   * @param {Record<string, string>} words
   */
  constructor(root, words) {
    this.root = root;
    this.words = words;
    this.says = element("p", {class: "rk-asleep", role: "status"});
    root.firstElementChild?.append(this.says);
    /** @type {?Port} */
    this.port = null;
    /** @type {?Question} */
    this.wanted = null;
    /** @type {Map<number, {question: Question, at: number}>} */
    this.underWay = new Map();
    this.sent = 0;
    this.timer = 0;
    this.slow = false;
  }

  /** Shows whether the view is active. @type {(awake: boolean, sentence?: string) => void} */
  stir(awake, sentence = "") {
    this.root.toggleAttribute("data-awake", awake);
    const parts = /** @type {NodeListOf<HTMLElement>} */ (
      this.root.querySelectorAll(".rk-handles:not(.rk-taps), .rk-side")
    );
    for (const part of parts) part.inert = !awake;
    this.says.textContent = sentence;
    this.says.hidden = !sentence;
  }

  /** Forgets the unanswered questions, but asks the newest of them again later. */
  takeBack() {
    clearTimeout(this.timer);
    this.wanted ??= [...this.underWay.values()].at(-1)?.question ?? null;
    this.underWay.clear();
  }

  /** @param {Port} port */
  wake(port) {
    this.takeBack();
    this.port = port;
    this.stir(true);
    this.send();
  }

  sleep() {
    this.takeBack();
    this.port = null;
    this.stir(false, this.words.asleep);
    this.root.dispatchEvent(new CustomEvent("robokin-slept"));
  }

  /** @param {Question} question */
  ask(question) {
    this.wanted = question;
    this.send();
  }

  send() {
    while (this.port && this.wanted && this.underWay.size < (this.slow ? 1 : UNDER_WAY)) {
      const question = this.wanted;
      [this.wanted, this.sent] = [null, this.sent + 1];
      this.underWay.set(this.sent, {question, at: performance.now()});
      this.root.dataset.asked = String(this.sent);
      try {
        this.port(this.sent, question);
      } catch {
        // its kernel has ended
        return this.sleep();
      }
    }
    clearTimeout(this.timer);
    if (this.underWay.size)
      this.timer = setTimeout(() => this.stir(false, this.words.waiting), PATIENCE);
  }

  /** Returns the question of answer n if it has not been answered yet. @param {number} n */
  answered(n) {
    const about = this.underWay.get(n);
    if (!this.port || !about) return null;
    this.slow = performance.now() - about.at > SLOW;
    for (const k of this.underWay.keys()) if (k <= n) this.underWay.delete(k);
    return about;
  }
}

const TYPES = {uint8: Uint8Array, uint16: Uint16Array, int16: Int16Array, float32: Float32Array};

/**
 * Returns an answer with its arrays. In place of each array, live.py sends {"array": its index or
 * its data in base64, "type", "shape"}.
 * @param {unknown} answer
 * @param {DataView<ArrayBuffer>[]} [buffers]
 * @returns {unknown}  the answer, with Values in place of each array
 */
export function joinArrays(answer, buffers = []) {
  if (Array.isArray(answer)) return answer.map(each => joinArrays(each, buffers));
  if (!answer || typeof answer !== "object") return answer;
  if (!("array" in answer))
    return Object.fromEntries(
      Object.entries(answer).map(([key, value]) => [key, joinArrays(value, buffers)]),
    );
  const {array, type, shape} = /** @type {StoredArray} */ (answer);
  const bytes =
    typeof array === "string"
      ? Uint8Array.from(atob(array), letter => letter.charCodeAt(0))
      : buffers[array];
  // a copy, since a buffer may begin at an unaligned offset
  const values = new TYPES[type](
    bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength),
  );
  return {values, shape};
}
