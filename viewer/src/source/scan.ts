// SPDX-License-Identifier: MIT
// Walks through an MCAP file that has no sound index: a run that was killed, a copy that was cut off.
// A chunk's times and channels are taken from the message indices behind it, where they agree with its
// header, so that its megabyte need not be decompressed now; if they do not, its messages are asked.
import type { Bytes } from './bytes';
import { chunkRecords } from './chunks';
import type { Mcap, Stretch } from './contents';
import type { Warnings } from './problem';
import { Fields, magic, op, readChannel, readChunk, readMessageIndex, readMetadata, recordHeaderBytes, walk } from './records';
import type { Decompress } from './zstd';

const windowBytes = 1 << 18; // records are many and small; a file is read in larger pieces
const mostLooseBytes = 1 << 20; // messages outside of chunks are taken together up to here
const mostRecordBytes = 1 << 26; // of those that are read whole here
const headBytes = 64; // of a record: enough to know it again
const chunkHeadBytes = 64; // enough for a chunk record's fields before its data

/** A chunk whose message indices are still being read. */
interface Pending {
  stretch: Stretch;
  headerStart: number; // ns, as its header says
  headerEnd: number;
  start: number; // ns, as its message indices say
  end: number;
}

export class Scanner {
  readonly mcap: Mcap = { indexed: false, channels: new Map(), metadata: new Map(), stretches: [] };
  /** The end of the messages has been read: whoever wrote the file has finished it. */
  finished = false;
  private readonly window: Window;
  private pending: Pending | null = null;
  private offset = magic.length; // everything before has been read
  private last = { offset: 0, head: new Uint8Array(0) }; // record, by which the file is known again

  constructor(private readonly bytes: Bytes, private readonly decompress: Decompress,
              private readonly warnings: Warnings) {
    this.window = new Window(bytes);
  }

  /** To the end of what is there now. */
  async goOn(): Promise<void> {
    this.window.forget();
    while (this.offset < this.bytes.size && !this.finished) {
      const next = await this.step(this.offset);
      if (next === null) break;
      this.offset = next;
    }
    await this.settle(true); // message indices behind it may be missing
  }

  /** Whether it still is the file whose beginning was read: a run that begins anew writes from the start. */
  async isSame(): Promise<boolean> {
    const { offset, head } = this.last;
    if (this.bytes.size < this.offset) return false;
    const now = await this.bytes.read(offset, head.length);
    return head.every((byte, k) => byte === now[k]);
  }

  /** Where the next record is; null at the end. */
  private async step(offset: number): Promise<number | null> {
    const left = this.bytes.size - offset;
    if (left < recordHeaderBytes) return left === magic.length ? null : this.stop(offset, 'the file ends in the middle of a record');
    const header = new Fields(await this.window.read(offset, recordHeaderBytes));
    const kind = header.u8();
    const length = header.u64();
    if (kind === 0) return this.stop(offset, 'what follows is not MCAP');
    if (length > left - recordHeaderBytes) return this.stop(offset, 'the file ends in the middle of a record');
    await this.record(kind, offset, length);
    this.last = { offset, head: (await this.window.read(offset, Math.min(recordHeaderBytes + length, headBytes))).slice() };
    this.finished = kind === op.dataEnd;
    return offset + recordHeaderBytes + length;
  }

  private stop(offset: number, text: string): null {
    if (this.bytes.growing) return null; // the rest is on its way
    this.warnings.add(`${text} (at byte ${offset})`);
    return null;
  }

  private async record(kind: number, offset: number, length: number): Promise<void> {
    if (kind !== op.messageIndex) await this.settle();
    if (kind === op.chunk) return await this.chunk(offset, length);
    const known = kind === op.messageIndex || kind === op.channel || kind === op.metadata || kind === op.message;
    if (!known || length > mostRecordBytes) return;
    const content = await this.window.read(offset + recordHeaderBytes, length);
    if (!this.take(kind, content, offset)) this.warnings.add(`a damaged record was skipped (at byte ${offset})`);
  }

