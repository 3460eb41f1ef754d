// SPDX-License-Identifier: MIT
// Runs side by side: which ones a choice means, and what to call them.
import type { LiveChoice } from './panels/live';
import type { Header } from './source/protocol';

export const mostRuns = 4;

export interface ChosenRun {
  algorithm: string; // "": the scenario's own
  seed: number | null; // null: the scenario's own
  overrides: string[]; // "key=value", all of them
}

/** Each run that is meant: every algorithm with every seed, the algorithms of one seed together. */
export function runsOf(choice: Pick<LiveChoice, 'algorithms' | 'seeds' | 'overrides'>, most = mostRuns): ChosenRun[] {
  return choice.seeds.flatMap((seed) => choice.algorithms.map((algorithm) => ({
    algorithm, seed,
    overrides: [
      ...choice.overrides,
      ...(seed === null ? [] : [`seed=${seed}`]),
      ...(algorithm === '' ? [] : [`mission.algorithm=${algorithm}`]),
    ],
  }))).slice(0, most);
}

/** What each differs in from the others: its algorithm, its seed, its name; else its number. */
export function namesOf(headers: readonly Pick<Header, 'name' | 'seed' | 'settings'>[]): string[] {
  const algorithms = headers.map(({ settings }) => settings[0].setting.algorithm);
  const differs = (values: unknown[]) => new Set(values).size > 1;
  const parts = [
    differs(algorithms) ? algorithms : null,
    differs(headers.map(({ seed }) => seed)) ? headers.map(({ seed }) => `seed ${seed}`) : null,
    differs(headers.map(({ name }) => name)) ? headers.map(({ name }) => name) : null,
  ].flatMap((part) => (part === null ? [] : [part]));
  const names = headers.map((_, k) => parts.map((part) => part[k]).join(', '));
  return new Set(names).size === names.length ? names : names.map((name, k) => [name || algorithms[k], k + 1].join(' '));
}
