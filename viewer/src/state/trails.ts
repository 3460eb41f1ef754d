// SPDX-License-Identifier: MIT
// Where the robots have been during the last seconds: a ring of samples, taken from frames that are in the
// cache anyway. Nothing is fetched for a trail.
import { column, type Frame } from '../frame';

/** Where frames come from (source/client.ts). */
export interface FrameStore {
  framesBetween(fromS: number, toS: number, stride: number): Frame[];
}

const mostSamples = 128;

export class Trails {
  private robots = 0;
  private count = 0;
  private next = 0; // where the next sample goes
  private times = new Float64Array(mostSamples);
  private x = new Float32Array(0); // sample by sample
  private y = new Float32Array(0);

  /** `lengthS`: how far back trails go. */
  constructor(readonly lengthS = 10) {}

  /** Brings the trails to `timeS`. Going back, or a leap ahead, makes them anew from what is there. */
  update(store: FrameStore, timeS: number, stride: number): void {
    const latest = this.latestS;
    const anew = latest === null || timeS < latest || timeS > latest + this.lengthS;
    if (anew) this.clear();
    const fromS = anew ? timeS - this.lengthS : latest + this.spacingS;
    if (fromS > timeS) return;
    for (const frame of store.framesBetween(fromS, timeS, stride)) this.add(frame);
  }

  clear(): void {
    this.count = 0;
    this.next = 0;
  }

  get samples(): number {
    return this.count;
  }
  get latestS(): number | null {
    return this.count === 0 ? null : this.times[(this.next - 1 + mostSamples) % mostSamples];
  }

  /** Calls `point` from the oldest to the latest; `age` from 1 (about to vanish) to 0 (now). */
  each(robot: number, timeS: number, point: (x: number, y: number, age: number) => void): void {
    if (robot < 0 || robot >= this.robots) return;
    for (let k = this.count; k >= 1; --k) {
      const sample = (this.next - k + mostSamples) % mostSamples;
      const age = (timeS - this.times[sample]) / this.lengthS;
      if (age > 1 || age < 0) continue;
      point(this.x[sample * this.robots + robot], this.y[sample * this.robots + robot], age);
    }
  }

  // The ring is to hold the whole length.
  private get spacingS(): number {
    return this.lengthS / (mostSamples - 2);
  }

  private add(frame: Frame): void {
    const latest = this.latestS;
    if (latest !== null && frame.timeS < latest + 0.999 * this.spacingS) return;
    if (frame.robots !== this.robots) this.resize(frame.robots);
    this.times[this.next] = frame.timeS;
    this.x.set(column(frame, 'x_m'), this.next * this.robots);
    this.y.set(column(frame, 'y_m'), this.next * this.robots);
    this.next = (this.next + 1) % mostSamples;
    this.count = Math.min(this.count + 1, mostSamples);
  }

  private resize(robots: number): void {
    this.robots = robots;
    this.x = new Float32Array(mostSamples * robots);
    this.y = new Float32Array(mostSamples * robots);
    this.clear();
  }
}
