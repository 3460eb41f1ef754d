// SPDX-License-Identifier: MIT
// What a visitor does to live runs, by pointer, by keys or by the panel: it becomes interventions, in all runs alike, and
// can be undone and done again.
import type { LivePanel, Tool } from './panels/live';
import type { Notice } from './panels/notice';
import { PlaceCursor, type PlaceTask } from './place_cursor';
import type { Bounds, Spot } from './scene/camera';
import type { Item } from './scene/view';
import type { Source } from './source/client';
import { Problem } from './source/problem';
import type { Intervention } from './source/protocol';
import type { Controls } from './state/controls';
import { tickAt, type Player } from './state/player';
import { between, type Stage } from './stage';

/** What it needs of the page. */
export interface Interfered {
  /** The live runs; there may be recordings beside them. */
  readonly liveStages: readonly Stage[];
  readonly selection: Item | null;
  select(item: Item | null): void;
  draw(): void;
}

const words: Record<Exclude<Tool, 'look'>, string> = {
  add_target: 'Click where the new target is to be; or arrows, then Enter.',
  add_obstacle: 'Click where the new obstacle is to be, or draw it from its middle; or arrows, then Enter twice.',
  kill_area: 'Draw a rectangle around the robots that are to die; or arrows, then Enter at two corners.',
};
const modes = { look: 'look', add_target: 'add', add_obstacle: 'disc', kill_area: 'area' } as const;

/** Of an obstacle that was not drawn: an eighth of the range hides robots and leaves ways around it. */
const usualShare = 1 / 8;
const leastRadiusM = 0.01;

export class Interference {
  private hinted = false; // how to use a tool is shown

  constructor(
    private readonly page: Interfered, private readonly player: Player, private readonly controls: Controls,
    private readonly panel: LivePanel, private readonly notice: Notice,
  ) {}

  private get isLive(): boolean { return this.page.liveStages.length > 0; }

  setTool(tool: Tool): void {
    const wanted = this.isLive ? tool : 'look';
    this.panel.setTool(wanted);
    for (const stage of this.page.liveStages) stage.setMode(modes[wanted]);
    if (this.hinted) this.notice.hide(); // it has been done, or is not wanted
    this.hinted = wanted !== 'look';
    if (wanted === 'look') return this.places.stop();
    this.places.start({ kind: wanted });
    this.notice.good(words[wanted]);
  }

  intervene(events: Intervention[]): void { this.act(() => events); }

  move(item: Item, toM: Spot): void {
    if (item.kind === 'target') this.intervene([{ kind: 'move_target', target: item.index, position_m: place(toM) }]);
    if (item.kind === 'obstacle') this.intervene([{ kind: 'move_obstacle', obstacle: item.index, position_m: place(toM) }]);
  }

  addTarget(atM: Spot): void {
    this.setTool('look');
    this.intervene([{ kind: 'add_target', position_m: place(atM) }]);
  }

  /** `edgeM`: where its edge was drawn to; at the middle: it was not drawn. */
  addObstacle(atM: Spot, edgeM: Spot): void {
    this.setTool('look');
    const drawnM = Math.hypot(edgeM.x - atM.x, edgeM.y - atM.y);
    const usualM = usualShare * (this.page.liveStages[0]?.source.settingAt(this.player.timeS)?.range_m ?? 2);
    this.intervene([{ kind: 'add_obstacle', position_m: place(atM), radius_m: rounded(drawnM < leastRadiusM ? usualM : drawnM) }]);
  }

  killArea(area: Bounds): void {
    this.setTool('look');
    this.act((stage) => stage.robotsIn(area).map((robot) => ({ kind: 'die', robot })));
  }

  /** A robot dies; a target or an obstacle is no more. */
  removeSelected(): void {
    const { selection } = this.page;
    if (!this.isLive) return;
    if (selection === null) return this.notice.good('Select a target or an obstacle first: click it, or Shift+N.');
    const { kind, index } = selection;
    if (kind === 'robot') return this.intervene([{ kind: 'die', robot: index }]);
    if (kind === 'target') return this.intervene([{ kind: 'remove_target', target: index }]);
    this.intervene([{ kind: 'remove_obstacle', obstacle: index }]);
    this.page.select(null); // its number is another's now
  }

