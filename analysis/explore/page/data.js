// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the data of the page: JSON, and for each run its arrays as one zlib stream in base64 (binary_arrays.hpp).

const types = {
  u8: Uint8Array,
  u16: Uint16Array,
  u32: Uint32Array,
  f32: Float32Array,
  f64: Float64Array,
};

export function readContent() {
  return JSON.parse(document.getElementById("content").textContent);
}

function fromBase64(text) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = characters.charCodeAt(k);
  return bytes;
}

async function inflated(bytes) {
  if (typeof DecompressionStream === "undefined")
    throw new Error("This browser cannot unpack the data of the page; use a browser of 2023 or later.");
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Decodes an array: it is stored as the lowest bytes of all numbers, then the second bytes, and so on. */
function joined(bytes, {type, offset, length}) {
  const values = new types[type](length);
  const size = values.BYTES_PER_ELEMENT;
  const own = new Uint8Array(values.buffer);
  for (let b = 0; b < size; ++b)
    for (let k = 0, from = offset + b * length; k < length; ++k) own[k * size + b] = bytes[from + k];
  return values;
}

/** Arrays of run `k`, {name: typed array}; `directory` has type, offset and length of each. */
export async function readArrays(k, directory) {
  const element = document.getElementById(`arrays-${k}`);
  const bytes = await inflated(fromBase64(element.textContent));
  element.remove();
  const arrays = {};
  for (const [name, entry] of Object.entries(directory)) arrays[name] = joined(bytes, entry);
  return arrays;
}
