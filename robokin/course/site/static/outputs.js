// Shows the outputs of a cell that ran in the page, as the site shows stored ones.

/**
 * An output in the form of a notebook file.
 * @typedef {{output_type: "stream", name: "stdout" | "stderr", text: string}} Stream
 * @typedef {{output_type: "error", ename: string, evalue: string, traceback: string[]}} Failure
 * @typedef {{output_type: "display_data" | "execute_result", data: Record<string, string>}} Shown
 */
/** @typedef {Stream | Failure | Shown} Output */

export const FIGURE = "application/x-robokin-figure";
const NOT_YOURS =
  "The lab's picture: your numbers are not in it. To draw yours, download your notebook.";

/**
 * Returns an element with these outputs. `stored` has the stored outputs of the cell, whose
 * pictures stand for those that cannot be drawn here.
 * @param {Output[]} outputs
 * @param {?Element} stored
 */
export function shown(outputs, stored) {
  const made = block("cell_output docutils container rk-mine");
  const pictures = [...(stored?.querySelectorAll(".robokin-figure, .output > img") ?? [])];
  for (const output of outputs) {
    if (output.output_type === "stream") made.append(text(output.text, output.name));
    else if (output.output_type === "error") {
      made.append(text(output.traceback.join("\n"), "error"));
      made.classList.add("rk-failed");
    } else made.append(...data(output.data, pictures));
  }
  return made;
}

const VIEW = /^<div class="robokin-player" data-player="([0-9a-f]{12})">/;

/**
 * Whether these outputs are the views that an element shows, and nothing else. The id of a view is
 * a hash of its data.
 * @param {Output[]} outputs
 * @param {Element} place
 */
export function sameViews(outputs, place) {
  const ids = outputs.map(each => "data" in each && VIEW.exec(each.data["text/html"] ?? "")?.[1]),
    there = [...place.querySelectorAll("[data-player]")].map(each =>
      each.getAttribute("data-player"),
    );
  return ids.length > 0 && ids.every(Boolean) && String(ids) === String(there);
}

/** The line of its cell in which Python stopped with an error, or 0. @param {Output[]} outputs */
export function errorLine(outputs) {
  const [trace] = outputs.flatMap(each => ("traceback" in each ? [each.traceback] : []));
  return Number(trace?.flatMap(line => /^cell, line (\d+)$/.exec(line)?.[1] ?? []).at(-1) ?? 0);
}

/** Makes the scripts of an element run, which has to be in the page. @param {Element} place */
export function runScripts(place) {
  for (const script of place.querySelectorAll("script")) {
    const copy = document.createElement("script");
    for (const {name, value} of script.attributes) copy.setAttribute(name, value);
    copy.textContent = script.textContent;
    script.replaceWith(copy);
  }
}

/**
 * @param {Record<string, string>} bundle
 * @param {Element[]} pictures  those that have not been used yet
 */
function data(bundle, pictures) {
  if (FIGURE in bundle) {
    const line = document.createElement("p");
    line.className = "rk-not-yours";
    line.textContent = pictures.length ? NOT_YOURS : bundle["text/plain"];
    const picture = pictures.shift()?.cloneNode(true);
    return picture ? [line, picture] : [line];
  }
  const made = block("output text_html");
  const [kind] = ["text/html", "image/svg+xml"].filter(each => each in bundle);
  if (kind) made.innerHTML = bundle[kind];
  else if ("image/png" in bundle) {
    const image = document.createElement("img");
    image.src = `data:image/png;base64,${bundle["image/png"]}`;
    image.alt = bundle["text/plain"] ?? "";
    made.append(image);
  } else return [text(bundle["text/plain"] ?? bundle["text/latex"] ?? "", "plain")];
  return [made];
}

/** @type {(words: string, kind: string) => HTMLElement} */
function text(words, kind) {
  const outer = block(`output ${kind === "plain" ? "text_plain" : `rk-text ${kind}`}`),
    inner = block("highlight"),
    pre = document.createElement("pre");
  pre.textContent = words.replace(/\n$/, "");
  inner.append(pre);
  outer.append(inner);
  return outer;
}

/** @param {string} name */
function block(name) {
  const made = document.createElement("div");
  made.className = name;
  return made;
}