  /** The selected target or obstacle is moved by keys. */
  grab(): void {
    const { selection } = this.page;
    if (!this.isLive) return;
    if (selection === null || selection.kind === 'robot') return this.notice.good('Select a target or an obstacle first: click it, or Shift+N.');
    this.notice.good(`Move ${selection.kind === 'target' ? `target T${selection.index}` : `obstacle ${selection.index}`} by the arrow keys, then Enter.`);
    this.places.start({ kind: 'move', item: selection });
  }

  /** Whether the key was meant for a place that is being chosen. */
  key(key: string, shift: boolean): boolean { return this.places.key(key, shift); }

  /** The connector that most others hang on. */
  killRelay(): void {
    const relay = this.page.liveStages[0]?.busiestRelay() ?? null;
    if (relay === null) return this.notice.good('There is no connector yet: let it play for some seconds.');
    this.page.select({ kind: 'robot', index: relay });
    this.intervene([{ kind: 'die', robot: relay }]);
    this.player.play();
  }

  /** Back to the start, without the interventions. */
  reset(): void {
    this.player.home();
    this.controls.forget();
    for (const { source } of this.page.liveStages) this.change(source, source.reset());
    this.page.draw();
  }

  undo(): void {
    this.again((source) => source.undo(), 'Nothing has been done that could be undone.');
  }

  redo(): void {
    this.again(async (source) => {
      const tick = await source.redo();
      if (tick !== null) this.player.goOnTo((tick + 1) * source.tickS); // where it is seen
      return tick;
    }, 'Nothing has been undone that could be done again.');
  }

  private again(ask: (source: Source) => Promise<number | null>, nothing: string): void {
    if (!this.isLive) return;
    this.controls.forget();
    for (const { source } of this.page.liveStages) {
      this.change(source, ask(source).then((tick) => { if (tick === null) this.notice.good(nothing); }));
    }
    this.page.draw();
  }

  /** Applies each run's own interventions. If the clock stands still, it moves on until they are seen. */
  private act(eventsFor: (stage: Stage) => Intervention[]): void {
    if (!this.isLive) return;
    const { timeS } = this.player;
    for (const stage of this.page.liveStages) {
      const { source } = stage;
      const events = eventsFor(stage);
      if (events.length === 0) continue;
      const tick = tickAt(timeS, source);
      this.controls.ask(events, tick, source.tickS);
      this.change(source, source.intervene(tick, events));
      this.player.goOnTo((tick + 1) * source.tickS);
    }
    this.page.draw();
  }

  /** Says what went wrong, unless another run is shown by then. */
  private change(source: Source, done: Promise<void>): void {
    done.catch((problem: unknown) => {
      if (!this.page.liveStages.some((stage) => stage.source === source)) return;
      this.controls.forget();
      const text = problem instanceof Error ? problem.message : String(problem);
      this.notice.bad([text, ...(problem instanceof Problem ? problem.problems : [])].join('\n'));
      this.page.draw();
    });
  }

  private readonly places = new PlaceCursor({
    begin: (task) => {
      const [stage] = this.page.liveStages;
      return (task.kind === 'move' ? stage?.worldPlaceOf(task.item) : stage?.middle) ?? null;
    },
    metresPerPx: () => this.page.liveStages[0]?.metresPerPx ?? 0,
    show: (at, task, corner) => { for (const stage of this.page.liveStages) stage.showCursor(at, task, corner); },
    take: (task, at, corner) => this.take(task, at, corner),
  });

  private take(task: PlaceTask, at: Spot, corner: Spot | null): void {
    this.setTool('look');
    if (task.kind === 'move') this.move(task.item, at);
    if (task.kind === 'add_target') this.addTarget(at);
    if (task.kind === 'kill_area' && corner !== null) this.killArea(between(at, corner));
    if (task.kind === 'add_obstacle' && corner !== null) this.addObstacle(corner, at);
  }
}

const rounded = (m: number) => Math.round(m * 1000) / 1000;
/** Millimetres are enough, and read well in a saved scenario. */
const place = (at: Spot): [number, number] => [rounded(at.x), rounded(at.y)];
