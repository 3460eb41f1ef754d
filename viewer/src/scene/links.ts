// SPDX-License-Identifier: MIT
// Radio links from positions alone: in range, both alive and, with line of sight, no body or obstacle in between.
// Gives the same result as record/src/links.cpp, which the tests compare it with.
import { column, type Frame, type Setting } from '../frame';
import { Cells } from './cells';
import { blocks, discBlocks } from './sight';

/** Pairs of robots, i < j, one after the other: [i, j, i, j, ...]. */
export interface Links {
  open: Int32Array;
  /** In range, but without line of sight. */
  blocked: Int32Array;
}

/** Why two robots do not hear each other. */
export type Link = 'open' | 'out of range' | 'blocked' | 'dead';

const slack = 1e-6; // m, against rounding when cells are chosen
const flat = 1e-6; // m: nearly along a row
const sampled = 400; // robots: of 10,000 enough for a few per cent
const lengthClasses = 64;

class Pairs {
  private data = new Int32Array(1024);
  private length = 0;
  add(i: number, j: number): void {
    if (this.length + 2 > this.data.length) {
      const more = new Int32Array(2 * this.data.length);
      more.set(this.data);
      this.data = more;
    }
    this.data[this.length++] = i;
    this.data[this.length++] = j;
  }
  taken(): Int32Array { return this.data.slice(0, this.length); }
}

export class Radio {
  private readonly x: Float64Array;
  private readonly y: Float64Array;
  private readonly alive: Float64Array;
  private readonly raised: Float64Array;
  private readonly cells: Cells;
  private readonly deadHide: boolean;

  constructor(private readonly setting: Setting, frame: Frame) {
    this.x = column(frame, 'x_m');
    this.y = column(frame, 'y_m');
    this.alive = column(frame, 'alive');
    this.raised = column(frame, 'raised');
    this.deadHide = setting.dead_bodies !== false;
    this.cells = new Cells(this.x, this.y, Math.max(setting.range_m / 8, 2 * setting.radius_m, 1e-3));
  }

  link(i: number, j: number): Link {
    if (this.alive[i] === 0 || this.alive[j] === 0) return 'dead';
    if (!this.inRange(i, j)) return 'out of range';
    return this.setting.line_of_sight && this.isBlocked(i, j) ? 'blocked' : 'open';
  }

  /** The robots that robot i hears. */
  neighbours(i: number): number[] {
    const found: number[] = [];
    this.forEachNear(i, (j) => { if (this.link(i, j) === 'open') found.push(j); });
    return found.sort((a, b) => a - b);
  }

  links(): Links {
    const open = new Pairs();
    const blocked = new Pairs();
    for (let i = 0; i < this.x.length; ++i) {
      if (this.alive[i] === 0) continue;
      this.forEachNear(i, (j) => {
        if (j < i) return;
        const link = this.link(i, j);
        if (link === 'open') open.add(i, j);
        else if (link === 'blocked') blocked.add(i, j);
      });
    }
    return { open: open.taken(), blocked: blocked.taken() };
  }

  /** The links up to a length of which at least one end is seen (`seen`: one entry per robot). */
  linksWithin(lengthM: number, seen: Uint8Array): Links {
    const open = new Pairs();
    const blocked = new Pairs();
    const length2 = lengthM * lengthM;
    for (let i = 0; i < this.x.length; ++i) {
      if (seen[i] === 0 || this.alive[i] === 0) continue;
      this.forEachNear(i, (j) => {
        if (j < i && seen[j] === 1) return;
        const dx = this.x[j]! - this.x[i]!, dy = this.y[j]! - this.y[i]!;
        if (dx * dx + dy * dy > length2) return;
        const link = this.link(i, j);
        if (link === 'open') open.add(i, j);
        else if (link === 'blocked') blocked.add(i, j);
      }, lengthM);
    }
    return { open: open.taken(), blocked: blocked.taken() };
  }

  /** Up to which length about `most` pairs are in range, and how many there are of any length: estimated from some of
   *  the robots that are seen, since to count a million pairs takes longer than a picture may. */
  lengthFor(most: number, seen: Uint8Array): { lengthM: number; pairs: number } {
    const range = this.setting.range_m;
    const candidates: number[] = [];
    for (let i = 0; i < this.x.length; ++i) if (seen[i] === 1 && this.alive[i] === 1) candidates.push(i);
    const step = Math.max(1, Math.floor(candidates.length / sampled));
    const counts = new Float64Array(lengthClasses);
    let asked = 0;
    for (let k = 0; k < candidates.length; k += step, ++asked) {
      const i = candidates[k]!;
      this.forEachNear(i, (j) => {
        const length = Math.hypot(this.x[j]! - this.x[i]!, this.y[j]! - this.y[i]!);
        if (length < range && this.alive[j] === 1) ++counts[Math.floor((lengthClasses * length) / range)]!;
      });
    }
    const perCount = candidates.length / Math.max(1, asked) / 2; // each pair is seen from both ends
    const pairs = perCount * counts.reduce((sum, count) => sum + count, 0);
    if (pairs <= most) return { lengthM: range, pairs };
    let sum = 0;
    let c = 0;
    while (c < lengthClasses - 1 && perCount * (sum + counts[c]!) <= most) sum += counts[c++]!;
    return { lengthM: (range * Math.max(1, c)) / lengthClasses, pairs };
  }

