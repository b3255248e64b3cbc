// Runs page_side.py in the page's Python: one question a line on stdin, one answer a line on stdout.
// The arguments are the folder with the page's files (of robokin/course/site/files.py, decompressed),
// page_side.py, and worker.js, whose library for NumPy is used.

import {readFileSync} from "node:fs";
import {createInterface} from "node:readline";
import {pathToFileURL} from "node:url";

const [folder, side, worker] = process.argv.slice(2);
const [library] = readFileSync(worker, "utf8").match(/^function backtrace\(\) \{.*?^\}/ms) ?? [];

const {loadPyodide} = await import(pathToFileURL(`${folder}/pyodide.mjs`).href);
const say = text => process.stderr.write(`${text}\n`);
const py = await loadPyodide({indexURL: `${folder}/`, stdout: say, stderr: say});
py.FS.writeFile("/lib/libbacktrace.so", new Function(`${library}; return backtrace();`)());
const how = {global: true, nodelete: true, loadAsync: true, fs: py.FS};
await py._module.loadDynamicLibrary("/lib/libbacktrace.so", how);

const packages = "/lib/python3.11/site-packages";
const unpack = name => {
  const archive = new Uint8Array(readFileSync(`${folder}/${name}.zip`)); // not a Buffer of Node
  py.unpackArchive(archive, "zip", {extractDir: packages});
};
unpack("numpy");
unpack("robokin");
py.FS.writeFile(`${packages}/page_side.py`, readFileSync(side, "utf8"));
const answer = py.runPython("import page_side; page_side.answer");
let sympy = false;
for await (const line of createInterface({input: process.stdin})) {
  if (!sympy && line.includes("sympy")) {
    unpack("sympy"); // as a page does, only for a lab that uses it
    sympy = true;
  }
  process.stdout.write(`${answer(line)}\n`);
}
