// SPDX-License-Identifier: MIT
// The page and its address: what it asks for is opened, and what is shown can be written into it.
import { askScenarios, askServer } from './files';
import { longestLink, readLink, writeLink, type Experiment } from './link';
import type { OpenRuns } from './open_runs';
import type { Opener } from './opener';
import { experimentOf } from './origin';
import type { LivePanel } from './panels/live';
import type { Notice } from './panels/notice';
import type { Item } from './scene/view';
import type { Header } from './source/protocol';
import { outcomeOf } from './state/outcome';
import type { Player } from './state/player';

export interface AddressedPage {
  readonly selection: Item | null;
  select(item: Item): void;
  draw(): void;
  saveScenario(): Promise<void>;
}

export class Addresses {
  private written = ''; // the last one that was written here

  constructor(
    private readonly page: AddressedPage, private readonly runs: OpenRuns, private readonly opener: Opener,
    private readonly player: Player, private readonly live: LivePanel, private readonly notice: Notice,
  ) {}

  /** Opens what `banyan view` was given or the address names; otherwise runs a scenario, so that a visitor sees motion at
   *  once. True: it is that visitor's first look. */
  async begin(): Promise<boolean> {
    const [start, scenarios] = await Promise.all([askServer(), askScenarios()]);
    addEventListener('hashchange', () => { if (location.hash !== this.written) void this.open(false); });
    if (scenarios && scenarios.length > 0) this.live.setScenarios(scenarios);
    if (readLink(location.hash) !== null && !start.recording && !start.scenario) {
      await this.open(true);
      return false;
    }
    if (start.recording) {
      await this.opener.address(start.recording.url, start.recording.name, start.recording.size);
      return false;
    }
    if (start.scenario) this.live.setOwn(start.scenario.name, start.scenario.text, start.scenario.overrides);
    if (start.scenario === undefined && await this.open(true)) return false;
    return await this.opener.start(this.live.choice()) && start.scenario === undefined;
  }

  /** What the address says. `instead`: if there is no such scenario, another one. False: it says nothing. */
  private async open(instead: boolean): Promise<boolean> {
    const read = readLink(location.hash);
    if (read === null) return false;
    const { experiment, problems } = read;
    if (!await this.openOne(experiment, problems, instead)) return true;
    for (const other of experiment.beside) {
      const beside = readLink(other);
      if (beside === null) continue;
      problems.push(...beside.problems);
      await this.openOne(beside.experiment, problems, false, true);
    }
    if (experiment.beside.length > 0 && experiment.recording === '') this.live.set(experiment); // of the first, in the panel
    this.lookAt(experiment);
    if (problems.length > 0) this.notice.bad(problems.join('\n'));
    return true;
  }

  /** Whether it is shown. */
  private async openOne(experiment: Experiment, problems: string[], instead: boolean, beside = false): Promise<boolean> {
    const { recording, scenario, acts } = experiment;
    if (recording !== '' && problems.length === 0) return await this.opener.address(recording, nameOf(recording), 0, { beside });
    const found = recording === '' && this.live.set(experiment);
    if (!found) problems.push(`There is no scenario “${scenario}”${instead ? '; this is another one' : ''}.`);
    if (found || instead) return await this.opener.start(this.live.choice(), found ? acts : [], { beside });
    this.notice.bad(problems.join('\n'));
    return false;
  }

  /** The moment, the place and the robot that an address names. */
  private lookAt({ timeS, view, robot }: Experiment): void {
    if (timeS !== null) {
      this.player.pause();
      if (this.player.growing) this.player.goOnTo(timeS);
      else this.player.seek(timeS);
    }
    if (view !== null) for (const stage of this.runs.stages) stage.lookLike(view);
    if (robot !== null) this.page.select({ kind: 'robot', index: robot });
    this.page.draw();
  }

  /** All of what is shown as an address; null: it would be too long, or a file of the visitor's is in it. */
  private link(): string | null {
    const known = this.runs.all.map(({ origin, stage }) => ({ origin, acts: stage.source.header.value?.acts ?? [] }));
    const { selection } = this.page;
    const look = { timeS: this.player.timeS, view: this.runs.stages[0]?.place ?? null, robot: selection?.kind === 'robot' ? selection.index : null };
    const experiment = experimentOf(known, this.longer(this.runs.headers), look);
    const written = experiment === null ? null : writeLink(experiment);
    return written !== null && written.length > longestLink ? null : written;
  }

  /** `banyan run` ends with the mission: what was done after that needs a longer one. */
  private longer(headers: Header[]): string[] {
    const ticks = headers.flatMap(({ acts }) => acts ?? []).map(({ tick }) => tick);
    const lastS = Math.max(-1, ...ticks) * (this.runs.sources[0]?.tickS ?? 0.1);
    const overS = Math.min(...headers.map(({ result }) => outcomeOf(result)?.endS ?? Infinity));
    if (lastS < overS) return [];
    const afterS = 10; // of what that led to
    return ['mission.stop_when_complete=false', `mission.time_limit_s=${Math.ceil(Math.max(this.player.timeS, lastS + afterS))}`];
  }

  async copy(): Promise<void> {
    const written = this.link();
    if (written === null) {
      if (this.runs.all.some(({ origin }) => origin.kind === 'recording')) return this.notice.bad('A recording of yours has no address: send the file.');
      this.notice.good('The address would be too long; the scenario with all that was done is saved as a file instead.');
      return await this.page.saveScenario();
    }
    this.written = written;
    history.replaceState(null, '', written);
    try {
      await navigator.clipboard.writeText(location.href);
      this.notice.good('Copied: the address of this experiment, this moment and this view.');
    } catch {
      this.notice.good('It is in the address bar now, to be copied from there.'); // the clipboard is not allowed
    }
  }
}

const nameOf = (address: string) => address.replace(/[?#].*$/, '').replace(/^.*\//, '') || 'recording';
