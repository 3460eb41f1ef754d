// SPDX-License-Identifier: MIT
// Work that is wanted far more often than it is worth doing: it is done at most so often, and not forgotten.

export class Pace {
  private wanted = false;
  private doneMs = -Infinity;

  constructor(private readonly everyMs: number) {}

  want(): void { this.wanted = true; }

  /** Asked once per picture, with its time. True: it is to be done now. */
  due(nowMs: number): boolean {
    if (!this.wanted || nowMs - this.doneMs < this.everyMs) return false;
    this.wanted = false;
    this.doneMs = nowMs;
    return true;
  }
}