  private inRange(i: number, j: number): boolean {
    const dx = this.x[j]! - this.x[i]!;
    const dy = this.y[j]! - this.y[i]!;
    return Math.sqrt(dx * dx + dy * dy) < this.setting.range_m;
  }

  /** All others in the cells that `range` reaches. */
  private forEachNear(i: number, visit: (j: number) => void, range = this.setting.range_m): void {
    const { cells } = this;
    const right = cells.column(this.x[i]! + range);
    const top = cells.row(this.y[i]! + range);
    for (let row = cells.row(this.y[i]! - range); row <= top; ++row) {
      const from = cells.first[row * cells.columns + cells.column(this.x[i]! - range)]!;
      const to = cells.first[row * cells.columns + right + 1]!;
      for (let k = from; k < to; ++k) if (cells.members[k] !== i) visit(cells.members[k]!);
    }
  }

  /** Bodies, those of the dead too unless they vanish, and obstacles. */
  private isBlocked(i: number, j: number): boolean {
    const swap = this.x[j]! < this.x[i]! || (this.x[j] === this.x[i] && this.y[j]! < this.y[i]!);
    const ax = this.x[swap ? j : i]!, ay = this.y[swap ? j : i]!;
    const bx = this.x[swap ? i : j]!, by = this.y[swap ? i : j]!;
    if (this.bodyBlocks(i, j, ax, ay, bx, by)) return true;
    for (const obstacle of this.setting.obstacles) if (blocks(obstacle, ax, ay, bx, by)) return true;
    return false;
  }

  /** What hides them from each other, in words; "" if nothing does. */
  blocker(i: number, j: number): string {
    const [ax, ay, bx, by] = [this.x[i]!, this.y[i]!, this.x[j]!, this.y[j]!];
    for (let k = 0; k < this.x.length; ++k) {
      if (k === i || k === j || (this.alive[k] === 0 && !this.deadHide)) continue;
      if (discBlocks(this.x[k]!, this.y[k]!, this.setting.radius_m, ax, ay, bx, by) && !this.isLookedOver(k, i, j)) return `robot ${k}`;
    }
    const wall = this.setting.obstacles.findIndex((obstacle) => blocks(obstacle, ax, ay, bx, by));
    return wall < 0 ? '' : `obstacle ${wall}`;
  }

  /** Where sight leaks: whether the nearer of i and j looks over the body of k, which is in their way. */
  private isLookedOver(k: number, i: number, j: number): boolean {
    if (this.raised[i] === 0 && this.raised[j] === 0) return false;
    const dx = this.x[j]! - this.x[i]!;
    const dy = this.y[j]! - this.y[i]!;
    const along = (this.x[k]! - this.x[i]!) * dx + (this.y[k]! - this.y[i]!) * dy;
    return this.raised[2 * along < dx * dx + dy * dy ? i : j] !== 0;
  }

  /** a has the smaller x. In each row of cells only those are looked at that the segment, widened by a radius, passes. */
  private bodyBlocks(i: number, j: number, ax: number, ay: number, bx: number, by: number): boolean {
    const { cells } = this;
    const radius = this.setting.radius_m;
    const dx = bx - ax;
    const dy = by - ay;
    const top = cells.row(Math.max(ay, by) + radius);
    for (let row = cells.row(Math.min(ay, by) - radius); row <= top; ++row) {
      let enter = 0, leave = 1; // where the segment is in this row's band, as shares of its length
      if (Math.abs(dy) > flat) {
        const low = (cells.bottom(row) - radius - slack - ay) / dy;
        const high = (cells.bottom(row + 1) + radius + slack - ay) / dy;
        enter = Math.max(0, Math.min(low, high));
        leave = Math.min(1, Math.max(low, high));
      }
      const to = cells.first[row * cells.columns + cells.column(ax + leave * dx + radius + slack) + 1]!;
      for (let m = cells.first[row * cells.columns + cells.column(ax + enter * dx - radius - slack)]!; m < to; ++m) {
        const k = cells.members[m]!;
        if (k === i || k === j || (this.alive[k] === 0 && !this.deadHide)) continue;
        if (discBlocks(this.x[k]!, this.y[k]!, radius, ax, ay, bx, by) && !this.isLookedOver(k, i, j)) return true;
      }
    }
    return false;
  }
}
