// SPDX-License-Identifier: MIT
// The page: which runs are open, and the way from what a visitor does to what is shown. Sources bring
// frames, the player chooses the moment, stages and panels show it; nothing here draws or computes.
import { button, download, h, setText } from './dom';
import { acceptDrops, apart, askScenarios, askServer, chooseFile, judge } from './files';
import type { RunEvent, Series } from './frame';
import { Interference } from './interference';
import { Keyboard } from './keyboard';
import { longestLink, nothing, readLink, writeLink, type Experiment } from './link';
import { EventsList, type ListedEvent } from './panels/events_list';
import { Help } from './panels/help';
import { Inspector } from './panels/inspector';
import { Keep } from './panels/keep';
import { LivePanel, type LiveChoice } from './panels/live';
import { logo } from './panels/logo';
import { Notice } from './panels/notice';
import { Plots } from './panels/plots';
import { RunFacts } from './panels/run_facts';
import { SwitchPanel } from './panels/switches';
import { Tabs } from './panels/tabs';
import { Tour } from './panels/tour';
import { Why } from './panels/why';
import { Transport, type Clock } from './panels/transport';
import type { Spot } from './scene/camera';
import { themes } from './scene/themes';
import { sameItem, type Item } from './scene/view';
import type { Source } from './source/client';
import { openFile, openLive, openUrl } from './source/open';
import { Problem } from './source/problem';
import type { Act, Header } from './source/protocol';
import { Controls } from './state/controls';
import { Horizon } from './state/horizon';
import { outcomeOf } from './state/outcome';
import { Pace } from './state/pace';
import { Player } from './state/player';
import { eventAfter } from './state/events';
import { Store } from './state/store';
import { RobotWatch } from './robot_watch';
import { mostRuns, namesOf, runsOf } from './runs';
import { Stage, type Shared, type StageActions } from './stage';

const trailS = 10; // how far back trails go
const panelEveryMs = 80; // panels are read, not watched: twelve times a second is enough
const tellEveryMs = 250; // lists and plots cover the whole run: the longer it is, the more work

export class App {
  private readonly store = new Store();
  private readonly player = new Player();
  stages: Stage[] = [];
  private dirty = true;
  private panelsAt = 0;
  private readonly horizon = new Horizon();
  private readonly tables = new Pace(tellEveryMs);
  private readonly controls = new Controls();
  private opening = 0; // counts attempts: a later one makes an earlier one void

  private readonly notice = new Notice();
  private readonly help = new Help(() => this.tour.start());
  private readonly what = h('span', { class: 'what-runs' });
  private readonly loading = h('div', { class: 'loading', role: 'status' }, 'Loading …');
  private readonly stagesElement = h('main', { class: 'stages' }, this.loading);
  private started: { choice: LiveChoice; picked: string } | null = null; // of live runs
  private address = ''; // of a recording that has one
  private written = ''; // the last address that was written here
  private chosen = 0; // the run whose robot the inspector shows
  private readonly plots = new Plots((timeS) => this.seek(timeS), () => this.tables.want());
  private readonly transport = new Transport({
    toggle: () => this.toggle(), seek: (timeS) => this.seek(timeS), step: (ticks) => this.step(ticks),
    loop: () => this.loopOn(), follow: () => this.toEnd(), setSpeed: (speed) => this.setSpeed(speed), jump: (direction) => this.jump(direction),
  });
  private readonly inspector = new Inspector({
    select: (robot) => this.select(robot === null ? null : { kind: 'robot', index: robot }),
    follow: (robot) => this.follow(robot),
    kill: (robot) => this.interference.intervene([{ kind: 'die', robot }]),
  });
  private readonly watch = new RobotWatch(this.inspector);
  private readonly events = new EventsList((event) => {
    this.seek(event.time_s);
    if (event.robot >= 0) this.select({ kind: 'robot', index: event.robot }, false); // the list stays: Why? is in it
  }, (event) => void this.explain(event));
  private readonly why = new Why((timeS, robot) => {
    this.player.pause();
    this.seek(timeS);
    this.select({ kind: 'robot', index: robot });
  });
  private readonly facts = new RunFacts((run) => this.hash(run));
  private readonly live = new LivePanel({
    start: (choice) => void this.startByHand(choice), reset: () => this.interference.reset(),
    undo: () => this.interference.undo(), redo: () => this.interference.redo(), remove: () => this.interference.removeSelected(),
    setTool: (tool) => this.interference.setTool(tool), intervene: (events) => this.interference.intervene(events),
    saveRecording: () => void this.save((source) => source.saveRecording()),
    saveScenario: () => void this.save((source) => source.saveScenario()),
  });
  private readonly switches = new SwitchPanel(this.store, () => this.fit());
  private readonly keep = new Keep({
    pictures: () => this.stages.map((stage) => stage.picture),
    tables: () => this.seenTables(),
    name: () => (this.sources[0]?.header.value?.name ?? 'banyan').replace(/\.[^.]*$/, ''),
  });
  private readonly tour = new Tour({
    point: (part) => { for (const stage of this.stages) stage.point(part); },
    killRelay: () => this.interference.killRelay(),
    compare: () => this.compare(),
    over: () => this.store.set({ toured: true }),
  });
  private readonly interference = new Interference(this, this.player, this.controls, this.live, this.notice);
  private readonly plotsTab = h('div');
  private readonly tabs = new Tabs([
    { name: 'live', title: 'Live', content: this.live.element },
    { name: 'robot', title: 'Robot', content: this.inspector.element },
    { name: 'events', title: 'Events', content: this.events.element, className: 'events-tab' },
    { name: 'plots', title: 'Plots', content: this.plotsTab },
    { name: 'run', title: 'Run', content: h('div', {}, this.keep.element, this.facts.element) },
    { name: 'view', title: 'View', content: this.switches.element },
  ], 'Panels');

