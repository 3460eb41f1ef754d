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

/** Its own words, whatever it is. */
export const textOf = (problem: unknown): string => (problem instanceof Error ? problem.message : String(problem));

/** Warnings, each once; of one kind (a damaged frame, and another) the first, and how many there are. */
export class Warnings {
  static readonly most = 40; // kinds
  private readonly kinds = new Map<string, Set<string>>();
  private all = 0;

  /** `kind`: what it has in common with others; without one it stands alone. */
  add(text: string, kind = text): void {
    const texts = this.kinds.get(kind) ?? new Set();
    if (texts.has(text)) return;
    if (texts.size < mostOfKind) texts.add(text);
    this.kinds.set(kind, texts);
    ++this.all;
  }
  /** Changes whenever a warning was added. */
  get count(): number {
    return this.all;
  }
  list(): string[] {
    const first = [...this.kinds.values()].slice(0, Warnings.most);
    const left = this.kinds.size - first.length;
    const lines = first.map((texts) => [...texts][0] + andMore(texts.size));
    return left === 0 ? lines : [...lines, `and ${left} more warnings`];
  }
}

const mostOfKind = 100_000;

function andMore(count: number): string {
  return count === 1 ? '' : ` (and ${count - 1} more like it)`;
}

/** A warning without the number of its like: what it says that is new. */
export function kindOf(warning: string): string {
  return warning.replace(/ \(and \d+ more like it\)$/, '');
}
