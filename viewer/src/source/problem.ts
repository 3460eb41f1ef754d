// SPDX-License-Identifier: MIT
// What went wrong, in words for the visitor; and the list of what was skipped.

/** Its message is shown as it is. Everything else that is thrown is a bug, or the machine's. */
export class Problem extends Error {
  constructor(text: string, readonly problems: string[] = []) {
    super(text);
    this.name = 'Problem';
  }
}

export function wordsOf(error: unknown): string {
  if (error instanceof Problem) return error.message;
  if (error instanceof RangeError && /alloc|memory|length/i.test(error.message)) return 'there is not enough memory';
  return error instanceof Error ? `an internal error: ${error.message}` : `an internal error: ${String(error)}`;
}

/** Warnings, each once; a file that is all damage needs no longer list. */
export class Warnings {
  static readonly most = 40;
  readonly texts: string[] = [];
  private left = 0;

  add(text: string): void {
    if (this.texts.includes(text)) return;
    if (this.texts.length < Warnings.most) this.texts.push(text);
    else ++this.left;
  }
  /** Changes whenever a warning was added. */
  get count(): number {
    return this.texts.length + this.left;
  }
  list(): string[] {
    return this.left === 0 ? [...this.texts] : [...this.texts, `and ${this.left} more warnings`];
  }
}
