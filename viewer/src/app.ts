// SPDX-License-Identifier: MIT
// The page: strings together what is open (opener.ts, open_runs.ts), what a visitor does to it (interference.ts,
// selecting.ts) and what is told of it (told.ts, panels/). Sources bring frames, the player chooses the moment, stages
// and panels show it; nothing here draws or computes.
import { Addresses } from './addresses';
import { button, download, h } from './dom';
import { acceptDrops, apart, chooseFile } from './files';
import { Interference } from './interference';
import { Keyboard } from './keyboard';
import { OpenRuns } from './open_runs';
import { Opener, type How, type Opened } from './opener';
import { EventsList, type ListedEvent } from './panels/events_list';
import { Help } from './panels/help';
import { Inspectors } from './panels/inspectors';
import { Keep } from './panels/keep';
import { LivePanel, type LiveChoice } from './panels/live';
import { logo } from './panels/logo';
import { Many } from './panels/many';
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
import type { Item } from './scene/view';
import { Selecting } from './selecting';
import type { Source } from './source/client';
import { textOf } from './source/problem';
import { Controls } from './state/controls';
import { Player } from './state/player';
import { eventAfter } from './state/events';
import { Store } from './state/store';
import { Stage, type Shared, type StageActions } from './stage';
import { Told } from './told';

const trailS = 10; // how far back trails go
const panelEveryMs = 80; // panels are read, not watched: twelve times a second is enough

export class App {
  private readonly store = new Store();
  private readonly player = new Player();
  private dirty = true;
  private panelsAt = 0;
  private readonly controls = new Controls();
  private chosen: Stage | null = null; // the run in which a robot was clicked

  private readonly notice = new Notice();
  private readonly help = new Help(() => this.tour.start());
  private readonly what = h('span', { class: 'what-runs' });
  private readonly runs = new OpenRuns((stage) => this.close(stage));
  private readonly plots = new Plots((timeS) => this.seek(timeS), () => this.told.want());
  private readonly transport = new Transport({
    toggle: () => this.toggle(), seek: (timeS) => this.seek(timeS), step: (ticks) => this.step(ticks),
    loop: () => this.loopOn(), follow: () => this.toEnd(), setSpeed: (speed) => this.setSpeed(speed), jump: (direction) => this.jump(direction),
  });
  private readonly selecting = new Selecting({ showRobot: () => this.tabs.show('robot'), selected: () => this.told.want() }, this.runs, this.store, this.notice);
  private readonly inspectors = new Inspectors({
    select: (robot) => this.select(robot === null ? null : { kind: 'robot', index: robot }),
    follow: (robot) => this.selecting.follow(robot),
    kill: (robot) => this.interference.intervene([{ kind: 'die', robot }]),
  }, () => this.draw());
  private readonly events = new EventsList((event) => {
    this.seek(event.time_s);
    if (event.robot >= 0) this.selecting.select({ kind: 'robot', index: event.robot }, false); // the list stays: Why? is in it
  }, (event) => void this.explain(event));
  private readonly why = new Why((timeS, robot) => {
    this.player.pause();
    this.seek(timeS);
    this.select({ kind: 'robot', index: robot });
  });
  private readonly facts = new RunFacts((run) => this.hash(run));
  private readonly live = new LivePanel({
    start: (choice) => void this.startByHand(choice, false), add: (choice) => void this.startByHand(choice, true),
    many: (choice, firstSeed) => { this.player.pause(); this.many.open(choice, firstSeed); },
    reset: () => this.interference.reset(),
    undo: () => this.interference.undo(), redo: () => this.interference.redo(), remove: () => this.interference.removeSelected(),
    setTool: (tool) => this.interference.setTool(tool), intervene: (events) => this.interference.intervene(events),
    saveRecording: () => void this.save((source) => source.saveRecording()),
    saveScenario: () => void this.saveScenario(),
  });
  private readonly switches = new SwitchPanel(this.store, () => this.fit());
  private readonly keep = new Keep({
    pictures: () => this.stages.map((stage) => stage.picture),
    tables: () => this.told.tables(),
    name: () => (this.runs.headers[0]?.name ?? 'banyan').replace(/\.[^.]*$/, ''),
  });
  private readonly tour = new Tour({
    point: (part) => { for (const stage of this.stages) stage.point(part); },
    killRelay: () => this.interference.killRelay(),
    compare: () => this.compare(),
    over: () => this.store.set({ toured: true }),
  });
  private readonly interference = new Interference(this, this.player, this.controls, this.live, this.notice);
  private readonly many = new Many({
    source: (choice, algorithm, seed) => this.opener.aside(choice, algorithm, seed), theme: () => this.theme,
    open: (choice, algorithm, seed) => {
      this.live.narrow(algorithm, seed);
      void this.opener.start({ ...choice, algorithms: [algorithm], seeds: [seed] });
    },
  });
  private readonly opener = new Opener(this, this.live, this.notice);
  private readonly addresses = new Addresses(this, this.runs, this.opener, this.player, this.live, this.notice);
  private readonly told = new Told(this.runs, {
    what: this.what, facts: this.facts, plots: this.plots, events: this.events, transport: this.transport, notice: this.notice,
  }, () => this.selection);
  private readonly plotsTab = h('div');
  private readonly tabs = new Tabs([
    { name: 'live', title: 'Live', content: this.live.element },
    { name: 'robot', title: 'Robot', content: this.inspectors.element },
    { name: 'events', title: 'Events', content: this.events.element, className: 'events-tab' },
    { name: 'plots', title: 'Plots', content: this.plotsTab },
    { name: 'run', title: 'Run', content: h('div', {}, this.keep.element, this.facts.element) },
    { name: 'view', title: 'View', content: this.switches.element },
  ], 'Panels');

