// SPDX-License-Identifier: MIT
// Where a run that is shown comes from, and the experiment that all of them are together: what an address has to say to
// show them again.
import { nothing, writeLink, type Experiment } from './link';
import type { Act } from './source/protocol';

export interface LiveOrigin {
  kind: 'live';
  scenario: string; // of those that come with Banyan; "": `text`
  name: string;
  text: string;
  algorithm: string; // "": the scenario's own
  seed: number | null; // null: the scenario's own
  sets: string[]; // "key=value", beside algorithm and seed
}
/** `address`: on the same server; "": a file of the visitor's. */
export type Origin = LiveOrigin | { kind: 'recording'; address: string };

export interface Known {
  origin: Origin;
  acts: Act[]; // what was done to it
}

/** All runs as one experiment: algorithms and seeds of one scenario if they are no more than that, else the first and the
 *  others beside it. Null: one of them is a file of the visitor's. `longer`: what was done needs these changes. */
export function experimentOf(runs: readonly Known[], longer: string[], look: Pick<Experiment, 'timeS' | 'view' | 'robot'>): Experiment | null {
  if (runs.length === 0) return null;
  const together = asProduct(runs, longer);
  if (together !== null) return { ...together, ...look };
  const each = runs.map((run) => alone(run, longer));
  if (each.some((one) => one === null)) return null;
  const [first, ...others] = each as Experiment[];
  return { ...first, ...look, beside: others.map(writeLink) };
}

function alone({ origin, acts }: Known, longer: string[]): Experiment | null {
  if (origin.kind === 'recording') return origin.address === '' ? null : { ...nothing, recording: origin.address };
  const { algorithm, seed } = origin;
  return { ...scenarioOf(origin, longer), algorithms: algorithm === '' ? [] : [algorithm], seeds: seed === null ? [] : [seed], acts: [acts] };
}

function scenarioOf({ scenario, name, text, sets }: LiveOrigin, longer: string[]): Experiment {
  return { ...nothing, scenario, name, text: scenario === '' ? text : '', sets: [...sets, ...longer] };
}

/** Every algorithm with every seed of one scenario, in the order of runs.ts; null: they are something else. */
function asProduct(runs: readonly Known[], longer: string[]): Experiment | null {
  const origins = runs.flatMap(({ origin }) => (origin.kind === 'live' ? [origin] : []));
  if (origins.length < runs.length) return null;
  const scenarios = origins.map((origin) => JSON.stringify(scenarioOf(origin, longer)));
  if (new Set(scenarios).size > 1) return null;
  const algorithms = [...new Set(origins.map(({ algorithm }) => algorithm))];
  const seeds = [...new Set(origins.map(({ seed }) => seed))];
  const expected = seeds.flatMap((seed) => algorithms.map((algorithm) => ({ algorithm, seed })));
  const isSame = expected.length === origins.length && expected.every(({ algorithm, seed }, k) => origins[k].algorithm === algorithm && origins[k].seed === seed);
  if (!isSame) return null;
  return {
    ...scenarioOf(origins[0], longer), acts: runs.map(({ acts }) => acts),
    algorithms: algorithms.filter((a) => a !== '' || algorithms.length > 1), seeds: seeds.flatMap((seed) => seed ?? []),
  };
}
