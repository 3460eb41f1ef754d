// SPDX-License-Identifier: MIT
// Decompression with Facebook's own code, the WebAssembly of @foxglove/wasm-zstd. Its JavaScript wants
// Buffer and require(), which a worker in a browser has not, so this is what it does, in few lines. The
// letters are the names in that file (package.json pins its version; the probe below notices if not).

/** Decompressed bytes, a copy of their own; null if `packed` is damaged or is not exactly `size` long. */
export type Decompress = (packed: Uint8Array, size: number) => Uint8Array | null;

/** Larger than any chunk that a writer makes; what claims to be larger is damaged. */
export const largestChunk = 1 << 28; // bytes

interface Exports {
  c: WebAssembly.Memory;
  d: () => void; // constructors
  f: (bytes: number) => number; // malloc
  g: (pointer: number) => void; // free
  j: (to: number, toBytes: number, from: number, fromBytes: number) => number; // decompress; -1: damaged
}

const page = 1 << 16;
const mostMemory = 1 << 30;

// "banyan" as a zstd frame.
const probe = Uint8Array.of(0x28, 0xb5, 0x2f, 0xfd, 0x20, 6, 0x31, 0, 0, 0x62, 0x61, 0x6e, 0x79, 0x61, 0x6e);

/** From the bytes of wasm-zstd.wasm. */
export async function loadZstd(wasm: BufferSource): Promise<Decompress> {
  const { instance } = await WebAssembly.instantiate(wasm, { a: { a: grow, b: copy } });
  const zstd = instance.exports as unknown as Exports;
  function grow(wanted: number): boolean {
    const bytes = wanted >>> 0;
    if (bytes > mostMemory) return false;
    try {
      zstd.c.grow(Math.ceil((bytes - zstd.c.buffer.byteLength) / page));
      return true;
    } catch {
      return false;
    }
  }
  function copy(to: number, from: number, bytes: number): void {
    new Uint8Array(zstd.c.buffer).copyWithin(to, from, from + bytes);
  }
  zstd.d();
  const decompress: Decompress = (packed, size) => decompressWith(zstd, packed, size);
  if (new TextDecoder().decode(decompress(probe, 6) ?? new Uint8Array()) !== 'banyan') {
    throw new Error('the zstd module is another one than this page was written for');
  }
  return decompress;
}

function decompressWith(zstd: Exports, packed: Uint8Array, size: number): Uint8Array | null {
  // A block of at most 128 KiB takes four bytes at least, so a forged size is seen before memory is taken.
  if (!(size >= 0 && size <= largestChunk && size <= 32768 * packed.length)) return null;
  const from = zstd.f(packed.length);
  const to = zstd.f(Math.max(size, 1));
  try {
    if (from === 0 || to === 0) throw new RangeError('not enough memory');
    new Uint8Array(zstd.c.buffer).set(packed, from);
    const got = zstd.j(to, size, from, packed.length);
    return got === size ? new Uint8Array(zstd.c.buffer).slice(to, to + size) : null;
  } finally {
    zstd.g(from);
    zstd.g(to);
  }
}
