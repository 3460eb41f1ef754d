// SPDX-License-Identifier: MIT
// Grows the series table row by row; the columns are those of the first row.
import type { Series } from '../frame';
import { type JsonObject, Malformed, parseObject } from './json';

const mostColumns = 64;

export class SeriesBuilder {
  rows = 0;
  private room = 256;
  private columns: Map<string, Float64Array> | null = null;

  /** The JSON of one row. Throws Malformed. */
  add(text: string): void {
    this.addRow(parseObject(text));
  }

  addRow(row: JsonObject): void {
    if (typeof row.tick !== 'number' || typeof row.time_s !== 'number') throw new Malformed('has no tick and time');
    this.columns ??= this.columnsOf(row);
    if (this.rows === this.room) this.grow(this.columns);
    for (const [name, values] of this.columns) {
      const value = Object.hasOwn(row, name) ? row[name] : null;
      if (typeof value === 'number') values[this.rows] = value;
      else values[this.rows] = typeof value === 'boolean' ? Number(value) : NaN;
    }
    ++this.rows;
  }

  /** Copies of the rows from `first` on. */
  take(first = 0): Series {
    return Object.fromEntries([...(this.columns ?? [])].map(([name, values]) => [name, values.slice(first, this.rows)]));
  }

  /** Forgets the rows from `rows` on. */
  cut(rows: number): void {
    this.rows = Math.min(this.rows, rows);
  }

  private columnsOf(row: JsonObject): Map<string, Float64Array> {
    const names = Object.keys(row).filter((name) => row[name] === null || /number|boolean/.test(typeof row[name]));
    return new Map(names.slice(0, mostColumns).map((name) => [name, new Float64Array(this.room)]));
  }

  private grow(columns: Map<string, Float64Array>): void {
    this.room *= 2;
    for (const [name, values] of columns) {
      const larger = new Float64Array(this.room);
      larger.set(values);
      columns.set(name, larger);
    }
  }
}
