// SPDX-License-Identifier: MIT
// The records of an MCAP file (https://mcap.dev/spec), as far as reading what is damaged needs them:
// nothing here throws, nothing trusts a length. Times are ns in doubles: exact for a hundred days, and
// within a microsecond for files of other programs that count from 1970.

export const magic = Uint8Array.of(0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a);
export const recordHeaderBytes = 9;

export const op = {
  channel: 0x04, message: 0x05, chunk: 0x06, messageIndex: 0x07, metadata: 0x0c, dataEnd: 0x0f,
} as const;

export function startsWithMagic(bytes: Uint8Array): boolean {
  return bytes.length >= magic.length && magic.every((byte, i) => bytes[i] === byte);
}

/** Reads field by field. Once something does not fit, `ok` is false and all that follows is 0 or "". */
export class Fields {
  ok = true;
  at = 0;
  private readonly view: DataView;
  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get done(): boolean {
    return !this.ok || this.at >= this.bytes.length;
  }
  u8(): number {
    const at = this.step(1);
    return at < 0 ? 0 : this.view.getUint8(at);
  }
  u16(): number {
    const at = this.step(2);
    return at < 0 ? 0 : this.view.getUint16(at, true);
  }
  u32(): number {
    const at = this.step(4);
    return at < 0 ? 0 : this.view.getUint32(at, true);
  }
  u64(): number {
    const at = this.step(8);
    return at < 0 ? 0 : this.view.getUint32(at + 4, true) * 4294967296 + this.view.getUint32(at, true);
  }
  take(length: number): Uint8Array {
    const at = this.step(length);
    return at < 0 ? new Uint8Array(0) : this.bytes.subarray(at, at + length);
  }
  text(): string {
    return new TextDecoder().decode(this.take(this.u32()));
  }

  private step(length: number): number {
    if (!this.ok || length > this.bytes.length - this.at) {
      this.ok = false;
      return -1;
    }
    const at = this.at;
    this.at += length;
    return at;
  }
}

export interface Channel {
  id: number;
  topic: string;
  encoding: string;
}

export function readChannel(content: Uint8Array): Channel | null {
  const f = new Fields(content);
  const id = f.u16();
  f.u16(); // schema
  const channel = { id, topic: f.text(), encoding: f.text() };
  return f.ok ? channel : null;
}

export interface Metadata {
  name: string;
  entries: Map<string, string>;
}

export function readMetadata(content: Uint8Array): Metadata | null {
  const f = new Fields(content);
  const metadata: Metadata = { name: f.text(), entries: new Map() };
  const pairs = new Fields(f.take(f.u32()));
  while (!pairs.done) metadata.entries.set(pairs.text(), pairs.text());
  return f.ok && pairs.ok ? metadata : null;
}

export interface Chunk {
  start: number; // ns
  end: number;
  size: number; // of the records, uncompressed
  crc: number; // 0: none
  compression: string;
  packed: Uint8Array;
}

/** `content` may be just the beginning of it; then `packed` is empty. */
export function readChunk(content: Uint8Array): Chunk | null {
  const f = new Fields(content);
  const chunk: Chunk = {
    start: f.u64(), end: f.u64(), size: f.u64(), crc: f.u32(), compression: f.text(), packed: new Uint8Array(0),
  };
  const length = f.u64();
  if (!f.ok) return null;
  chunk.packed = f.take(length);
  return chunk;
}

/** The channel, and the first and last time (ns) of its messages in the chunk before. */
export function readMessageIndex(content: Uint8Array): { channel: number; start: number; end: number } | null {
  const f = new Fields(content);
  const channel = f.u16();
  const entries = new Fields(f.take(f.u32()));
  let start = Infinity;
  let end = -Infinity;
  while (!entries.done) {
    const time = entries.u64();
    entries.u64();
    start = Math.min(start, time);
    end = Math.max(end, time);
  }
  return f.ok && entries.ok && start <= end ? { channel, start, end } : null;
}

/** A message in the bytes that were walked through. */
export interface MessagePlace {
  time: number; // ns
  offset: number;
  length: number;
}

const messageHeaderBytes = 22;

/** Where the messages are, by channel and in order of time; and what channels are declared among them. */
export interface Contents {
  messages: Map<number, MessagePlace[]>;
  channels: Channel[];
  /** False: the bytes end in the middle of a record. */
  whole: boolean;
}

export function walk(records: Uint8Array): Contents {
  const contents: Contents = { messages: new Map(), channels: [], whole: true };
  const f = new Fields(records);
  while (!f.done) {
    const kind = f.u8();
    const length = f.u64();
    const offset = f.at;
    const content = f.take(length);
    if (!f.ok) break;
    if (kind === op.message && length >= messageHeaderBytes) {
      addMessage(contents.messages, content, offset);
    } else if (kind === op.channel) {
      const channel = readChannel(content);
      if (channel !== null) contents.channels.push(channel);
    }
  }
  contents.whole = f.ok;
  for (const places of contents.messages.values()) places.sort((a, b) => a.time - b.time);
  return contents;
}

function addMessage(messages: Contents['messages'], content: Uint8Array, offset: number): void {
  const f = new Fields(content);
  const channel = f.u16();
  f.u32(); // sequence
  const place = { time: f.u64(), offset: offset + messageHeaderBytes, length: content.length - messageHeaderBytes };
  const places = messages.get(channel);
  if (places === undefined) messages.set(channel, [place]);
  else places.push(place);
}