  constructor(root: HTMLElement) {
    const page = h('div', { class: 'page' }, this.bar(), this.runs.element, this.plots.element, this.tabs.element, this.transport.element);
    root.replaceChildren(page, this.help.element, this.why.element, this.many.element);
    this.placePlots(page);
    this.runs.element.append(this.opener.loading, this.notice.element, this.tour.element);
    acceptDrops((files, beside) => void this.opener.files(files, { beside }));
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

  get stages(): Stage[] { return this.runs.stages; }
  get liveStages(): Stage[] { return this.runs.live; }
  get shown(): number { return this.runs.all.length; }
  get selection(): Item | null { return this.selecting.item; }
  select(item: Item | null): void { this.selecting.select(item); }
  draw(): void { this.dirty = true; }

  /** Where something is on the screen: for scripts that drive the page, and its tests. */
  place(kind: Item['kind'], index: number, stage = 0): Spot | null {
    return this.stages[stage]?.placeOf({ kind, index }) ?? null;
  }

  /** Whoever wants as little motion as possible starts it by hand. */
  async begin(): Promise<void> {
    const first = await this.addresses.begin();
    if (first && !this.store.state.toured) this.tour.start();
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.pause();
  }

  // ---- What is open ----

  /** Keys go to the run then: otherwise they would press the same button and start it again. */
  private async startByHand(choice: LiveChoice, beside: boolean): Promise<void> {
    const focused = document.activeElement;
    if (await this.opener.start(choice, [], { beside }) && document.activeElement === focused) this.transport.focus();
  }

  private compare(): void {
    this.live.compare('outwards', 'convoy');
    void this.opener.start(this.live.choice());
  }

  showLivePanel(): void { this.tabs.show('live'); }

  /** Another experiment, or one more run of this one at the moment that is shown. */
  show(opened: Opened[], { beside }: How): void {
    this.notice.hide();
    this.live.setProblems([]);
    this.interference.setTool('look');
    if (!beside) this.clear();
    const place = this.stages[0]?.place ?? null;
    for (const { source, origin } of opened) {
      const stage = new Stage(source, this.theme, this.stageActions);
      this.runs.add({ stage, origin });
      if (place !== null) stage.lookLike(place);
      this.listen(source);
    }
    this.told.horizon.open(this.runs.live.length > 0);
    this.player.attach(this.runs.sources);
    if (beside) this.told.horizon.see(this.player.timeS);
    else this.playFromStart();
    this.told.headers();
    this.told.tell();
    if (!beside && this.runs.live.length === 0) this.tabs.show('robot');
    this.draw();
  }

  private clear(): void {
    this.select(null);
    this.chosen = null;
    for (const stage of this.stages) this.runs.remove(stage);
    this.controls.forget();
    this.player.loop = null;
  }

  private playFromStart(): void {
    this.player.home();
    this.player.play();
    this.player.follow(); // what is being written
  }

  /** One of several. */
  private close(stage: Stage): void {
    if (this.stages.length < 2) return;
    if (this.chosen === stage) this.chosen = null;
    this.runs.remove(stage);
    this.player.attach(this.runs.sources);
    this.told.horizon.open(this.runs.live.length > 0);
    this.told.horizon.see(this.player.timeS);
    this.told.headers();
    this.told.tell();
    this.draw();
  }

  private listen(source: Source): void {
    const mine = () => this.runs.has(source); // it may have been closed
    source.header.subscribe((header) => {
      if (!mine()) return;
      if (header !== null) this.player.suit(header.settings[0].setting.time_limit_s);
      this.told.headers();
      this.draw();
    });
    source.series.subscribe(() => this.told.want());
    source.events.subscribe(() => this.told.want());
    source.failure.subscribe((problem) => { if (problem && mine()) this.notice.bad(problem.message); });
    source.trouble.subscribe((problem) => { if (problem && mine()) this.notice.bad(`${problem.message}\nPlay tries again.`); });
    source.arrived.subscribe(() => this.draw());
    source.rewound.subscribe((timeS) => {
      for (const stage of this.stages) if (stage.source === source) stage.robotSeries.cut(timeS);
      this.told.horizon.cut(timeS);
      this.told.tell();
    });
  }

  // ---- What is shown ----

  private loop(nowMs: number): void {
    requestAnimationFrame((now) => this.loop(now));
    if (this.player.frame(nowMs)) this.dirty = true;
    if (this.told.due(nowMs)) this.dirty = true;
    for (const stage of this.stages) stage.showWaiting(this.player.waiting, this.player.timeS, nowMs);
    if (!this.dirty) return;
    this.dirty = false;
    const shared = this.shared();
    for (const stage of this.stages) stage.draw(shared, nowMs); // what is not there yet will arrive and be drawn
    this.keep.drawn();
    const { horizon } = this.told;
    if (horizon.see(this.player.timeS) || (!this.player.playing && horizon.behind)) this.told.want();
    this.transport.update(this.clock());
    if (nowMs - this.panelsAt >= panelEveryMs || !this.player.playing) this.showPanels(nowMs);
  }

  private showPanels(nowMs: number): void {
    this.panelsAt = nowMs;
    this.plots.setTime(this.player.timeS);
    this.events.setTime(this.player.timeS);
    const { selection, followed } = this.store.state;
    const { names } = this.runs;
    const inspected = this.stages.map((stage, k) => ({ name: names[k] ?? '', stage }));
    const chosen = Math.max(0, this.stages.findIndex((stage) => stage === this.chosen));
    this.inspectors.update(inspected, selection?.kind === 'robot' ? selection.index : null, followed, chosen);
    this.showControls(this.liveStages[0]);
  }

  private showControls(stage: Stage | undefined): void {
    const { timeS, waiting } = this.player;
    const setting = stage?.source.settingAt(timeS) ?? null;
    if (stage === undefined || setting === null) return this.live.setLive(null);
    const known = { loss: stage.lossAt(timeS), lineOfSight: setting.line_of_sight };
    this.live.setLive(this.controls.at(timeS, !waiting, known));
  }

  private clock(): Clock {
    const { playing, waiting, speed, keptSpeed, timeS, startS, growing, following, newest, loop } = this.player;
    return { playing, waiting, speed, keptSpeed, timeS, startS, growing, following, newest, loop, endS: this.told.endS };
  }

  private shared(): Shared {
    const { timeS, stride } = this.player;
    const { selection, followed, switches } = this.store.state;
    return { timeS, stride, selection, followed, switches, theme: this.theme, trailS };
  }

  // ---- What a visitor does ----

  private toggle(): void {
    for (const source of this.runs.sources) source.retry();
    this.player.toggle();
    this.draw();
  }
  private seek(timeS: number): void { this.player.seek(timeS); this.draw(); }
  private step(ticks: number): void { this.player.step(ticks); this.draw(); }
  private toEnd(): void {
    if (this.player.growing) this.player.seek(this.told.endS);
    else this.player.end();
    this.draw();
  }
  private loopOn(): void { this.player.nextLoop(); this.draw(); }
  private setSpeed(speed: number): void { this.player.setSpeed(speed); this.draw(); }
  /** Everything is in the picture then, and stays: nobody is followed. */
  private fit(): void {
    this.selecting.follow(null);
    for (const stage of this.stages) stage.fit();
  }

  private changeSpeed(direction: 1 | -1): void {
    if (direction > 0) this.player.faster();
    else this.player.slower();
    this.draw();
  }

  private jump(direction: 1 | -1): void {
    const event = eventAfter(this.told.events(), this.player.timeS, direction);
    if (event === null) return;
    this.player.pause();
    this.seek(event.time_s);
    this.notice.good(event.text);
    if (event.robot >= 0) this.select({ kind: 'robot', index: event.robot });
  }

  private async hash(run: number): Promise<string> {
    const { source, tick } = this.stages[run]; // of the moment when it was asked for
    try {
      return `${await source.hash(tick)} at tick ${tick}`;
    } catch (problem) {
      return textOf(problem);
    }
  }

  async saveScenario(): Promise<void> { await this.save((source) => source.saveScenario()); }

  /** Of the live runs: a recording is a file already. */
  private async save(ask: (source: Source) => Promise<{ name: string; blob: Blob }>): Promise<void> {
    const sources = this.liveStages.map(({ source }) => source);
    try {
      const files = await Promise.all(sources.map(ask));
      const names = apart(files.map(({ name }) => name), sources.map((source) => source.settingAt(0)?.algorithm ?? ''));
      files.forEach(({ blob }, k) => download(names[k], blob));
    } catch (problem) {
      if (sources.every((source) => this.runs.has(source))) this.notice.bad(textOf(problem));
    }
  }

  private readonly stageActions: StageActions = {
    select: (stage, item) => { this.chosen = stage; this.select(item); },
    move: (item, toM) => this.interference.move(item, toM),
    addTarget: (atM) => this.interference.addTarget(atM),
    addObstacle: (atM, edgeM) => this.interference.addObstacle(atM, edgeM),
    killArea: (area) => this.interference.killArea(area),
    moved: () => { if (this.store.state.followed !== null) this.selecting.follow(null); },
    looked: (from, camera) => { for (const stage of this.stages) if (stage !== from) stage.lookLike(camera); },
    changed: () => this.draw(),
  };

  private async explain(event: ListedEvent): Promise<void> {
    const stage = this.stages[Math.max(0, event.run === undefined ? 0 : this.runs.names.indexOf(event.run))];
    if (stage === undefined) return;
    const { source, live } = stage;
    this.player.pause();
    try {
      await this.why.open(event, {
        frames: (fromS, toS) => source.frames(fromS, toS), message: (robot, tick) => source.message(robot, tick),
        settingAt: (timeS) => source.settingAt(timeS), config: source.header.value?.config ?? '',
        tickS: source.tickS, seenS: live ? Math.min(this.told.horizon.timeS, source.endS) : source.endS, live,
      });
    } catch (problem) {
      this.notice.bad(textOf(problem));
    }
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
      selectNumber: (robot) => this.select({ kind: 'robot', index: robot }), selectNext: (direction) => this.selecting.next(direction),
      follow: () => this.selecting.toggleFollow(),
      kill: () => this.interference.removeSelected(), switchOn: (name) => this.store.toggle(name),
      loop: () => this.loopOn(), grab: () => this.interference.grab(), selectNextThing: (direction) => this.selecting.nextThing(direction),
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
      button('Open …', 'Recordings (.mcap) or a scenario (.toml); or drop them on the page', () => chooseFile((files) => void this.opener.files(files))),
      button('Add …', 'The same beside what is shown, up to four; or drop them with Shift', () => chooseFile((files) => void this.opener.files(files, { beside: true }))),
      button('Copy link', 'The address of this experiment: scenarios, seeds, what was done, moment and view', () => void this.addresses.copy()),
      button('◐', 'Light or dark (M)', () => this.store.set({ theme: this.theme.name === 'dark' ? 'light' : 'dark' })),
      button('?', 'Keys and signs (?)', () => this.help.open(this.theme)),
    );
  }
}
