// SPDX-License-Identifier: MIT
// Many runs of one experiment, a few at a time, each up to its end: of each its result and some of its frames, so that
// all of them can be shown at any moment without being simulated again.
import type { Frame, Setting } from '../frame';
import { textOf } from '../source/problem';

/** What it needs of a source (source/client.ts). */
export interface BatchSource {
  readonly header: { readonly value: { result: Record<string, string> } | null };
  readonly tickS: number;
  settingAt(timeS: number): Setting | null;
  frames(fromS: number, toS: number): Promise<Frame[]>;
  close(): void;
}

export interface BatchRun {
  algorithm: string; // "": the scenario's own
  seed: number;
  frames: Frame[]; // some of them, by time
  settings: Setting[]; // as it was then
  result: Record<string, string>; // empty until it has ended
  problem: string; // why it could not be run; else ""
}

const mostFrames = 240; // of a run; then every second one goes
const mostBytes = 24 << 20; // of a run's frames
const chunkS = 5; // of the run, asked for at a time

export class Batch {
  readonly runs: BatchRun[];
  private stopped = false;

  /** `open` resolves when the source has told what it holds. `changed` is called whenever there is more to show. */
  constructor(
    what: readonly { algorithm: string; seed: number }[], private readonly open: (k: number) => Promise<BatchSource>,
    private readonly changed: () => void,
  ) {
    this.runs = what.map(({ algorithm, seed }) => ({ algorithm, seed, frames: [], settings: [], result: {}, problem: '' }));
  }

  /** So many at a time; resolves when all have ended, or none is to go on. */
  async run(together: number): Promise<void> {
    let next = 0;
    const work = async () => {
      while (!this.stopped && next < this.runs.length) await this.runOne(next++);
    };
    await Promise.all(Array.from({ length: together }, work));
  }

  stop(): void { this.stopped = true; }

  get ended(): number { return this.runs.filter(hasEnded).length; }
  /** Of the longest, s. */
  get endS(): number { return Math.max(0, ...this.runs.map(({ frames }) => frames.at(-1)?.timeS ?? 0)); }

  private async runOne(k: number): Promise<void> {
    const run = this.runs[k];
    let source: BatchSource | null = null;
    try {
      source = await this.open(k);
      await this.simulate(run, source);
    } catch (problem) {
      run.problem = textOf(problem);
    } finally {
      source?.close();
    }
    this.changed();
  }

  private async simulate(run: BatchRun, source: BatchSource): Promise<void> {
    let every = 1; // ticks from one kept frame to the next
    for (let fromS = 0; !this.stopped; ) {
      const frames = (await source.frames(fromS, fromS + chunkS)).filter(({ timeS }) => timeS >= fromS - 1e-9);
      const last = frames.at(-1);
      if (last === undefined) throw new Error('it does not go on');
      every = keep(run, frames, every, source);
      run.result = source.header.value?.result ?? {};
      this.changed();
      if (Object.keys(run.result).length > 0) return;
      fromS = last.timeS + source.tickS / 2;
    }
  }
}

export const hasEnded = ({ result, problem }: BatchRun): boolean => problem !== '' || Object.keys(result).length > 0;

/** Adds those that are `every` ticks apart; returns how far apart they are to be from now on. */
function keep(run: BatchRun, frames: readonly Frame[], every: number, source: BatchSource): number {
  let step = every;
  for (const frame of frames) {
    if (frame.tick % step !== 0) continue;
    run.frames.push(frame);
    run.settings.push(source.settingAt(frame.timeS)!);
    const bytes = run.frames.length * frame.data.byteLength;
    if (run.frames.length <= 2 || (run.frames.length <= mostFrames && bytes <= mostBytes)) continue;
    step *= 2;
    const kept = run.frames.map(({ tick }) => tick % step === 0);
    run.settings = run.settings.filter((_, k) => kept[k]);
    run.frames = run.frames.filter((_, k) => kept[k]);
  }
  return step;
}

/** The one that is shown at a moment: the last one up to then. Null: there is none yet. */
export function shownAt(run: BatchRun, timeS: number): { frame: Frame; setting: Setting } | null {
  let k = run.frames.length - 1;
  while (k > 0 && run.frames[k].timeS > timeS + 1e-9) --k;
  return k < 0 ? null : { frame: run.frames[k], setting: run.settings[k] };
}
