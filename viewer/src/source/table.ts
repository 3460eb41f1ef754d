// SPDX-License-Identifier: MIT
// The series on the page's side: a live run's grows by a few rows many times a second.
import type { Series } from '../frame';

export class SeriesTable {
  private rows = 0;
  private room = 0;
  private columns = new Map<string, Float64Array>();

  /** Views of all rows; valid until the next change. */
  get value(): Series {
    return Object.fromEntries([...this.columns].map(([name, values]) => [name, values.subarray(0, this.rows)]));
  }

  replace(series: Series): void {
    this.columns = new Map(Object.entries(series));
    this.rows = this.room = lengthOf(series);
  }

  append(series: Series): void {
    const more = lengthOf(series);
    if (this.columns.size === 0) return this.replace(series);
    if (this.rows + more > this.room) this.grow(2 * (this.rows + more));
    for (const [name, values] of this.columns) {
      if (series[name] !== undefined) values.set(series[name], this.rows);
      else values.fill(NaN, this.rows, this.rows + more);
    }
    this.rows += more;
  }

  private grow(room: number): void {
    this.room = room;
    for (const [name, values] of this.columns) {
      const larger = new Float64Array(room);
      larger.set(values.subarray(0, this.rows));
      this.columns.set(name, larger);
    }
  }
}

function lengthOf(series: Series): number {
  const lengths = Object.values(series).map((values) => values.length);
  return lengths.length === 0 ? 0 : Math.min(...lengths);
}
