// SPDX-License-Identifier: MIT
// The cells of a map, in cells: the lower left corner is the origin, each is 1 wide. As CellGrid in
// world/src/cell_grid.cpp, operation by operation, so that the page and the program agree about every link.

const mostReach = 255;
const mostCells = 2 ** 24;

/** A rectangle of occupied cells. */
export interface Block { left: number; bottom: number; right: number; top: number }

export class Cells {
  /** Per cell, the lowest row first, within how many columns and rows nothing is occupied; 0: it is itself. */
  private readonly near: Uint8Array;
  private found: Block[] | null = null;

  constructor(readonly columns: number, readonly rows: number, occupied: Uint8Array) {
    this.near = new Uint8Array(columns * rows).fill(mostReach);
    const { near } = this;
    const least = (column: number, row: number, beside: number, other: number) => {
      let value = mostReach;
      const i = column + beside;
      if (i >= 0 && i < columns) value = near[row * columns + i]!;
      const j = row + other;
      if (j < 0 || j >= rows) return value;
      for (let k = Math.max(0, column - 1); k < Math.min(columns, column + 2); ++k) value = Math.min(value, near[j * columns + k]!);
      return value;
    };
    for (let row = 0; row < rows; ++row) {
      for (let column = 0; column < columns; ++column) {
        const at = row * columns + column;
        near[at] = occupied[at] ? 0 : Math.min(mostReach, least(column, row, -1, -1) + 1);
      }
    }
    for (let row = rows - 1; row >= 0; --row) {
      for (let column = columns - 1; column >= 0; --column) {
        const at = row * columns + column;
        if (near[at] !== 0) near[at] = Math.min(near[at]!, least(column, row, 1, 1) + 1);
      }
    }
  }

  /** From the text that a scenario has; null if it is none. */
  static parse(text: string): Cells | null {
    const lines: [cells: string, times: number][] = [];
    let columns = 0, rows = 0;
    for (const line of text.trim().split('\n')) {
      const [, times, cells] = /^(?:(\d+)\*)?((?:\d*[#.])+)$/.exec(line.trim()) ?? [];
      if (cells === undefined) return null;
      const count = times === undefined ? 1 : Number(times);
      let length = 0;
      for (const [, run] of cells.matchAll(/(\d*)[#.]/g)) length += run === '' ? 1 : Number(run);
      rows += count;
      if (length === 0 || count === 0 || (columns > 0 && length !== columns) || !(length * rows <= mostCells)) return null;
      columns = length;
      lines.push([cells, count]);
    }
    const occupied = new Uint8Array(columns * rows);
    let row = rows - 1;
    for (const [cells, times] of lines) {
      const top = row;
      let column = 0;
      for (const [, run, cell] of cells.matchAll(/(\d*)([#.])/g)) {
        const end = column + (run === '' ? 1 : Number(run));
        if (cell === '#') occupied.fill(1, top * columns + column, top * columns + end);
        column = end;
      }
      for (let k = 1; k < times; ++k) occupied.copyWithin((top - k) * columns, top * columns, (top + 1) * columns);
      row -= times;
    }
    return new Cells(columns, rows, occupied);
  }

  reach(column: number, row: number): number {
    const i = Math.min(Math.max(column, 0), this.columns - 1), j = Math.min(Math.max(row, 0), this.rows - 1);
    const near = this.near[j * this.columns + i]!;
    return i === column && j === row ? near : Math.max(Math.abs(column - i), Math.abs(row - j), near);
  }

  /** Rectangles that the occupied cells make up, each as wide as it can be and then as high. */
  blocks(): readonly Block[] {
    if (this.found) return this.found;
    const all: Block[] = [];
    let open: Block[] = [];
    for (let row = 0; row < this.rows; ++row) {
      const next: Block[] = [];
      let old = 0;
      for (let column = 0; column < this.columns;) {
        if (this.near[row * this.columns + column] !== 0) { ++column; continue; }
        const left = column;
        while (column < this.columns && this.near[row * this.columns + column] === 0) ++column;
        while (old < open.length && open[old]!.left < left) ++old;
        const below = open[old];
        const block = below && below.left === left && below.right === column ? below : { left, bottom: row, right: column, top: row };
        if (block !== below) all.push(block);
        block.top = row + 1;
        next.push(block);
      }
      open = next;
    }
    this.found = all;
    return all;
  }

  /** Whether the open segment a-b meets the inside of the occupied area, or passes between two cells that touch. */
  blocksLine(ax: number, ay: number, bx: number, by: number): boolean {
    if (bx !== ax ? bx < ax : by < ay) return this.blocksLine(bx, by, ax, ay);
    if (bx <= 0 || ax >= this.columns || Math.max(ay, by) <= 0 || Math.min(ay, by) >= this.rows) return false;
    if (ax === bx && ay === by) return this.isInside(ax, ay);
    if (ay === by) return blocksAlong((k, across) => this.reach(k, across), ay, ax, bx);
    if (ax === bx) return blocksAlong((k, across) => this.reach(across, k), ax, ay, by);
    if (ay < by) return blocksAcross((i, j) => this.reach(i, j), ax, ay, bx, by);
    return blocksAcross((i, j) => this.reach(i, -1 - j), ax, -ay, bx, -by);
  }

  private isInside(x: number, y: number): boolean {
    const right = Math.floor(x), top = Math.floor(y);
    const left = right === x ? right - 1 : right, bottom = top === y ? top - 1 : top;
    return [[left, bottom], [left, top], [right, bottom], [right, top]].every(([i, j]) => this.reach(i!, j!) === 0);
  }
}

type Reach = (i: number, j: number) => number;

function blocksAlong(at: Reach, across: number, from: number, to: number): boolean {
  const row = Math.floor(across), end = Math.ceil(to);
  const between = row === across;
  for (let k = Math.floor(from); k < end;) {
    const here = at(k, row), beside = between ? at(k, row - 1) : here;
    if (here === 0 && beside === 0) return true;
    if (between && k > from && k < to &&
        ((here === 0 && at(k - 1, row - 1) === 0) || (beside === 0 && at(k - 1, row) === 0))) return true;
    k += Math.max(1, Math.min(here, beside));
  }
  return false;
}

function blocksAcross(at: Reach, ax: number, ay: number, bx: number, by: number): boolean {
  const dx = bx - ax, dy = by - ay;
  const side = (x: number, y: number) => dx * (y - ay) - dy * (x - ax);
  let column = Math.floor(ax), row = Math.floor(ay);
  for (;;) {
    const free = at(column, row);
    if (free === 0) return true;
    const right = column + free, top = row + free;
    if (bx <= right && by <= top) return false;
    const corner = side(right, top);
    if (corner === 0) {
      if (at(right, top - 1) === 0 && at(right - 1, top) === 0) return true;
      column = right;
      row = top;
    } else if (corner > 0) {
      let next = Math.min(Math.max(Math.floor(ay + (right - ax) * (dy / dx)), row), top - 1);
      while (next + 1 < top && side(right, next + 1) <= 0) ++next;
      while (next > row && side(right, next) > 0) --next;
      column = right;
      row = next;
    } else {
      let next = Math.min(Math.max(Math.floor(ax + (top - ay) * (dx / dy)), column), right - 1);
      while (next + 1 < right && side(next + 1, top) >= 0) ++next;
      while (next > column && side(next, top) < 0) --next;
      column = next;
      row = top;
    }
  }
}
