// SPDX-License-Identifier: MIT
// Stretches of a file that is a Blob, or that a server hands out by range.
import { Problem } from './problem';

export interface Bytes {
  /** bytes */
  readonly size: number;
  /** Bytes that were really read so far. */
  readonly taken: number;
  /** Somebody still writes it, as far as is known. */
  readonly growing: boolean;
  /** How large it is now, and whether it will grow. Throws a Problem. */
  look(): Promise<void>;
  /** Exactly `length` bytes. Throws a Problem if they cannot be had. */
  read(offset: number, length: number): Promise<Uint8Array>;
}

function checkInside(offset: number, length: number, size: number): void {
  const inside = offset >= 0 && length >= 0 && offset <= size && length <= size - offset;
  if (!inside) throw new Problem('the file ends too early');
}

export class BlobBytes implements Bytes {
  taken = 0;
  readonly growing = false; // a file in the page's hands is as it was when it was chosen
  constructor(private readonly blob: Blob) {}

  get size(): number {
    return this.blob.size;
  }
  async look(): Promise<void> {}

  async read(offset: number, length: number): Promise<Uint8Array> {
    checkInside(offset, length, this.size);
    if (length === 0) return new Uint8Array(0);
    const buffer = await this.buffer(offset, length);
    if (buffer.byteLength !== length) throw new Problem('the file ends too early');
    this.taken += length;
    return new Uint8Array(buffer);
  }

  private async buffer(offset: number, length: number): Promise<ArrayBuffer> {
    try {
      return await this.blob.slice(offset, offset + length).arrayBuffer();
    } catch {
      // The browsers' own messages ("A requested file or directory could not be found ...") do not help.
      throw new Problem('cannot be read; is it a directory, or was it changed, moved or deleted?');
    }
  }
}

/** A file at a URL, by range requests. Small reads are answered from blocks, as each request costs a
 *  round trip. A server that knows no ranges sends the whole file, which is then kept. */
export class UrlBytes implements Bytes {
  static readonly block = 1 << 16; // bytes
  static readonly mostBlocks = 16;
  taken = 0;
  size = 0; // known once open
  growing = false; // `banyan view` says so with every answer; no other server does
  private whole: BlobBytes | null = null;
  private readonly blocks = new Map<number, Uint8Array>();

  private constructor(private readonly url: string, private readonly get: typeof fetch) {}

  /** `size` in bytes, if the page knows it; else the server is asked. */
  static async open(url: string, size = 0, get: typeof fetch = (at, init) => fetch(at, init)): Promise<UrlBytes> {
    const bytes = new UrlBytes(url, get);
    if (size > 0) bytes.size = size;
    else await bytes.askSize();
    return bytes;
  }

  async look(): Promise<void> {
    if (this.whole !== null) return;
    const before = this.size;
    await this.askSize();
    if (this.size !== before) this.blocks.clear(); // the last one was cut off, or it is another file
  }

  async read(offset: number, length: number): Promise<Uint8Array> {
    checkInside(offset, length, this.size);
    if (length === 0) return new Uint8Array(0);
    if (this.whole === null && length < UrlBytes.block) return await this.readSmall(offset, length);
    return await this.fetchRange(offset, length);
  }

  private async readSmall(offset: number, length: number): Promise<Uint8Array> {
    const out = new Uint8Array(length);
    for (let at = 0; at < length; ) {
      const index = Math.floor((offset + at) / UrlBytes.block);
      const block = await this.blockAt(index);
      const from = offset + at - index * UrlBytes.block;
      const piece = block.subarray(from, from + length - at);
      out.set(piece, at);
      at += piece.length;
    }
    return out;
  }

  private async blockAt(index: number): Promise<Uint8Array> {
    let block = this.blocks.get(index);
    if (block === undefined) {
      const start = index * UrlBytes.block;
      block = await this.fetchRange(start, Math.min(UrlBytes.block, this.size - start));
    }
    this.blocks.delete(index); // the last used one goes to the end
    this.blocks.set(index, block);
    for (const oldest of this.blocks.keys()) {
      if (this.blocks.size <= UrlBytes.mostBlocks) break;
      this.blocks.delete(oldest);
    }
    return block;
  }

  private async fetchRange(offset: number, length: number): Promise<Uint8Array> {
    if (this.whole === null) {
      const response = await this.request(`bytes=${offset}-${offset + length - 1}`);
      if (response.status === 206) {
        const bytes = new Uint8Array(await this.body(response));
        if (bytes.length !== length) throw new Problem('the server sent another length than it was asked for');
        this.taken += length;
        return bytes;
      }
      await this.keepWhole(response);
    }
    return await this.whole!.read(offset, length);
  }

  private async askSize(): Promise<void> {
    const response = await this.request('bytes=0-0');
    const total = /\/(\d+)$/.exec(response.headers.get('Content-Range') ?? '');
    if (response.status === 206 && total !== null) this.size = Number(total[1]);
    else if (response.status === 206) throw new Problem('the server does not say how large the file is');
    else if (response.status === 416) this.size = 0; // nothing there, an empty file
    else await this.keepWhole(response);
  }

  private async keepWhole(response: Response): Promise<void> {
    const buffer = await this.body(response);
    this.taken += buffer.byteLength;
    this.whole = new BlobBytes(new Blob([buffer]));
    this.size = buffer.byteLength;
  }

  private async request(range: string): Promise<Response> {
    let response: Response;
    try {
      response = await this.get(this.url, { headers: { Range: range } });
    } catch {
      throw new Problem('cannot be loaded: the server does not answer');
    }
    if (!response.ok && response.status !== 416) {
      throw new Problem(`cannot be loaded: the server answers ${response.status} ${response.statusText}`.trimEnd());
    }
    this.growing = response.headers.has('Banyan-Growing');
    return response;
  }

  private async body(response: Response): Promise<ArrayBuffer> {
    try {
      return await response.arrayBuffer();
    } catch {
      throw new Problem('cannot be loaded: the connection was lost');
    }
  }
}
