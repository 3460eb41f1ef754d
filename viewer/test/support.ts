// SPDX-License-Identifier: MIT
// What several tests need: recordings, tables, made-up frames.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { inject } from 'vitest';
import { columns, type Frame } from '../src/frame';
import { BlobBytes } from '../src/source/bytes';
import { Recording } from '../src/source/recording';
import { type Decompress, loadZstd } from '../src/source/zstd';

export type Name = 'three' | 'sparse' | 'moving' | 'large';

const wasm = createRequire(import.meta.url).resolve('@foxglove/wasm-zstd/dist/wasm-zstd.wasm');
export const zstd: Promise<Decompress> = loadZstd(readFileSync(wasm));

export function fileOf(name: Name, file = 'run.mcap'): string {
  return path.join(inject('recordings'), name, file);
}
export function bytesOf(name: Name): Uint8Array<ArrayBuffer> {
  return new Uint8Array(readFileSync(fileOf(name)));
}
export async function open(bytes: Uint8Array<ArrayBuffer>, cacheBytes?: number): Promise<Recording> {
  return await Recording.open(new BlobBytes(new Blob([bytes])), 'run.mcap', await zstd, cacheBytes);
}

export type Row = Record<string, string>;

/** No quoted fields in these. */
export function tableOf(file: string): Row[] {
  const [header, ...lines] = readFileSync(file, 'utf8').trimEnd().split('\n').map((line) => line.split(','));
  return lines.map((cells) => Object.fromEntries(header.map((name, k) => [name, cells[k]])));
}

/** A cell as the series have it. */
export function numberOf(cell: string): number {
  if (cell === '') return NaN;
  return cell === 'true' ? 1 : cell === 'false' ? 0 : Number(cell);
}

/** One robot on a line, by default where its tick says. */
export function frameAt(tick: number, tickS = 0.1, robots = 1): Frame {
  const data = new Float64Array(columns.length * robots);
  for (let i = 0; i < robots; ++i) data[i] = 0.01 * tick + i;
  return {
    tick, timeS: Number((tick * tickS).toFixed(4)), robots, data,
    targets: { x: new Float64Array(1), y: new Float64Array(1), worker: new Int32Array(1) },
  };
}

/** Small, quick, the same everywhere (Marsaglia's xorshift). */
export function random(seed: number): () => number {
  let x = seed | 1;
  return () => {
    x ^= x << 13;
    x ^= x >>> 17;
    x ^= x << 5;
    return (x >>> 0) / 2 ** 32;
  };
}
