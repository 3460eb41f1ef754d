// SPDX-License-Identifier: MIT
// The runs that are shown, side by side: recordings and live ones, in the order in which they were opened.
import { button, h } from './dom';
import type { Origin } from './origin';
import { namesOf } from './runs';
import type { Source } from './source/client';
import type { Header } from './source/protocol';
import type { Stage } from './stage';

export interface OpenRun {
  stage: Stage;
  origin: Origin;
}

export class OpenRuns {
  readonly element = h('main', { class: 'stages' });
  private runs: OpenRun[] = [];

  /** `close`: the visitor wants one of several to go. */
  constructor(private readonly close: (stage: Stage) => void) {}

  get all(): readonly OpenRun[] { return this.runs; }
  get stages(): Stage[] { return this.runs.map(({ stage }) => stage); }
  get sources(): Source[] { return this.runs.map(({ stage }) => stage.source); }
  /** Those that a visitor can interfere with. */
  get live(): Stage[] { return this.stages.filter((stage) => stage.live); }
  get headers(): Header[] { return this.sources.flatMap((source) => source.header.value ?? []); }
  /** What they differ in. */
  get names(): string[] { return namesOf(this.headers); }
  has(source: Source): boolean { return this.sources.includes(source); }

  /** Behind those that are there. */
  add(run: OpenRun): void {
    const { stage } = run;
    this.runs.push(run);
    stage.element.append(button('×', 'Close this run', () => this.close(stage), { class: 'close-run' }));
    this.element.insertBefore(stage.element, this.runs.at(-2)?.stage.element.nextSibling ?? this.element.firstChild);
    this.number();
  }

  remove(stage: Stage): void {
    this.runs = this.runs.filter((run) => run.stage !== stage);
    stage.dispose();
    this.number();
  }

  private number(): void {
    this.element.dataset.runs = String(this.runs.length);
    this.runs.forEach(({ stage }, k) => { stage.element.dataset.run = String(k + 1); });
  }
}
