// SPDX-License-Identifier: MIT
// Frames on the page's side. Time is cut into blocks of so many frames, for each stride; a block knows the
// frames on either side of it too, so it alone answers what is shown at any time in it.
import type { Frame } from '../frame';
import type { FramesReply } from './protocol';

/** What is shown at a time: `before` is at or before it, `after` later; null at the end of a recording. */
export interface Pair {
  before: Frame;
  after: Frame | null;
}

export interface Span {
  stride: number;
  index: number;
}

interface Block {
  frames: Frame[];
  /** Nothing is missing up to here. */
  untilS: number;
  bytes: number;
}

const slack = 1e-9; // s: sums of tenths
export const mostStride = 1 << 10;

export class FrameCache {
  private readonly blocks = new Map<string, Block>(); // the least recently used first
  private bytes = 0;
  private framesPerBlock = 16;

  /** `tickS` and the number of robots shape the blocks: to be known before anything is put in. */
  constructor(private readonly tickS: number, robots: number, private readonly mostBytes = 192 << 20) {
    const goal = (2 << 20) / (8 * 18 * Math.max(1, robots)); // some 2 MB in a block
    this.framesPerBlock = Math.max(4, Math.min(64, Math.round(goal)));
  }

  get bytesKept(): number {
    return this.bytes;
  }
  durationS(stride: number): number {
    return this.framesPerBlock * stride * this.tickS;
  }
  spanAt(timeS: number, stride: number): Span {
    return { stride, index: Math.max(0, Math.floor((timeS + 0.5 * this.tickS) / this.durationS(stride))) };
  }
  /** Its borders lie between ticks. */
  startOf({ stride, index }: Span): number {
    return index * this.durationS(stride) - 0.5 * this.tickS;
  }
  endOf({ stride, index }: Span): number {
    return this.startOf({ stride, index: index + 1 });
  }

  /** From when on frames are missing in a block; null: from none. */
  missingFrom(span: Span): number | null {
    const block = this.blocks.get(keyOf(span));
    if (block === undefined) return this.startOf(span);
    return block.untilS < this.endOf(span) - slack ? block.untilS : null;
  }

  put(span: Span, reply: FramesReply): void {
    const key = keyOf(span);
    const old = this.blocks.get(key);
    const frames = old === undefined ? reply.frames : merged(old.frames, reply.frames);
    const bytes = frames.reduce((sum, f) => sum + f.data.byteLength + 20 * f.targets.x.length + 200, 200);
    this.blocks.delete(key);
    this.blocks.set(key, { frames, untilS: reply.untilS, bytes });
    this.bytes += bytes - (old?.bytes ?? 0);
    this.evict(key);
  }

  /** As fine as asked for or finer; else, if `coarse` allows it, coarser. Null: not there (yet). */
  pair(timeS: number, stride: number, growing: boolean, coarse = true): Pair | null {
    for (let s = stride; s >= 1; s = Math.floor(s / 2)) {
      const found = this.pairIn(this.spanAt(timeS, s), timeS, growing);
      if (found !== null) return found;
    }
    for (let s = 2 * stride; coarse && s <= mostStride; s *= 2) {
      const found = this.pairIn(this.spanAt(timeS, s), timeS, growing);
      if (found !== null) return found;
    }
    return null;
  }

  /** Everything there is between two times, of the stride asked for or finer, without gaps at the end. */
  framesBetween(fromS: number, toS: number, stride: number): Frame[] {
    const found = new Map<number, Frame>();
    for (let s = stride; s >= 1; s = Math.floor(s / 2)) {
      const last = this.spanAt(toS, s).index;
      for (let index = this.spanAt(fromS, s).index; index <= last; ++index) {
        for (const frame of this.blocks.get(keyOf({ stride: s, index }))?.frames ?? []) {
          if (frame.timeS >= fromS - slack && frame.timeS <= toS + slack) found.set(frame.tick, frame);
        }
      }
    }
    return [...found.values()].sort((a, b) => a.tick - b.tick);
  }

  /** What is beyond `timeS` has not happened. */
  dropAfter(timeS: number): void {
    for (const [key, block] of this.blocks) {
      const reaches = block.untilS > timeS + slack || (block.frames.at(-1)?.timeS ?? 0) > timeS + slack;
      if (reaches) this.drop(key, block);
    }
  }

  private pairIn(span: Span, timeS: number, growing: boolean): Pair | null {
    const key = keyOf(span);
    const block = this.blocks.get(key);
    if (block === undefined || block.frames.length === 0) return null;
    const { frames } = block;
    const index = lastAtOrBefore(frames, timeS + slack);
    const after = frames[index + 1] ?? null;
    // With nothing after it there is more to come, or a part of the block is still missing.
    const exact = index >= 0 && Math.abs(frames[index].timeS - timeS) <= slack;
    const partial = growing || block.untilS < Math.min(timeS, this.endOf(span)) - slack;
    if (after === null && partial && !exact) return null;
    this.blocks.delete(key); // used last
    this.blocks.set(key, block);
    return index < 0 ? { before: frames[0], after: null } : { before: frames[index], after };
  }

  private evict(newest: string): void {
    for (const [key, block] of this.blocks) {
      if (this.bytes <= this.mostBytes || key === newest) break;
      this.drop(key, block);
    }
  }

  private drop(key: string, block: Block): void {
    this.blocks.delete(key);
    this.bytes -= block.bytes;
  }
}

function keyOf({ stride, index }: Span): string {
  return `${stride}:${index}`;
}

function merged(a: Frame[], b: Frame[]): Frame[] {
  const byTick = new Map([...a, ...b].map((frame) => [frame.tick, frame]));
  return [...byTick.values()].sort((x, y) => x.tick - y.tick);
}

function lastAtOrBefore(frames: Frame[], timeS: number): number {
  let low = 0;
  let high = frames.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (frames[middle].timeS <= timeS) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
