// SPDX-License-Identifier: MIT
// The messages in a stretch of a file, decompressed and checked; the last used stretches are kept.
import { crc32 } from '@foxglove/crc';
import type { Bytes } from './bytes';
import type { Stretch } from './contents';
import type { Warnings } from './problem';
import { Fields, type MessagePlace, op, readChunk, walk } from './records';
import type { Decompress } from './zstd';

/** The records in a stretch; null, with a warning, if it is damaged. Throws a Problem if the file cannot be
 *  read at all (a server that went away), as that may be different next time. */
export async function chunkRecords(bytes: Bytes, stretch: Stretch, decompress: Decompress,
                                   warnings: Warnings): Promise<Uint8Array | null> {
  const record = await bytes.read(stretch.offset, stretch.length);
  if (!stretch.chunk) return record;
  const records = unpack(record, decompress);
  if (typeof records !== 'string') return records;
  warnings.add(`${records} (at byte ${stretch.offset})`, records);
  return null;
}

/** The records of a chunk record, or what is wrong with it. */
function unpack(record: Uint8Array, decompress: Decompress): Uint8Array | string {
  const f = new Fields(record);
  const kind = f.u8();
  const content = f.take(f.u64());
  const chunk = f.ok && kind === op.chunk ? readChunk(content) : null;
  if (chunk === null) return 'a damaged chunk was skipped';
  if (chunk.compression !== '' && chunk.compression !== 'zstd') {
    const name = chunk.compression.slice(0, 16);
    return `a chunk was skipped: compression '${name}' is not supported, only zstd and none`;
  }
  const records = chunk.compression === '' ? chunk.packed : decompress(chunk.packed, chunk.size);
  if (records === null) return 'a damaged chunk was skipped';
  if (chunk.crc !== 0 && crc32(records) !== chunk.crc) return 'a damaged chunk was skipped (checksum)';
  return records;
}

export interface Loaded {
  records: Uint8Array;
  /** By channel, in order of time. */
  messages: Map<number, MessagePlace[]>;
}

const decoder = new TextDecoder();

export function textAt(loaded: Loaded, place: MessagePlace): string {
  return decoder.decode(loaded.records.subarray(place.offset, place.offset + place.length));
}

export class Chunks {
  /** Decompressions so far, for tests and measurements. */
  unpacked = 0;
  private readonly kept = new Map<Stretch, Loaded>(); // the least recently used first
  private readonly damaged = new Set<Stretch>();
  private bytesKept = 0;

  constructor(private readonly bytes: Bytes, private readonly decompress: Decompress,
              private readonly warnings: Warnings, private readonly mostBytes = 64 << 20) {}

  /** Null if it is damaged. `keep` false: reading everything once does not displace chunks in use. */
  async load(stretch: Stretch, keep = true): Promise<Loaded | null> {
    const found = this.kept.get(stretch);
    if (found !== undefined) {
      this.kept.delete(stretch);
      this.kept.set(stretch, found);
      return found;
    }
    if (this.damaged.has(stretch)) return null;
    const records = await chunkRecords(this.bytes, stretch, this.decompress, this.warnings);
    if (records === null) {
      this.damaged.add(stretch);
      return null;
    }
    ++this.unpacked;
    const contents = walk(records);
    if (!contents.whole) this.warnings.add(`a chunk ends in the middle of a record (at byte ${stretch.offset})`, 'a chunk ends early');
    const loaded = { records, messages: contents.messages };
    if (keep) this.put(stretch, loaded);
    return loaded;
  }

  private put(stretch: Stretch, loaded: Loaded): void {
    this.kept.set(stretch, loaded);
    this.bytesKept += loaded.records.length;
    for (const [oldest, { records }] of this.kept) {
      if (this.bytesKept <= this.mostBytes || oldest === stretch) break;
      this.kept.delete(oldest);
      this.bytesKept -= records.length;
    }
  }
}
