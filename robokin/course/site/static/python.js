// The page's side of Python: fetches its files once, starts a worker, asks it, and ends it.

/** @import {Said} from "./worker.js" */

/** @typedef {{name: string, size: number}} File */
/** @typedef {(sentence: string) => void} Say */
/** @typedef {{reject: (why: Error) => void, resolve: (value: unknown) => void}} Waiting */

/** Why a call has no result: the reader or the page ended Python. */
export class Ended extends Error {
  /**
   * @param {"stopped" | "check" | "memory" | "failed"} how
   * @param {string} sentence
   */
  constructor(how, sentence) {
    super(sentence);
    this.how = how;
  }
}

const AGAIN = "Run any cell: Python starts again, and first runs the cells that this one needs.";

/** Python, from the first call on. */
export class Python {
  /**
   * @param {File[]} files
   * @param {string} version  of the files, so that the browser never uses an older one
   * @param {() => void} ended  called when a worker has ended
   */
  constructor(files, version, ended) {
    this.files = files;
    this.version = version;
    this.ended = ended;
    /** @type {?Record<string, ArrayBuffer>} */
    this.fetched = null;
    /** @type {?Worker} */
    this.worker = null;
    /** @type {Map<number, Waiting>} */
    this.waiting = new Map();
    this.asked = 0;
    this.timer = 0;
    /** @type {?AbortController} */
    this.fetching = null;
  }

  get megabytes() {
    return mb(this.files.reduce((sum, {size}) => sum + size, 0));
  }

  /** Fetches the files if this has not been done, and starts a worker. @param {Say} say */
  async start(say) {
    if (this.worker) return;
    this.fetched ??= await this.fetch(say);
    say("Starting Python, which takes 5 to 20 seconds, on a phone longer …");
    this.worker = new Worker(new URL("./worker.js", import.meta.url), {type: "module"});
    this.worker.onmessage = ({data}) => this.hear(data);
    this.worker.onerror = event => {
      event.preventDefault();
      this.end("failed", `Python could not start: ${event.message || "no worker"}. ${AGAIN}`);
    };
    this.worker.postMessage({start: this.fetched});
  }

  /**
   * @param {Say} say
   * @returns {Promise<Record<string, ArrayBuffer>>}
   */
  async fetch(say) {
    if (typeof DecompressionStream === "undefined")
      throw new Ended("failed", "Python needs a browser from 2023 or later.");
    const {signal} = (this.fetching = new AbortController());
    let there = 0;
    const grown = (/** @type {number} */ bytes) => {
      there += bytes;
      say(`Fetching Python, once: ${mb(there)} of ${this.megabytes} MB`);
    };
    grown(0);
    try {
      const all = this.files.map(async ({name}) => {
        const address = new URL(`../python/${name}?v=${this.version}`, import.meta.url);
        return [name.replace(/\.gz$/, ""), await whole(await fetch(address, {signal}), grown)];
      });
      return Object.fromEntries(await Promise.all(all));
    } catch (error) {
      if (signal.aborted) throw signal.reason;
      this.fetching.abort();
      const why = error instanceof Error ? error.message : error;
      throw new Ended("failed", `Python could not be fetched (${why}). Try again with Run.`);
    } finally {
      this.fetching = null;
    }
  }

  /**
   * Calls a function in the worker.
   * @param {"needs" | "run" | "ask"} call
   * @param {...unknown} given
   * @returns {Promise<unknown>}
   */
  call(call, ...given) {
    return new Promise((resolve, reject) => {
      if (!this.worker) return reject(new Ended("stopped", ""));
      this.waiting.set(++this.asked, {resolve, reject});
      this.worker.postMessage({n: this.asked, call, given});
    });
  }

  /** @param {Said} said */
  hear(said) {
    if ("full" in said)
      this.end("memory", `Your code needs more than 500 MB of memory: Python was ended. ${AGAIN}`);
    else if ("check" in said) {
      clearTimeout(this.timer);
      if (!said.check) return;
      const {limit, sentence} = said.check;
      this.timer = setTimeout(() => this.end("check", sentence), 1000 * limit);
    } else if (said.error !== undefined)
      this.end("failed", `Python failed (${lastLine(said.error)}) and was ended. ${AGAIN}`);
    else {
      this.waiting.get(said.n)?.resolve(JSON.parse(said.value ?? "null"));
      this.waiting.delete(said.n);
    }
  }

  /**
   * Ends the worker, if there is one. Whoever waits for a result gets the reason.
   * @param {Ended["how"]} how
   * @param {string} sentence
   */
  end(how, sentence = `Stopped: Python was ended. ${AGAIN}`) {
    const why = new Ended(how, sentence);
    this.fetching?.abort(why);
    clearTimeout(this.timer);
    this.worker?.terminate();
    this.worker = null;
    for (const {reject} of this.waiting.values()) reject(why);
    this.waiting.clear();
    this.ended();
  }
}

/** @param {number} bytes */
export const mb = bytes => (bytes / 1e6).toFixed(1);

/** @param {string} error */
const lastLine = error => error.trim().split("\n").at(-1)?.slice(0, 200) ?? "";

/**
 * Reads a response, and reports each piece as it arrives.
 * @param {Response} response
 * @param {(bytes: number) => void} grown
 */
async function whole(response, grown) {
  if (!response.ok || !response.body) throw new Error(`${response.status} ${response.url}`);
  const reader = response.body.getReader(),
    parts = [];
  for (let {done, value} = await reader.read(); !done; {done, value} = await reader.read()) {
    if (!value) continue;
    parts.push(value);
    grown(value.length);
  }
  return new Blob(parts).arrayBuffer();
}
