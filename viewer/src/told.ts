// SPDX-License-Identifier: MIT
// What lists, plots and headers tell of all runs, as far as it has been seen: they cover whole runs, so they are
// rebuilt a few times a second at most.
import { setText } from './dom';
import type { RunEvent, Series } from './frame';
import { apart } from './files';
import type { OpenRuns } from './open_runs';
import type { EventsList, ListedEvent } from './panels/events_list';
import type { Notice } from './panels/notice';
import type { Plots } from './panels/plots';
import type { RunFacts } from './panels/run_facts';
import type { Transport } from './panels/transport';
import type { Item } from './scene/view';
import { Horizon } from './state/horizon';
import { Pace } from './state/pace';
import type { Stage } from './stage';

export interface Tellers {
  what: HTMLElement; // the line that says what runs
  facts: RunFacts;
  plots: Plots;
  events: EventsList;
  transport: Transport;
  notice: Notice;
}

const everyMs = 250; // the longer the runs are, the more work

export class Told {
  readonly horizon = new Horizon();
  private readonly pace = new Pace(everyMs);

  constructor(private readonly runs: OpenRuns, private readonly to: Tellers, private readonly selection: () => Item | null) {}

  /** Something is new: it is told when there is time. */
  want(): void { this.pace.want(); }
  /** Once per picture; true: it has been told. */
  due(nowMs: number): boolean {
    if (!this.pace.due(nowMs)) return false;
    this.tell();
    return true;
  }

  tell(): void {
    this.horizon.tell();
    this.series();
    this.listEvents();
  }

  headers(): void {
    const { headers, stages } = this.runs;
    const names = [...new Set(headers.map(({ name }) => name))];
    const seeds = [...new Set(headers.map(({ seed }) => seed))];
    setText(this.to.what, headers.length === 0 ? '' : `${names.join(', ')} · ${seeds.length > 1 ? 'seeds' : 'seed'} ${seeds.join(', ')}`);
    document.title = headers.length === 0 ? 'Banyan' : `${headers[0].name} – Banyan`;
    this.to.facts.update(headers);
    this.to.notice.warn(headers.flatMap((header) => header.warnings), stages);
    this.want(); // events are in the configuration, too
  }

  private series(): void {
    const stages = this.runs.stages.filter(({ source }) => source.series.value.time_s !== undefined);
    this.to.plots.setRuns({
      tables: stages.map((stage) => this.rows(stage)), robots: this.robotSeries(), marks: stages.map((stage) => this.runs.stages.indexOf(stage)),
      fields: [...new Set(this.runs.stages.flatMap(({ robotSeries }) => robotSeries.fields))],
    });
  }

  /** A recording has happened; of a live run, what has been seen. */
  rows({ live, source }: Stage): Series {
    return live ? this.horizon.rows(source.series.value) : source.series.value;
  }

  /** Of the selected robot in each run, as far as it is there; what is missing is asked for, if a plot shows it. */
  robotSeries(): Series[] {
    const selection = this.selection();
    const { wanted } = this.to.plots;
    if (selection?.kind !== 'robot' || !wanted.robot) return [];
    return this.runs.stages.map(({ robotSeries, source, live }) => {
      const toS = live ? Math.min(this.horizon.timeS, source.endS) : source.endS;
      robotSeries.gather(selection.index, toS, wanted.said).then((more) => { if (more) this.want(); }, () => {}); // a source that is lost says so itself
      return robotSeries.value;
    });
  }

  /** What the frames tell and what was done, in order of time. */
  events(): ListedEvent[] {
    const all = (stage: Stage) => {
      const deeds = stage.deedEvents;
      const told = stage.source.events.value;
      const sorted = deeds.length === 0 ? [...told] : [...deeds, ...told].sort(byTime);
      return stage.live ? this.horizon.events(sorted) : sorted;
    };
    const { stages, names } = this.runs;
    if (stages.length < 2) return stages.flatMap(all);
    return stages.flatMap((stage, k) => all(stage).map((event) => ({ ...event, run: names[k] }))).sort(byTime);
  }

  private listEvents(): void {
    const events = this.events();
    this.to.transport.setEvents(events);
    this.to.events.setEvents(events);
  }

  /** As files, under names of their own; of the selected robot too, if a plot is of it. */
  tables(): { name: string; series: Series }[] {
    const stages = this.runs.stages.filter(({ source }) => source.series.value.time_s !== undefined);
    const names = apart(stages.map(({ source }) => `${source.header.value?.name ?? 'run'}`), stages.map(({ source }) => source.settingAt(0)?.algorithm ?? ''));
    const selection = this.selection();
    const robot = selection?.kind === 'robot' && this.to.plots.wanted.robot ? selection.index : null;
    return stages.flatMap((stage, k) => [
      { name: names[k], series: this.rows(stage) },
      ...(robot === null ? [] : [{ name: `${names[k]}-robot-${robot}`, series: stage.robotSeries.value }]),
    ]);
  }

  /** Where the timeline ends. */
  get endS(): number {
    return Math.max(0, ...this.runs.stages.map(({ live, source }) => (live ? Math.min(this.horizon.timeS, source.endS) : source.endS)));
  }
}

const byTime = (a: RunEvent, b: RunEvent) => a.time_s - b.time_s;
