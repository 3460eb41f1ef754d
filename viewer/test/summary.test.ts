// SPDX-License-Identifier: MIT
// Many runs: which frames of them are kept, and what they come to.
import { describe, expect, it } from 'vitest';
import type { Frame, Setting } from '../src/frame';
import { Batch, hasEnded, shownAt, type BatchSource } from '../src/state/batch';
import { resultsCsv, spread, summarise } from '../src/state/summary';
import { frameAt } from './support';

/** A run of so many ticks, handed out at most seven frames at a time. */
class Fake implements BatchSource {
  header: { value: { result: Record<string, string> } } = { value: { result: {} } };
  tickS = 0.1;
  closed = false;
  asked = 0;
  constructor(private readonly ticks: number, private readonly robots = 1) {}
  settingAt(timeS: number): Setting { return { name: String(timeS) } as Setting; }
  async frames(fromS: number): Promise<Frame[]> {
    ++this.asked;
    const first = Math.max(0, Math.ceil(fromS / 0.1 - 1e-6) - 1); // and the one before
    const frames = Array.from({ length: 7 }, (_, k) => frameAt(first + k, 0.1, this.robots));
    if (first + 7 > this.ticks) this.header.value.result = { complete: 'true', completion_time_s: String(this.ticks / 10) };
    return frames;
  }
  close(): void { this.closed = true; }
}

const batchOf = (...sources: (Fake | Error)[]) => new Batch(sources.map((_, seed) => ({ algorithm: 'a', seed })), async (k) => {
  const source = sources[k];
  if (source instanceof Error) throw source;
  return source;
}, () => {});

describe('many runs', () => {
  it('go on until each has ended, and every source is closed', async () => {
    const sources = [new Fake(30), new Fake(100), new Fake(5)];
    const batch = batchOf(...sources);
    await batch.run(2);
    expect(batch.runs.map(({ result }) => result.completion_time_s)).toEqual(['3', '10', '0.5']);
    expect(batch.runs.map(({ frames }) => frames.map(({ tick }) => tick).every((tick, k) => tick === k))).toEqual([true, true, true]);
    expect(sources.every(({ closed }) => closed)).toBe(true);
    expect(batch.ended).toBe(3);
  });

  it('of which one fails go on with the others', async () => {
    const batch = batchOf(new Error('no such key'), new Fake(5));
    await batch.run(1);
    expect(batch.runs.map(({ problem }) => problem)).toEqual(['no such key', '']);
    expect(batch.runs.every(hasEnded)).toBe(true);
  });

  it('stop when they are told to', async () => {
    const source = new Fake(1e9);
    const batch = new Batch([1, 2].map((seed) => ({ algorithm: 'a', seed })), async () => source, () => { if (source.asked === 5) batch.stop(); });
    await batch.run(1);
    expect(batch.ended).toBe(0);
    expect(source.asked).toBe(5);
    expect(source.closed).toBe(true);
  });

  it('keep frames that are evenly apart, with the setting of their time, however long the run is', async () => {
    const batch = batchOf(new Fake(2000));
    await batch.run(1);
    const [run] = batch.runs;
    const ticks = run.frames.map(({ tick }) => tick);
    expect(ticks.length).toBeGreaterThan(100);
    expect(ticks.length).toBeLessThanOrEqual(240);
    expect(ticks).toEqual(ticks.map((_, k) => 16 * k));
    expect(run.settings.map(({ name }) => Number(name))).toEqual(run.frames.map(({ timeS }) => timeS));
    expect([0, 1.59, 1.6, 1e9].map((timeS) => shownAt(run, timeS)?.frame.tick)).toEqual([0, 0, 16, ticks.at(-1)]);
  });
});

describe('what they come to', () => {
  it('is a median and its range, whatever the order, and nothing of nothing', () => {
    expect(spread([5, 1, 3])).toEqual({ least: 1, median: 3, most: 5 });
    expect(spread([4, 1, NaN, 3, 2])).toEqual({ least: 1, median: 2.5, most: 4 });
    expect(spread([NaN])).toBeNull();
  });

  it('is told for each algorithm; times only of what was complete', () => {
    const run = (algorithm: string, complete: boolean, time: number, broken: number) => ({ algorithm, result: {
      complete: String(complete), completion_time_s: complete ? String(time) : '', committed: '8', broken_ticks: String(broken), split_ticks: '0', ticks: '100' } });
    const [a, b] = summarise([run('a', true, 10, 0), run('b', false, 0, 50), run('a', false, 0, 20), run('a', true, 14, 10)]);
    expect(a).toMatchObject({ algorithm: 'a', runs: 3, complete: 2, timeS: { least: 10, median: 12, most: 14 }, broken: { least: 0, median: 0.1, most: 0.2 } });
    expect(b).toMatchObject({ algorithm: 'b', runs: 1, complete: 0, timeS: null, committed: null, split: { least: 0, median: 0, most: 0 } });
  });

  it('is a table that others can read', () => {
    const csv = resultsCsv([{ algorithm: 'a', seed: 3, result: { seed: '3', algorithm: 'a', words: 'b, "c"', ticks: '9' } }, { algorithm: 'a', seed: 4, result: { ticks: '8' } }]);
    expect(csv).toBe('algorithm,seed,words,ticks\na,3,"b, ""c""",9\na,4,,8\n');
  });
});
