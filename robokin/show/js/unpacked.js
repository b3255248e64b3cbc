// Unpacks the compact numbers of a page (page.py: Packed).

/** @import {Packed} from "./page.js" */

/**
 * The numbers of a Packed, ordered by motion, column and sample; NaN for no value.
 * @param {Packed} packed
 * @param {number} motions
 * @param {number} samples
 * @param {number} nothing  the integer that means "no value"
 */
export function unpacked({steps, data}, motions, samples, nothing) {
  const bytes = Uint8Array.from(atob(data), c => c.charCodeAt(0)),
    values = new Float64Array(bytes.filter(byte => byte < 128).length), // each number's last byte
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
