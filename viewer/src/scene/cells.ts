// SPDX-License-Identifier: MIT
// Robots by cells of a grid, so that near robots are found without testing all the others.

const mostM = 1e6; // beyond, a position is damage; such a robot is in no cell

export class Cells {
  readonly sizeM: number;
  readonly columns: number;
  readonly rows: number;
  /** The robots of cell c are members[first[c]] .. members[first[c + 1] - 1], ascending. */
  readonly first: Int32Array;
  readonly members: Int32Array;
  private readonly minX: number;
  private readonly minY: number;

  constructor(x: Float64Array, y: Float64Array, wishedM: number) {
    let minX = Infinity, minY = Infinity, maxX = -Infinity, maxY = -Infinity;
    const valid = (i: number) => Math.abs(x[i]!) < mostM && Math.abs(y[i]!) < mostM;
    let count = 0;
    for (let i = 0; i < x.length; ++i) {
      if (!valid(i)) continue;
      ++count;
      minX = Math.min(minX, x[i]!); maxX = Math.max(maxX, x[i]!);
      minY = Math.min(minY, y[i]!); maxY = Math.max(maxY, y[i]!);
    }
    if (count === 0) minX = minY = maxX = maxY = 0;
    this.minX = minX;
    this.minY = minY;
    // A few robots that went far away must not cost a grid of millions of empty cells.
    let size = wishedM;
    const cells = () => (Math.floor((maxX - minX) / size) + 1) * (Math.floor((maxY - minY) / size) + 1);
    while (cells() > 8 * x.length + 4096) size *= 2; // nor a large swarm one that takes longer to make than to search
    this.sizeM = size;
    this.columns = Math.floor((maxX - minX) / size) + 1;
    this.rows = Math.floor((maxY - minY) / size) + 1;
    this.first = new Int32Array(this.columns * this.rows + 1);
    this.members = new Int32Array(count);
    for (let i = 0; i < x.length; ++i) if (valid(i)) ++this.first[this.cell(x[i]!, y[i]!) + 1]!;
    for (let c = 0; c < this.first.length - 1; ++c) this.first[c + 1]! += this.first[c]!;
    const next = this.first.slice();
    for (let i = 0; i < x.length; ++i) if (valid(i)) this.members[next[this.cell(x[i]!, y[i]!)]!++] = i;
  }

  /** Column of an x, within the grid; likewise row. */
  column(xM: number): number {
    return Math.min(this.columns - 1, Math.max(0, Math.floor((xM - this.minX) / this.sizeM)));
  }
  row(yM: number): number {
    return Math.min(this.rows - 1, Math.max(0, Math.floor((yM - this.minY) / this.sizeM)));
  }
  /** The lowest y of a row, m. */
  bottom(row: number): number { return this.minY + row * this.sizeM; }
  private cell(xM: number, yM: number): number { return this.row(yM) * this.columns + this.column(xM); }
}