  private take(kind: number, content: Uint8Array, offset: number): boolean {
    if (kind === op.message) return this.loose(content, offset);
    if (kind === op.messageIndex) return this.index(content);
    if (kind === op.channel) {
      const channel = readChannel(content);
      if (channel !== null) this.mcap.channels.set(channel.id, channel);
      return channel !== null;
    }
    const metadata = readMetadata(content);
    if (metadata !== null) this.mcap.metadata.set(metadata.name, metadata.entries);
    return metadata !== null;
  }

  private loose(content: Uint8Array, offset: number): boolean {
    const f = new Fields(content);
    const channel = f.u16();
    f.u32();
    const time = f.u64();
    if (!f.ok) return false;
    let last = this.mcap.stretches.at(-1);
    const continues = last !== undefined && !last.chunk && last.offset + last.length === offset && last.length < mostLooseBytes;
    if (last === undefined || !continues) {
      last = { offset, length: 0, chunk: false, start: time, end: time, channels: new Set() };
      this.mcap.stretches.push(last);
    }
    last.start = Math.min(last.start, time);
    last.end = Math.max(last.end, time);
    last.length += recordHeaderBytes + content.length;
    last.channels.add(channel);
    return true;
  }

  private async chunk(offset: number, length: number): Promise<void> {
    const head = readChunk(await this.window.read(offset + recordHeaderBytes, Math.min(length, chunkHeadBytes)));
    const stretch: Stretch = {
      offset, length: recordHeaderBytes + length, chunk: true, start: Infinity, end: -Infinity, channels: new Set(),
    };
    if (head === null) {
      this.warnings.add(`a damaged chunk was skipped (at byte ${offset})`);
      return;
    }
    this.pending = { stretch, headerStart: head.start, headerEnd: head.end, start: Infinity, end: -Infinity };
  }

  private index(content: Uint8Array): boolean {
    const index = readMessageIndex(content);
    const pending = this.pending;
    if (index === null || pending === null) return index !== null;
    pending.stretch.channels.add(index.channel);
    pending.start = Math.min(pending.start, index.start);
    pending.end = Math.max(pending.end, index.end);
    return true;
  }

  /** All message indices of the last chunk are read. */
  private async settle(cutOff = false): Promise<void> {
    const p = this.pending;
    this.pending = null;
    if (p === null) return;
    const { stretch } = p;
    stretch.start = p.start;
    stretch.end = p.end;
    const agree = p.start === p.headerStart && p.end === p.headerEnd;
    const known = [...stretch.channels].every((id) => this.mcap.channels.has(id));
    if ((agree && known && !cutOff) || (await this.ask(stretch))) this.mcap.stretches.push(stretch);
  }

  /** From the messages themselves; false: nothing is in it that can be read. */
  private async ask(stretch: Stretch): Promise<boolean> {
    const records = await chunkRecords(this.bytes, stretch, this.decompress, this.warnings);
    if (records === null) return false;
    const contents = walk(records);
    for (const channel of contents.channels) this.mcap.channels.set(channel.id, channel);
    stretch.channels = new Set(contents.messages.keys());
    const places = [...contents.messages.values()];
    stretch.start = Math.min(...places.map((p) => p[0].time));
    stretch.end = Math.max(...places.map((p) => p[p.length - 1].time));
    return places.length > 0;
  }
}

/** Reads ahead: most records follow each other closely. */
class Window {
  private start = 0;
  private data: Uint8Array = new Uint8Array(0);
  constructor(private readonly bytes: Bytes) {}

  forget(): void {
    this.data = new Uint8Array(0);
  }

  async read(offset: number, length: number): Promise<Uint8Array> {
    if (offset < this.start || offset + length > this.start + this.data.length) {
      this.data = await this.bytes.read(offset, Math.min(Math.max(length, windowBytes), this.bytes.size - offset));
      this.start = offset;
    }
    return this.data.subarray(offset - this.start, offset - this.start + length);
  }
}
