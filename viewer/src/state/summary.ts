// SPDX-License-Identifier: MIT
// What many runs come to: a row of figures for each algorithm, over those that have ended.

export interface Ended {
  algorithm: string;
  result: Record<string, string>; // columns of the run table, as text
}

export interface SummaryRow {
  algorithm: string;
  runs: number;
  complete: number;
  /** Of those that were complete; null: none was. */
  timeS: Spread | null;
  committed: Spread | null;
  /** Share of the time in which some edge was broken, and in which the radio network was in several parts. */
  broken: Spread | null;
  split: Spread | null;
}

export interface Spread {
  least: number;
  median: number;
  most: number;
}

export function summarise(runs: readonly Ended[]): SummaryRow[] {
  const algorithms = [...new Set(runs.map(({ algorithm }) => algorithm))];
  return algorithms.map((algorithm) => {
    const results = runs.filter((run) => run.algorithm === algorithm).map(({ result }) => result);
    const complete = results.filter((result) => result.complete === 'true');
    return {
      algorithm, runs: results.length, complete: complete.length,
      timeS: spread(complete.map((r) => number(r, 'completion_time_s'))), committed: spread(complete.map((r) => number(r, 'committed'))),
      broken: spread(results.map((r) => number(r, 'broken_ticks') / number(r, 'ticks'))),
      split: spread(results.map((r) => number(r, 'split_ticks') / number(r, 'ticks'))),
    };
  });
}

const number = (result: Record<string, string>, column: string): number => (result[column] === undefined || result[column] === '' ? NaN : Number(result[column]));

/** The median of an even number is the mean of the two in the middle. */
export function spread(values: readonly number[]): Spread | null {
  const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
  if (sorted.length === 0) return null;
  const half = sorted.length >> 1;
  const median = sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  return { least: sorted[0], median, most: sorted[sorted.length - 1] };
}

/** All of the run table, a row for each run. */
export function resultsCsv(runs: readonly (Ended & { seed: number })[]): string {
  const own = new Set(['algorithm', 'seed']);
  const columns = [...new Set(runs.flatMap(({ result }) => Object.keys(result)))].filter((column) => !own.has(column));
  const rows = runs.map(({ algorithm, seed, result }) => [algorithm, seed, ...columns.map((column) => cell(result[column] ?? ''))].join(','));
  return `${[['algorithm', 'seed', ...columns].join(','), ...rows].join('\n')}\n`;
}

const cell = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
