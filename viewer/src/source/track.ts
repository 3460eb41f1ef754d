// SPDX-License-Identifier: MIT
// The messages of one channel in order of time, forwards or backwards from any moment, loading no more
// chunks than are asked for.
import { type Chunks, type Loaded, textAt } from './chunks';
import type { Stretch } from './contents';
import type { MessagePlace } from './records';

/** As in a message's log time; the same rounding as Banyan's (record/src/frame_json.cpp). */
export function nanoseconds(timeS: number): number {
  return timeS > 0 ? Math.floor(Math.min(timeS, 9e9) * 1e9 + 0.5) : 0;
}

export class Entry {
  constructor(private readonly loaded: Loaded, private readonly place: MessagePlace) {}
  get time(): number { // ns
    return this.place.time;
  }
  text(): string {
    return textAt(this.loaded, this.place);
  }
  /** The first few characters. */
  head(): string {
    return textAt(this.loaded, { ...this.place, length: Math.min(this.place.length, 48) });
  }
}

type Skip = (stretch: Stretch) => boolean;
const nothing: Skip = () => false;

export class Track {
  readonly stretches: readonly Stretch[];
  private readonly byEnd: readonly Stretch[]; // the last first

  /** `all` in order of start. */
  constructor(private readonly chunks: Chunks, readonly channel: number, all: readonly Stretch[]) {
    this.stretches = all.filter((stretch) => this.mayHold(stretch));
    this.byEnd = [...this.stretches].sort((a, b) => b.end - a.end || b.start - a.start || b.offset - a.offset);
  }

  /** From `time` on (ns, included). Stretches that `skip` wants to are not even read. */
  async *forwards(time: number, skip = nothing): AsyncGenerator<Entry> {
    for (const stretch of this.stretches) {
      if (stretch.end < time || skip(stretch)) continue;
      for (const entry of await this.entries(stretch)) {
        if (entry.time >= time) yield entry;
      }
    }
  }

  /** From `time` (ns, included) back. */
  async *backwards(time: number, skip = nothing): AsyncGenerator<Entry> {
    for (const stretch of this.byEnd) {
      if (stretch.start > time || skip(stretch)) continue;
      const entries = await this.entries(stretch);
      for (let i = entries.length - 1; i >= 0; --i) {
        if (entries[i].time <= time) yield entries[i];
      }
    }
  }

  mayHold(stretch: Stretch): boolean {
    return stretch.channels.size === 0 || stretch.channels.has(this.channel);
  }
  entriesIn(loaded: Loaded): Entry[] {
    return (loaded.messages.get(this.channel) ?? []).map((place) => new Entry(loaded, place));
  }
  private async entries(stretch: Stretch): Promise<Entry[]> {
    const loaded = await this.chunks.load(stretch);
    return loaded === null ? [] : this.entriesIn(loaded);
  }
}
