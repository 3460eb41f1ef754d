// SPDX-License-Identifier: MIT
// Opens what a visitor asks for: recordings, scenarios, or both, instead of what is shown or beside it. What is there
// stays until all of it is open; if one cannot be opened, it stays for good, and the reason is said.
import { h, setText } from './dom';
import { judge } from './files';
import type { LiveChoice, LivePanel } from './panels/live';
import type { Notice } from './panels/notice';
import type { Origin } from './origin';
import { mostRuns, runsOf } from './runs';
import type { Source } from './source/client';
import { openFile, openLive, openUrl } from './source/open';
import { Problem, textOf } from './source/problem';
import type { Act } from './source/protocol';

export interface Opened {
  source: Source;
  origin: Origin;
}

/** `beside`: what is shown stays. */
export interface How {
  beside: boolean;
}

export interface OpenerPage {
  readonly shown: number; // runs
  show(runs: Opened[], how: How): void;
  /** A scenario cannot be run; its panel says why. */
  showLivePanel(): void;
}

const instead: How = { beside: false };

export class Opener {
  readonly loading = h('div', { class: 'loading', role: 'status' }, 'Loading …');
  private attempts = 0; // a later one makes an earlier one void

  constructor(private readonly page: OpenerPage, private readonly live: LivePanel, private readonly notice: Notice) {}

  /** Recordings, and a scenario with the choices of the panel. */
  async files(files: File[], how = instead): Promise<void> {
    try {
      const opened = await Promise.all(files.map(judge));
      const recordings = opened.flatMap((o) => ('recording' in o ? [o.recording] : []));
      const scenarios = opened.flatMap((o) => ('scenario' in o ? [o.scenario] : []));
      if (scenarios.length > 1) throw new Error('Open one scenario at a time; recordings may stand beside it.');
      if (scenarios.length > 0) this.live.setOwn(scenarios[0].name, scenarios[0].text, []);
      const runs: Opened[] = recordings.map((file) => ({ source: openFile(file), origin: { kind: 'recording', address: '' } }));
      if (scenarios.length > 0) runs.push(...this.liveRuns(this.live.choice(), [], runs.length));
      await this.open(runs, how);
    } catch (problem) {
      this.notice.bad(textOf(problem));
    }
  }

  /** A recording on this server. */
  async address(address: string, name: string, size = 0, how = instead): Promise<boolean> {
    return await this.open([{ source: openUrl(address, name, size), origin: { kind: 'recording', address } }], how);
  }

  /** Whether it is shown. `acts`: what is to be done to each run. */
  async start(choice: LiveChoice, acts: Act[][] = [], how = instead): Promise<boolean> {
    this.live.setProblems([]);
    return await this.open(this.liveRuns(choice, acts, how.beside ? this.page.shown : 0), how);
  }

  /** A run that is not shown; resolves when it has told what it holds. */
  async aside(choice: LiveChoice, algorithm: string, seed: number): Promise<Source> {
    const [{ overrides }] = runsOf({ ...choice, algorithms: [algorithm], seeds: [seed] });
    const source = openLive({ name: choice.name, text: choice.text, overrides });
    await headerOf(source);
    return source;
  }

  private liveRuns(choice: LiveChoice, acts: Act[][], others: number): Opened[] {
    const runs = runsOf(choice);
    const threads = Math.max(1, Math.floor(navigator.hardwareConcurrency / (runs.length + others)));
    return runs.map(({ algorithm, seed, overrides }, k) => ({
      source: openLive({ name: choice.name, text: choice.text, overrides, threads, acts: acts[k] ?? [] }),
      origin: { kind: 'live', scenario: choice.picked, name: choice.name, text: choice.text, algorithm, seed, sets: choice.overrides },
    }));
  }

  private async open(runs: Opened[], how: How): Promise<boolean> {
    const attempt = ++this.attempts;
    const together = runs.length + (how.beside ? this.page.shown : 0);
    const close = () => { for (const { source } of runs) source.close(); };
    const live = runs.some(({ origin }) => origin.kind === 'live');
    if (together > mostRuns) {
      close();
      this.notice.bad(`At most ${mostRuns} runs stand side by side; these would be ${together}.`);
      return false;
    }
    this.loading.hidden = false;
    setText(this.loading, live ? 'Loading the simulation …' : 'Reading the recording …');
    try {
      await Promise.all(runs.map(({ source }) => headerOf(source)));
    } catch (problem) {
      close();
      if (attempt === this.attempts) this.refused(problem, live);
      return false;
    } finally {
      if (attempt === this.attempts) this.loading.hidden = true;
    }
    const wanted = attempt === this.attempts;
    if (wanted) this.page.show(runs, how);
    else close();
    return wanted;
  }

  private refused(problem: unknown, live: boolean): void {
    const problems = problem instanceof Problem ? problem.problems : [];
    if (live) this.live.setProblems(problems.length > 0 ? [...problems] : [textOf(problem)]);
    if (live) this.page.showLivePanel();
    this.notice.bad([textOf(problem), ...(live ? [] : problems)].join('\n'));
  }
}

/** Resolves when a source has told what it holds, rejects with its problem. */
export function headerOf(source: Source): Promise<void> {
  return new Promise((resolve, reject) => {
    if (source.failure.value) return reject(source.failure.value);
    if (source.header.value) return resolve();
    source.header.subscribe(() => resolve());
    source.failure.subscribe((problem) => { if (problem) reject(problem); });
  });
}
