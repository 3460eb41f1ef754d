// SPDX-License-Identifier: MIT
// How far a run has been seen. A live run is simulated ahead of what is shown; plots, lists and the
// timeline show only what has been seen, or they would show a future that a visitor may still change.
import type { RunEvent, Series } from '../frame';

const tellEveryS = 0.5; // s of the run: plots and lists grow so often
const slack = 1e-9;

export class Horizon {
  private seen = 0;
  private told = 0;
  private live = false;

  /** A recording has no horizon: everything in it has happened. */
  open(live: boolean): void {
    this.seen = this.told = 0;
    this.live = live;
  }

  /** s; Infinity for a recording. */
  get timeS(): number { return this.live ? this.seen : Infinity; }

  /** This moment is shown. True: plots and lists are to be rebuilt. */
  see(timeS: number): boolean {
    if (!this.live || timeS <= this.seen) return false;
    this.seen = timeS;
    return timeS >= this.told + tellEveryS;
  }

  /** Something has been seen that plots and lists do not tell of. */
  get behind(): boolean { return this.seen > this.told; }

  /** Plots and lists know all that has been seen. */
  tell(): void { this.told = this.seen; }

  /** What was after this moment has not happened. */
  cut(timeS: number): void {
    this.seen = Math.min(this.seen, timeS);
    this.told = Math.min(this.told, this.seen);
  }

  /** The rows up to the horizon, without copying them. */
  rows(series: Series): Series {
    const times = series.time_s;
    let rows = times.length;
    while (rows > 0 && times[rows - 1] > this.timeS + slack) --rows;
    if (rows === times.length) return series;
    return Object.fromEntries(Object.entries(series).map(([name, values]) => [name, values.subarray(0, rows)]));
  }

  events(events: readonly RunEvent[]): RunEvent[] {
    return events.filter((event) => event.time_s <= this.timeS + slack);
  }
}
