// The files of the page's Python are compressed, since a plain host compresses nothing.

/**
 * Returns the content of a file. A host that sends a .gz file as compressed content has the browser
 * decompress it, so it may arrive decompressed.
 * @param {ArrayBuffer} packed
 * @param {string} [type]
 */
export function gunzip(packed, type = "application/octet-stream") {
  const [first, second] = new Uint8Array(packed, 0, 2),
    whole = new Blob([packed]).stream();
  const stream =
    first === 0x1f && second === 0x8b ? whole.pipeThrough(new DecompressionStream("gzip")) : whole;
  return new Response(stream, {headers: {"content-type": type}});
}
