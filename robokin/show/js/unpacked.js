// Decodes the compact numbers of a page (page.py: Packed).

/** @import {Packed} from "./page.js" */

/**
 * The numbers of a Packed, ordered by motion, column and sample; NaN for no value.
 * @param {Packed} packed
 * @param {number} motions
 * @param {number} samples
 * @param {number} nothing  the integer that means "no value"
 */
export function unpacked({steps, data}, motions, samples, nothing) {
  const [bytes, count] = bytesOf(data),
    values = new Float64Array(count),
    columns = values.length / motions / samples;
  let at = 0,
    to = 0;
  for (let motion = 0; motion < motions; motion++)
    for (let column = 0; column < columns; column++) {
      const own = steps[motion],
        step = typeof own === "number" ? own : own[column];
      for (let i = 0, whole = 0, slope = 0; i < samples; i++) {
        let folded = 0,
          shift = 0,
          byte;
        do {
          byte = bytes[at++];
          folded |= (byte & 127) << shift;
          shift += 7;
        } while (byte > 127);
        slope += folded & 1 ? -(folded + 1) / 2 : folded / 2;
        whole += slope;
        values[to++] = whole === nothing ? NaN : whole * step;
      }
    }
  return values;
}

/**
 * The bytes of a text in base64, and the number of those below 128, which end a number. This loop
 * halves the time of decoding: `Uint8Array.from` and `filter` call a function for each byte.
 * @param {string} data
 * @returns {[Uint8Array, number]}
 */
function bytesOf(data) {
  const text = atob(data),
    bytes = new Uint8Array(text.length);
  let count = 0;
  for (let i = 0; i < bytes.length; i++) {
    bytes[i] = text.charCodeAt(i);
    if (bytes[i] < 128) count++;
  }
  return [bytes, count];
}
