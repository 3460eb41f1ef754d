// SPDX-License-Identifier: MIT
// What a live run has been through, in bounded memory: once that is full, the older half of the ticks that
// are kept is thinned to the multiples of 2, then of 4, ... so that what is long ago is kept coarser.
// Multiples, so that a coarse stride still finds its frames.
export interface Kept {
  tick: number;
  bytes: number;
}

export class History<T extends Kept> {
  private entries: T[] = []; // by tick
  private bytes = 0;

  constructor(private readonly mostBytes: number) {}

  get length(): number {
    return this.entries.length;
  }
  get bytesKept(): number {
    return this.bytes;
  }
  last(): T | undefined {
    return this.entries.at(-1);
  }

  /** `entry` must be later than all others. */
  push(entry: T): void {
    this.entries.push(entry);
    this.bytes += entry.bytes;
    while (this.bytes > this.mostBytes && this.thin());
  }

  /** Forgets what is later than `tick`. */
  cut(tick: number): void {
    this.keep(this.entries.slice(0, this.firstAfter(tick)));
  }

  /** The entries from `from` to `to` (ticks) that are multiples of `stride`, and the nearest on either side. */
  around(from: number, to: number, stride: number): T[] {
    let low = this.firstAfter(from - 1) - 1;
    while (low >= 0 && this.entries[low].tick % stride !== 0) --low;
    const found: T[] = [];
    for (let i = Math.max(low, 0); i < this.entries.length; ++i) {
      const entry = this.entries[i];
      if (entry.tick % stride !== 0) continue;
      found.push(entry);
      if (entry.tick > to) break;
    }
    return found;
  }

  /** The last one that is not later than `tick`. */
  at(tick: number): T | undefined {
    return this.entries[this.firstAfter(tick) - 1];
  }

  private firstAfter(tick: number): number {
    let low = 0;
    for (let high = this.entries.length; low < high; ) {
      const middle = (low + high) >> 1;
      if (this.entries[middle].tick <= tick) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** False: nothing is left that could go. */
  private thin(): boolean {
    const half = this.entries.length >> 1;
    if (half < 2) return false;
    for (let power = 2; power < 2 ** 40; power *= 2) {
      const kept = this.entries.filter((entry, i) => i >= half || entry.tick % power === 0);
      if (kept.length === this.entries.length) continue;
      this.keep(kept);
      return true;
    }
    return false;
  }

  private keep(entries: T[]): void {
    this.entries = entries;
    this.bytes = entries.reduce((sum, entry) => sum + entry.bytes, 0);
  }
}
