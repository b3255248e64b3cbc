// Python in a worker: Pyodide, NumPy and robokin, from the files that the page sends. It asks no
// address for anything. python.js is the page's side.

import {gunzip} from "./gunzip.js";

/** @typedef {{start: Record<string, ArrayBuffer>}} Start  the files by their names, without .gz */
/** @typedef {{n: number, call: string, given: unknown[]}} Call */
/**
 * What the worker says: the value of call n as JSON, or why it failed; that a check with a time
 * limit began or ended; that its memory is full.
 * @typedef {{n: number, value?: string, error?: string}} Reply
 */
/** @typedef {{check: null | {limit: number, sentence: string}}} Checking */
/** @typedef {Reply | Checking | {full: true}} Said */
/**
 * What we use of Pyodide.
 * @typedef {object} Pyodide
 * @property {{writeFile(name: string, data: Uint8Array): void}} FS
 * @property {{loadDynamicLibrary(name: string, how: object): Promise<void>}} _module
 * @property {(data: ArrayBuffer, kind: string, how: {extractDir: string}) => void} unpackArchive
 * @property {(source: string) => Called} runPython
 */
/** @typedef {(call: string, given: string) => string} Called */

const PACKAGES = "/lib/python3.11/site-packages";
const ROOM = 500e6; // bytes of memory; a page that takes more is ended by some phones
const port = /** @type {{postMessage(said: Said): void}} */ (/** @type {unknown} */ (self));

/** @type {?Promise<Called>} */
let python = null;

self.onmessage = async ({data}) => {
  if ("start" in data) {
    python = start(data.start);
    python.catch(() => {}); // the first call reports it
    return;
  }
  const {n, call, given} = /** @type {Call} */ (data);
  try {
    const called = await python;
    port.postMessage({n, value: called?.(call, JSON.stringify(given))});
  } catch (error) {
    port.postMessage({n, error: String(error)});
  }
};

/** @param {Record<string, ArrayBuffer>} files */
async function start(files) {
  limitMemory();
  const types = {wasm: "application/wasm", json: "application/json"};
  // Pyodide fetches its parts by their names
  self.fetch = async address => {
    const name = String(address).split("/").at(-1) ?? "",
      end = /** @type {keyof types} */ (name.split(".").at(-1));
    return files[name] ? gunzip(files[name], types[end]) : Response.error();
  };
  const {loadPyodide} = await module(files["pyodide.mjs"]);
  await module(files["pyodide.asm.js"]);
  /** @type {Pyodide} */
  const py = await loadPyodide({indexURL: `${location.origin}/`});
  py.FS.writeFile("/lib/libbacktrace.so", backtrace());
  await py._module.loadDynamicLibrary("/lib/libbacktrace.so", {
    global: true,
    nodelete: true,
    loadAsync: true,
    fs: py.FS,
  });
  for (const name of Object.keys(files).filter(each => /^(numpy|robokin|sympy)\.zip/.test(each))) {
    const archive = await gunzip(files[name]).arrayBuffer();
    py.unpackArchive(archive, "zip", {extractDir: PACKAGES});
  }
  Object(self).robokinCheck = (/** @type {number} */ limit, /** @type {string} */ sentence) =>
    port.postMessage({check: sentence ? {limit, sentence} : null});
  return py.runPython(PYTHON);
}

/** Imports a module from its text. @param {ArrayBuffer} packed */
async function module(packed) {
  const text = await gunzip(packed).text(),
    address = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
  return import(address);
}

/** Memory beyond ROOM is refused, and the page ends this worker. */
function limitMemory() {
  const {grow} = WebAssembly.Memory.prototype;
  /** @this {WebAssembly.Memory} @param {number} pages */
  WebAssembly.Memory.prototype.grow = function (pages) {
    if (this.buffer.byteLength + 65536 * pages > ROOM) {
      port.postMessage({full: true});
      throw new RangeError("no more memory in this page");
    }
    return grow.call(this, pages);
  };
}

/**
 * NumPy asks for the C function `backtrace` as soon as it reuses a temporary array, and Pyodide has
 * none. This WebAssembly library has one that returns no frames; NumPy then makes a new array.
 */
function backtrace() {
  const text = (/** @type {string} */ word) => [word.length, ...new TextEncoder().encode(word)];
  const section = (/** @type {number} */ id, /** @type {number[]} */ body) => [
    id,
    body.length,
    ...body,
  ];
  return new Uint8Array([
    ...[0, 0x61, 0x73, 0x6d, 1, 0, 0, 0],
    ...section(0, [...text("dylink.0"), 1, 4, 0, 0, 0, 0]),
    ...section(1, [1, 0x60, 2, 0x7f, 0x7f, 1, 0x7f]), // (i32, i32) -> i32
    ...section(3, [1, 0]),
    ...section(7, [1, ...text("backtrace"), 0, 0]),
    ...section(10, [1, 4, 0, 0x41, 0, 0x0b]), // returns 0
  ]);
}

const PYTHON = `
import json
import js
from robokin.course import page
from robokin.course.page import cells, session

def _session():
    the = session.Session()
    page.began = lambda limit, sentence: js.robokinCheck(limit, sentence)
    page.ended = lambda: js.robokinCheck(0, "")
    needs = lambda texts, i: cells.needs(texts, i, the.names())
    calls = {"needs": needs, "run": the.run, "ask": the.ask}
    return lambda call, given: json.dumps(calls[call](*json.loads(given)))

_session()
`;