  constructor(root: HTMLElement) {
    const page = h('div', { class: 'page' }, this.bar(), this.stagesElement, this.plots.element, this.tabs.element, this.transport.element);
    root.replaceChildren(page, this.help.element, this.why.element);
    this.placePlots(page);
    this.stagesElement.append(this.notice.element, this.tour.element);
    acceptDrops((files) => void this.openFiles(files));
    new Keyboard(this.keys());
    this.store.subscribe(() => this.onStore());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.onStore());
    this.onStore();
    requestAnimationFrame((now) => this.loop(now));
  }

  /** Beside the picture where there is room, else on a tab: a small screen shows the picture and one panel. */
  private placePlots(page: HTMLElement): void {
    const small = matchMedia('(max-width: 760px), (max-height: 480px)');
    const place = () => {
      this.tabs.offer('plots', small.matches);
      if (small.matches) this.plotsTab.append(this.plots.element);
      else page.insertBefore(this.plots.element, this.tabs.element);
    };
    small.addEventListener('change', place);
    place();
  }

  /** Where something is on the screen: for scripts that drive the page, and its tests. */
  place(kind: Item['kind'], index: number, stage = 0): Spot | null {
    return this.stages[stage]?.placeOf({ kind, index }) ?? null;
  }

  /** Opens what `banyan view` was given; otherwise runs a scenario, so that a visitor sees motion at once; unless
   *  that visitor wants as little as possible of it. */
  async begin(): Promise<void> {
    await this.openFirst();
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.pause();
    addEventListener('hashchange', () => void this.openOther());
  }

  private async openFirst(): Promise<void> {
    const [start, scenarios] = await Promise.all([askServer(), askScenarios()]);
    if (scenarios && scenarios.length > 0) this.live.setScenarios(scenarios);
    if (readLink(location.hash) !== null && !start.recording && !start.scenario) return void await this.openLink(true);
    if (start.recording) return void await this.open([openUrl(start.recording.url, start.recording.name, start.recording.size)], false);
    if (start.scenario) {
      this.live.setOwn(start.scenario.name, start.scenario.text, start.scenario.overrides);
      return void await this.startLive(this.live.choice());
    }
    if (await this.openLink(true)) return;
    const shown = await this.startLive(this.live.choice());
    if (shown && !this.store.state.toured) this.tour.start();
  }

  /** The address says something else now. */
  private async openOther(): Promise<void> {
    if (location.hash !== this.written) await this.openLink(false);
  }

  /** What the address says. `instead`: if there is no such scenario, another one. False: it says nothing. */
  private async openLink(instead: boolean): Promise<boolean> {
    const read = readLink(location.hash);
    if (read === null) return false;
    const { experiment, problems } = read;
    if (experiment.recording !== '' && problems.length === 0) {
      const shown = await this.open([openUrl(experiment.recording, nameOfAddress(experiment.recording))], false);
      if (shown) this.address = experiment.recording;
      if (shown) this.lookAt(experiment);
      return true;
    }
    const found = experiment.recording === '' && this.live.set(experiment);
    if (!found && !instead) {
      this.notice.bad([...problems, `There is no scenario “${experiment.scenario}”.`].join('\n'));
      return true;
    }
    const shown = await this.startLive(this.live.choice(), found ? experiment.acts : []);
    if (!shown) return true;
    if (found) this.lookAt(experiment);
    else problems.push(`There is no scenario “${experiment.scenario}”; this is another one.`);
    if (problems.length > 0) this.notice.bad(problems.join('\n'));
    return true;
  }

  /** The moment, the place and the robot that an address names. */
  private lookAt({ timeS, view, robot }: Experiment): void {
    if (timeS !== null) {
      this.player.pause();
      if (this.isLive) this.player.goOnTo(timeS);
      else this.player.seek(timeS);
    }
    if (view !== null) for (const stage of this.stages) stage.lookLike(view);
    if (robot !== null) this.store.set({ selection: { kind: 'robot', index: robot } });
    if (robot !== null) this.tabs.show('robot');
    this.draw();
  }

  /** All of what is shown as an address; null: it would be too long, or it is a file of the visitor's. */
  private link(): string | null {
    const headers = this.sources.flatMap((source) => source.header.value ?? []);
    const view = this.stages[0]?.place ?? null;
    const { selection } = this.store.state;
    const look = { timeS: this.player.timeS, view, robot: selection?.kind === 'robot' ? selection.index : null };
    if (this.started === null) return this.address === '' ? null : writeLink({ ...nothing, recording: this.address, ...look });
    const { choice, picked } = this.started;
    const seeds = choice.seeds.flatMap((seed) => seed ?? []);
    const written = writeLink({
      ...nothing, scenario: picked, name: choice.name, text: picked === '' ? choice.text : '', algorithms: choice.algorithms.filter((a) => a !== '' || choice.algorithms.length > 1),
      seeds, sets: [...choice.overrides, ...this.longer(headers)], acts: headers.map((header) => header.acts ?? []), ...look,
    });
    return written.length > longestLink ? null : written;
  }

  /** `banyan run` ends with the mission: what was done after that needs a longer one. */
  private longer(headers: Header[]): string[] {
    const ticks = headers.flatMap(({ acts }) => acts ?? []).map(({ tick }) => tick);
    const lastS = Math.max(-1, ...ticks) * (this.sources[0]?.tickS ?? 0.1);
    const overS = Math.min(...headers.map(({ result }) => outcomeOf(result)?.endS ?? Infinity));
    if (lastS < overS) return [];
    const afterS = 10; // of what that led to
    return ['mission.stop_when_complete=false', `mission.time_limit_s=${Math.ceil(Math.max(this.player.timeS, lastS + afterS))}`];
  }

  private async copyLink(): Promise<void> {
    const written = this.link();
    if (written === null) {
      if (!this.isLive) return this.notice.bad('A recording of yours has no address: send the file.');
      this.notice.good('The address would be too long; the scenario with all that was done is saved as a file instead.');
      return await this.save((source) => source.saveScenario());
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

  // ---- What is open ----

  /** Recordings side by side, or one scenario. */
  private async openFiles(files: File[]): Promise<void> {
    try {
      const opened = await Promise.all(files.map(judge));
      const recordings = opened.flatMap((o) => ('recording' in o ? [o.recording] : []));
      const scenarios = opened.flatMap((o) => ('scenario' in o ? [o.scenario] : []));
      if (recordings.length > mostRuns) throw new Error(`At most ${mostRuns} recordings stand side by side; these are ${recordings.length}.`);
      if (scenarios.length > 1 || (scenarios.length === 1 && recordings.length > 0)) {
        throw new Error('Open one scenario, or recordings; not both, and not several scenarios.');
      }
      if (recordings.length > 0) return void await this.open(recordings.map(openFile), false);
      this.live.setOwn(scenarios[0].name, scenarios[0].text, []);
      this.tabs.show('live');
      await this.startLive(this.live.choice());
    } catch (problem) {
      this.notice.bad(textOf(problem));
    }
  }

  /** Keys go to the run then: otherwise they would press the same button and start it again. */
  private async startByHand(choice: LiveChoice): Promise<void> {
    const focused = document.activeElement;
    if (await this.startLive(choice) && document.activeElement === focused) this.transport.focus();
  }

  /** Whether it is shown. */
  private async startLive(choice: LiveChoice, acts: Act[][] = []): Promise<boolean> {
    this.live.setProblems([]);
    const { picked } = this.live;
    const sources = runsOf(choice).map((overrides, k) => openLive({ name: choice.name, text: choice.text, overrides, acts: acts[k] ?? [] }));
    const shown = await this.open(sources, true);
    if (shown) this.started = { choice, picked };
    return shown;
  }

  /** Shows the sources once all of them are open; until then, and if one fails, what was there stays. */
  private async open(sources: Source[], live: boolean): Promise<boolean> {
    const attempt = ++this.opening;
    this.loading.hidden = false;
    setText(this.loading, live ? 'Loading the simulation …' : 'Reading the recording …');
    try {
      await Promise.all(sources.map(opened));
    } catch (problem) {
      for (const source of sources) source.close();
      if (attempt === this.opening) this.refused(problem, live);
      return false;
    } finally {
      if (attempt === this.opening) this.loading.hidden = true;
    }
    const wanted = attempt === this.opening;
    if (wanted) this.show(sources, live);
    else for (const source of sources) source.close();
    return wanted;
  }

  private refused(problem: unknown, live: boolean): void {
    const problems = problem instanceof Problem ? problem.problems : [];
    if (live) this.live.setProblems(problems.length > 0 ? [...problems] : [textOf(problem)]);
    if (live) this.tabs.show('live');
    this.notice.bad([textOf(problem), ...(live ? [] : problems)].join('\n'));
  }

  private show(sources: Source[], live: boolean): void {
    for (const stage of this.stages) stage.dispose();
    this.notice.hide();
    this.live.setProblems([]);
    this.interference.setTool('look');
    this.select(null);
    this.chosen = 0;
    this.started = null;
    this.address = '';
    this.stages = sources.map((source) => new Stage(source, this.theme, this.stageActions));
    this.stagesElement.prepend(...this.stages.map((stage) => stage.element));
    this.stagesElement.dataset.runs = String(this.stages.length);
    this.stages.forEach((stage, k) => { stage.element.dataset.run = String(k + 1); });
    for (const source of sources) this.listen(source);
    this.horizon.open(live);
    this.controls.forget();
    this.player.loop = null;
    this.player.attach(sources);
    this.player.home();
    this.player.play();
    this.player.follow(); // what is being written
    this.showHeaders();
    this.showSeries();
    this.showEvents();
    if (!live) this.tabs.show('robot');
  }

  private listen(source: Source): void {
    source.header.subscribe(() => this.showHeaders());
    source.series.subscribe(() => this.tables.want());
    source.events.subscribe(() => this.tables.want());
    source.failure.subscribe((problem) => { if (problem && this.sources.includes(source)) this.notice.bad(problem.message); });
    source.trouble.subscribe((problem) => { if (problem) this.notice.bad(`${problem.message}\nPlay tries again.`); });
    source.arrived.subscribe(() => this.draw());
    source.rewound.subscribe((timeS) => {
      for (const stage of this.stages) if (stage.source === source) stage.robotSeries.cut(timeS);
      this.horizon.cut(timeS);
      this.tell();
    });
  }

  private get sources(): Source[] { return this.stages.map((stage) => stage.source); }
  get isLive(): boolean { return this.sources[0]?.header.value?.kind === 'live'; }

  // ---- What is shown ----

  private loop(nowMs: number): void {
    requestAnimationFrame((now) => this.loop(now));
    if (this.player.frame(nowMs)) this.dirty = true;
    if (this.tables.due(nowMs)) this.tell();
    for (const stage of this.stages) stage.showWaiting(this.player.waiting, this.player.timeS, nowMs);
    if (!this.dirty) return;
    this.dirty = false;
    const shared = this.shared();
    for (const stage of this.stages) stage.draw(shared, nowMs); // what is not there yet will arrive and be drawn
    this.keep.drawn();
    if (this.horizon.see(this.player.timeS) || (!this.player.playing && this.horizon.behind)) this.tables.want();
    this.transport.update(this.clock());
    if (nowMs - this.panelsAt >= panelEveryMs || !this.player.playing) this.showPanels(nowMs);
  }

  private showPanels(nowMs: number): void {
    this.panelsAt = nowMs;
    this.plots.setTime(this.player.timeS);
    this.events.setTime(this.player.timeS);
    const { selection, followed } = this.store.state;
    const stage = this.stages[this.chosen] ?? this.stages[0];
    this.watch.show(stage ?? null, selection?.kind === 'robot' ? selection.index : null, followed, this.isLive, this.chosen, this.namedRuns);
    this.showControls(this.stages[0]?.source ?? null);
  }

  private showControls(source: Source | null): void {
    const { timeS, waiting } = this.player;
    const setting = source?.settingAt(timeS) ?? null;
    if (!this.isLive || setting === null) return this.live.setLive(null);
    const known = { loss: this.stages[0].lossAt(timeS), lineOfSight: setting.line_of_sight };
    this.live.setLive(this.controls.at(timeS, !waiting, known));
  }

  private clock(): Clock {
    const { playing, waiting, speed, timeS, startS, growing, following, newest, loop } = this.player;
    return { playing, waiting, speed, timeS, startS, growing, following, newest, loop, endS: Math.min(this.horizon.timeS, this.player.endS) };
  }

  private shared(): Shared {
    const { timeS, stride } = this.player;
    const { selection, followed, switches } = this.store.state;
    return { timeS, stride, selection, followed, switches, theme: this.theme, trailS };
  }

  draw(): void { this.dirty = true; }

  private showHeaders(): void {
    const headers = this.sources.flatMap((source) => source.header.value ?? []);
    this.what.textContent = headers.length === 0 ? '' : `${headers[0].name} · seed ${headers[0].seed}`;
    document.title = headers.length === 0 ? 'Banyan' : `${headers[0].name} – Banyan`;
    this.facts.update(headers);
    this.notice.warn(headers.flatMap((header) => header.warnings), this.stages);
    this.tables.want(); // events are in the configuration, too
    this.draw();
  }

  private tell(): void {
    this.horizon.tell();
    this.showSeries();
    this.showEvents();
  }

  private showSeries(): void {
    const runs = this.sources.map((source) => source.series.value).filter((s) => s.time_s !== undefined);
    this.plots.setRuns(runs.map((series) => this.horizon.rows(series)), this.robotSeries());
    this.draw();
  }

  /** Of the selected robot in each run, as far as it is there; what is missing is asked for, if a plot shows it. */
  private robotSeries(): Series[] {
    const { selection } = this.store.state;
    if (selection?.kind !== 'robot' || !this.plots.showRobot) return [];
    return this.stages.map(({ robotSeries, source }) => {
      robotSeries.gather(selection.index, Math.min(this.horizon.timeS, source.endS)).then((more) => { if (more) this.tables.want(); }, () => {}); // a source that is lost says so itself
      return robotSeries.value;
    });
  }

  /** What the frames tell and what was done, in order of time. */
  private shownEvents(): ListedEvent[] {
    const all = (stage: Stage) => {
      const deeds = stage.deedEvents;
      const told = stage.source.events.value;
      return this.horizon.events(deeds.length === 0 ? told : [...deeds, ...told].sort(byTime));
    };
    if (this.stages.length < 2) return this.stages.flatMap(all);
    return this.stages.flatMap((stage, k) => all(stage).map((event) => ({ ...event, run: this.runNames[k] }))).sort(byTime);
  }

  /** Of runs side by side: what they differ in. */
  private get runNames(): string[] { return namesOf(this.sources.flatMap((source) => source.header.value ?? [])); }

  private get namedRuns(): { name: string; stage: Stage }[] {
    if (this.stages.length < 2) return [];
    const { runNames } = this;
    return this.stages.map((stage, k) => ({ name: runNames[k] ?? '', stage }));
  }

  private showEvents(): void {
    const events = this.shownEvents();
    this.transport.setEvents(events);
    this.events.setEvents(events);
  }

  // ---- What a visitor does ----

  private toggle(): void {
    for (const source of this.sources) source.retry();
    this.player.toggle();
    this.draw();
  }
  private seek(timeS: number): void { this.player.seek(timeS); this.draw(); }
  private step(ticks: number): void { this.player.step(ticks); this.draw(); }
  private toEnd(): void {
    if (this.isLive) this.player.seek(this.horizon.timeS);
    else this.player.end();
    this.draw();
  }
  private loopOn(): void { this.player.nextLoop(); this.draw(); }
  private setSpeed(speed: number): void { this.player.setSpeed(speed); this.draw(); }
  /** Everything is in the picture then, and stays: nobody is followed. */
  private fit(): void {
    this.follow(null);
    for (const stage of this.stages) stage.fit();
  }

  private changeSpeed(direction: 1 | -1): void {
    if (direction > 0) this.player.faster();
    else this.player.slower();
    this.draw();
  }

  private jump(direction: 1 | -1): void {
    const event = eventAfter(this.shownEvents(), this.player.timeS, direction);
    if (event === null) return;
    this.player.pause();
    this.seek(event.time_s);
    this.notice.good(event.text);
    if (event.robot >= 0) this.select({ kind: 'robot', index: event.robot });
  }

  get selection(): Item | null { return this.store.state.selection; }

  /** `reveal`: its panel comes to the front. */
  select(item: Item | null, reveal = true): void {
    const robots = this.stages[0]?.shown?.robots ?? 0;
    if (item?.kind === 'robot' && item.index >= robots) return this.notice.bad(`There is no robot ${item.index}: they are numbered from 0 to ${robots - 1}.`);
    this.store.set({ selection: item, followed: item?.kind === 'robot' && item.index === this.store.state.followed ? item.index : null });
    if (item?.kind === 'robot' && reveal) this.tabs.show('robot');
    this.tables.want(); // a plot may be of it
  }

  private selectNext(direction: 1 | -1): void {
    const robots = this.stages[0]?.shown?.robots ?? 0;
    if (robots === 0) return;
    const { selection } = this.store.state;
    const now = selection?.kind === 'robot' ? selection.index : direction > 0 ? -1 : 0;
    this.select({ kind: 'robot', index: (now + direction + robots) % robots });
  }

  private follow(robot: number | null): void { this.store.set({ followed: robot }); }

  private async hash(run: number): Promise<string> {
    const { source, tick } = this.stages[run]; // of the moment when it was asked for
    try {
      return `${await source.hash(tick)} at tick ${tick}`;
    } catch (problem) {
      return textOf(problem);
    }
  }

  private async save(ask: (source: Source) => Promise<{ name: string; blob: Blob }>): Promise<void> {
    const { sources } = this;
    try {
      const files = await Promise.all(sources.map(ask));
      const names = apart(files.map(({ name }) => name), sources.map((source) => source.settingAt(0)?.algorithm ?? ''));
      files.forEach(({ blob }, k) => download(names[k], blob));
    } catch (problem) {
      if (sources.every((source) => this.sources.includes(source))) this.notice.bad(textOf(problem));
    }
  }

  private readonly stageActions: StageActions = {
    select: (stage, item) => { this.chosen = this.stages.indexOf(stage); this.select(item); },
    move: (item, toM) => this.interference.move(item, toM),
    addTarget: (atM) => this.interference.addTarget(atM),
    addObstacle: (atM, edgeM) => this.interference.addObstacle(atM, edgeM),
    killArea: (area) => this.interference.killArea(area),
    moved: () => { if (this.store.state.followed !== null) this.follow(null); },
    looked: (from, camera) => { for (const stage of this.stages) if (stage !== from) stage.lookLike(camera); },
    changed: () => this.draw(),
  };

  private async explain(event: ListedEvent): Promise<void> {
    const source = this.sources[Math.max(0, event.run === undefined ? 0 : this.runNames.indexOf(event.run))];
    if (source === undefined) return;
    this.player.pause();
    try {
      await this.why.open(event, {
        frames: (fromS, toS) => source.frames(fromS, toS), message: (robot, tick) => source.message(robot, tick),
        settingAt: (timeS) => source.settingAt(timeS), config: source.header.value?.config ?? '',
        tickS: source.tickS, seenS: Math.min(this.horizon.timeS, source.endS), live: this.isLive,
      });
    } catch (problem) {
      this.notice.bad(textOf(problem));
    }
  }

  private compare(): void {
    this.live.compare('outwards', 'convoy');
    void this.startLive(this.live.choice());
  }

  /** As far as it has been seen. */
  private seenTables(): { name: string; series: Series }[] {
    const { sources } = this;
    const names = apart(sources.map((source) => `${source.header.value?.name ?? 'run'}`), sources.map((source) => source.settingAt(0)?.algorithm ?? ''));
    return sources.flatMap((source, k) => (source.series.value.time_s === undefined ? [] : [{ name: names[k], series: this.horizon.rows(source.series.value) }]));
  }

  private selectNextThing(direction: 1 | -1): void {
    const stage = this.stages[0];
    const things: Item[] = (['target', 'obstacle'] as const).flatMap((kind) =>
      Array.from({ length: kind === 'target' ? stage?.shown?.targets.x.length ?? 0 : stage?.obstacles ?? 0 }, (_, index) => ({ kind, index })));
    if (things.length === 0) return;
    const now = things.findIndex((thing) => sameItem(thing, this.store.state.selection));
    this.select(things[((now < 0 && direction < 0 ? 0 : now) + direction + things.length) % things.length]);
  }

  private release(): void {
    if (this.stages.filter((stage) => stage.cancel()).length > 0) return;
    this.interference.setTool('look');
    this.notice.hide();
    this.select(null);
  }

  private keys(): ConstructorParameters<typeof Keyboard>[0] {
    return {
      toggle: () => this.toggle(), step: (ticks) => this.step(ticks),
      toStart: () => { this.player.home(); this.draw(); }, toEnd: () => this.toEnd(),
      jump: (direction) => this.jump(direction), speed: (direction) => this.changeSpeed(direction),
      pan: (dx, dy) => { for (const stage of this.stages) stage.pan(dx, dy); },
      zoom: (factor) => { for (const stage of this.stages) stage.zoom(factor); },
      fit: () => this.fit(),
      selectNumber: (robot) => this.select({ kind: 'robot', index: robot }), selectNext: (direction) => this.selectNext(direction),
      follow: () => {
        const { selection, followed } = this.store.state;
        if (selection?.kind === 'robot') this.follow(followed === selection.index ? null : selection.index);
      },
      kill: () => this.interference.removeSelected(), switchOn: (name) => this.store.toggle(name),
      loop: () => this.loopOn(), grab: () => this.interference.grab(), selectNextThing: (direction) => this.selectNextThing(direction),
      undo: () => this.interference.undo(), redo: () => this.interference.redo(),
      place: (key, shift) => this.interference.key(key, shift),
      tool: (name) => this.interference.setTool(name), theme: () => this.store.set({ theme: this.theme.name === 'dark' ? 'light' : 'dark' }),
      release: () => this.release(), help: () => this.help.open(this.theme),
    };
  }

  // ---- How it looks ----

  private get theme() {
    const { theme } = this.store.state;
    return theme === 'auto' ? themes[matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'] : themes[theme];
  }

  private onStore(): void {
    const { name } = this.theme;
    if (document.documentElement.dataset.theme !== name) {
      document.documentElement.dataset.theme = name;
      this.plots.restyle();
      this.transport.restyle();
    }
    this.draw();
  }

  private bar(): HTMLElement {
    return h(
      'header', { class: 'bar' },
      h('h1', {}, logo(), 'Banyan'),
      this.what,
      button('Open …', 'A recording (.mcap) or a scenario (.toml); or drop it on the page', () => chooseFile((files) => void this.openFiles(files))),
      button('Copy link', 'The address of this experiment: scenario, seed, what was done, moment and view', () => void this.copyLink()),
      button('◐', 'Light or dark (M)', () => this.store.set({ theme: this.theme.name === 'dark' ? 'light' : 'dark' })),
      button('?', 'Keys and signs (?)', () => this.help.open(this.theme)),
    );
  }
}

const nameOfAddress = (address: string) => address.replace(/[?#].*$/, '').replace(/^.*\//, '') || 'recording';

const byTime = (a: RunEvent, b: RunEvent) => a.time_s - b.time_s;

const textOf = (problem: unknown) => (problem instanceof Error ? problem.message : String(problem));

/** Resolves when a source has told what it holds, rejects with its problem. */
function opened(source: Source): Promise<void> {
  return new Promise((resolve, reject) => {
    if (source.failure.value) return reject(source.failure.value);
    if (source.header.value) return resolve();
    source.header.subscribe(() => resolve());
    source.failure.subscribe((problem) => { if (problem) reject(problem); });
  });
}
