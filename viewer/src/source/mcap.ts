// SPDX-License-Identifier: MIT
// Which stretches of a file hold messages, of which channels and of what time: from its index if that is
// sound, else by walking through the file (scan.ts).
import { McapIndexedReader } from '@mcap/core';
import type { Bytes } from './bytes';
import type { Mcap, Stretch } from './contents';
import { Problem, Warnings } from './problem';
import { magic, startsWithMagic } from './records';
import { Scanner } from './scan';
import type { Decompress } from './zstd';

export interface OpenMcap {
  mcap: Mcap;
  /** Of a file that is being written, which has no index yet: goes on where the file ended. */
  scanner: Scanner | null;
}

/** How often a file that is being written is looked at. */
export const lookEveryMs = 400;
export const until = (ms: number) => new Promise<void>((resolve) => { setTimeout(resolve, ms); });

/** Throws a Problem for what is no MCAP file; damage that can be read around is a warning. */
export async function openMcap(bytes: Bytes, decompress: Decompress, warnings: Warnings): Promise<OpenMcap> {
  while (bytes.growing && bytes.size < magic.length) {
    await until(lookEveryMs);
    await bytes.look();
  }
  if (bytes.size === 0) throw new Problem('is empty');
  const start = await bytes.read(0, Math.min(magic.length, bytes.size));
  if (!startsWithMagic(start)) throw new Problem('is not an MCAP file');
  const indexed = bytes.growing ? null : await readIndex(bytes, warnings);
  if (indexed !== null) return { mcap: indexed, scanner: null };
  const scanner = new Scanner(bytes, decompress, warnings);
  await scanner.goOn();
  return { mcap: scanner.mcap, scanner: bytes.growing ? scanner : null };
}

async function readIndex(bytes: Bytes, warnings: Warnings): Promise<Mcap | null> {
  try {
    if (!(await hasEnd(bytes))) throw new Error('the file was cut short: it has no end');
    const reader = await McapIndexedReader.Initialize({ readable: readableOf(bytes) });
    const messages = reader.statistics?.messageCount;
    if (messages === undefined || (messages > 0n && reader.chunkIndexes.length === 0)) throw new Error('it has no index');
    return await fromReader(reader, bytes.size);
  } catch (error) {
    if (error instanceof Problem && !/ends too early/.test(error.message)) throw error; // the file cannot be read at all
    warnings.add(`${whatIsWrong(error)}; read by scanning what is there`);
    return null;
  }
}

async function hasEnd(bytes: Bytes): Promise<boolean> {
  if (bytes.size < 2 * magic.length) return false;
  return startsWithMagic(await bytes.read(bytes.size - magic.length, magic.length));
}

// The library speaks of itself; a visitor wants to know about the file.
function whatIsWrong(error: unknown): string {
  const text = error instanceof Error ? error.message : '';
  if (/cut short|has no index/.test(text)) return text;
  if (/not indexed/.test(text)) return 'it has no index';
  return /CRC/.test(text) ? 'its index is damaged (checksum)' : 'its index is damaged';
}

function readableOf(bytes: Bytes) {
  return {
    size: async () => BigInt(bytes.size),
    read: async (offset: bigint, length: bigint) => await bytes.read(Number(offset), Number(length)),
  };
}

async function fromReader(reader: McapIndexedReader, size: number): Promise<Mcap> {
  const mcap: Mcap = { indexed: true, channels: new Map(), metadata: new Map(), stretches: [] };
  for (const { id, topic, messageEncoding } of reader.channelsById.values()) {
    mcap.channels.set(id, { id, topic, encoding: messageEncoding });
  }
  for (const chunk of reader.chunkIndexes) {
    const stretch: Stretch = {
      offset: Number(chunk.chunkStartOffset), length: Number(chunk.chunkLength), chunk: true,
      start: Number(chunk.messageStartTime), end: Number(chunk.messageEndTime),
      channels: new Set(chunk.messageIndexOffsets.keys()),
    };
    const inside = stretch.offset <= size && stretch.length <= size - stretch.offset;
    if (!inside || stretch.start > stretch.end) throw new Error('a chunk is outside of the file');
    mcap.stretches.push(stretch);
  }
  for await (const record of reader.readMetadata()) mcap.metadata.set(record.name, record.metadata);
  return mcap;
}
