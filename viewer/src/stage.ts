// SPDX-License-Identifier: MIT
// One run in the picture: its source, its camera, and what the pointer does there. Up to four stages stand side by
// side when runs are compared; what they share (clock, selection, switches) is the page's.
import { h, setText } from './dom';
import { heldTargets } from './scene/held';
import type { Frame, RunEvent, Setting } from './frame';
import { firstMarks, Legend } from './panels/legend';
import { boundsOf } from './scene/bounds';
import { fitted, following, followShare, panned, resized, toPx, toWorld, zoomedAt, type Bounds, type Camera, type Insets, type Spot } from './scene/camera';
import type { Facts } from './scene/facts';
import { Input, type Mode } from './scene/input';
import { gripAt, itemAt, pointerReachPx, robotsIn, touchReachPx } from './scene/picking';
import { Scene } from './scene/picture';
import { centerOf } from './scene/sight';
import type { Theme } from './scene/themes';
import { sameItem, type Item, type SceneView, type Switches } from './scene/view';
import type { Source } from './source/client';
import { column, roles } from './frame';
import type { Shown } from './panels/keep';
import type { Part } from './panels/tour';
import type { PlaceTask } from './place_cursor';
import { Deeds } from './state/deeds';
import { interpolate } from './state/interpolate';
import { outcomeOf } from './state/outcome';
import { RobotSeries } from './state/robot_series';

/** What all stages show alike. */
export interface Shared {
  timeS: number;
  stride: number;
  selection: Item | null;
  followed: number | null;
  switches: Switches;
  theme: Theme;
  trailS: number;
}

export interface StageActions {
  select(stage: Stage, item: Item | null): void;
  // Interventions, in all live runs alike.
  move(item: Item, toM: Spot): void;
  addTarget(atM: Spot): void;
  addObstacle(atM: Spot, edgeM: Spot): void;
  killArea(area: Bounds): void;
  /** The visitor moved the picture by hand: no robot is followed any more. */
  moved(): void;
  /** The visitor looks elsewhere; runs side by side show the same place. */
  looked(stage: Stage, camera: Camera): void;
  changed(): void; // draw again
}

const fitMarginPx = 28; // a target's number is beside it
const scaleBarPx = 36; // above the legend
const marginShare = 0.08;
const mostTopShare = 0.27;
const mostBottomShare = 0.16;
const captionLinePx = 23; // with its share of what is around
const narrowPx = 480; // where the story takes two lines
const gapPx = 8;
const slowMs = 350; // what takes longer is said

export class Stage {
  readonly element: HTMLElement;
  readonly scene: Scene;
  readonly robotSeries: RobotSeries;
  private readonly input: Input;
  private readonly captionText = h('span');
  private readonly story = h('p', { class: 'story', role: 'status' });
  private readonly caption = h('div', { class: 'caption' },
    h('p', {}, h('i', { class: 'run-line', 'aria-hidden': 'true' }), this.captionText), this.story);
  private readonly busy = h('div', { class: 'busy', role: 'status', hidden: true });
  private waitingSinceMs: number | null = null;
  private readonly legend = new Legend(firstMarks, (mark) => mark); // the words in full are in the help
  private camera: Camera | null = null;
  private touched = false; // the visitor controls the camera; otherwise everything is kept in view
  private hovered: Item | null = null;
  private dragged: { item: Item; toM: Spot } | null = null;
  private area: Bounds | null = null;
  private disc: SceneView['disc'] = null;
  private cursor: Spot | null = null;
  private frame: Frame | null = null; // interpolated
  private own: Frame | undefined; // its memory, used again
  private recorded: Frame | null = null;
  private setting: Setting | null = null;
  private view: SceneView | null = null;
  private lastDrawMs = 0;
  private done = new Deeds('');
  private deedsOf = '';

  constructor(readonly source: Source, theme: Theme, private readonly actions: StageActions) {
    const picture = h('div', { class: 'picture' });
    this.robotSeries = new RobotSeries(source);
    this.element = h('div', { class: 'stage' }, picture, this.caption, this.legend.element, this.busy);
    this.scene = new Scene(picture, theme, () => actions.changed());
    this.scene.canvas.setAttribute('role', 'img');
    this.scene.canvas.setAttribute('aria-label', 'The swarm; press ? for the keys');
    this.input = new Input(picture, this.intentions());
  }

  get shown(): Frame | null { return this.frame; }
  /** The tick that is shown: what the visitor does now happens after it. */
  get tick(): number { return this.recorded?.tick ?? 0; }
  redraw(): void { this.actions.changed(); }
  get recordedFrame(): Frame | null { return this.recorded; }

  /** Where something is on the screen; null if there is no such thing. */
  placeOf(item: Item): Spot | null {
    const { frame, setting, camera } = this;
    const at = frame && setting ? positionOf(item, frame, setting) : null;
    if (at === null || camera === null) return null;
    const box = this.scene.canvas.getBoundingClientRect();
    const px = toPx(camera, at);
    return { x: box.left + px.x, y: box.top + px.y };
  }

  /** The living robots in a rectangle. */
  robotsIn(area: Bounds): number[] { return this.frame === null ? [] : robotsIn(this.frame, area); }

  facts(): Facts | null { return this.view === null ? null : this.scene.facts(this.view); }

  get picture(): Shown {
    const words = [this.captionText.textContent ?? '', this.story.textContent ?? ''];
    const { canvas, widthPx, heightPx } = this.scene;
    const { view } = this;
    return { canvas, words, svg: () => (view === null ? null : { widthPx, heightPx, content: this.scene.svg(view, words) }) };
  }

  /** Marks one of these until the pointer is over something; null: none. */
  point(part: Part | null): void {
    this.hovered = part === null || this.frame === null ? null : itemOf(part, this.frame);
    this.actions.changed();
  }

  /** The living connector with most robots below it in the tree; null: there is none. */
  busiestRelay(): number | null {
    const { facts, frame } = { facts: this.facts(), frame: this.frame };
    if (facts === null || frame === null) return null;
    const role = column(frame, 'role'), alive = column(frame, 'alive');
    const relays = Array.from({ length: frame.robots }, (_, i) => i).filter((i) => role[i] === roles.indexOf('connector') && alive[i] === 1);
    return relays.reduce<number | null>((best, i) => (best === null || facts.subtreeSizes[i] > facts.subtreeSizes[best] ? i : best), null);
  }

  /** Where the visitor has chosen to look; null: at all of it. */
  get place(): Pick<Camera, 'xM' | 'yM' | 'scale'> | null { return this.touched ? this.camera : null; }
  /** In the middle of the picture, m. */
  get middle(): Spot | null { return this.camera === null ? null : { x: this.camera.xM, y: this.camera.yM }; }
  get metresPerPx(): number { return this.camera === null ? 0 : 1 / this.camera.scale; }
  /** In the world, m; null: there is no such thing. */
  worldPlaceOf(item: Item): Spot | null {
    return this.frame && this.setting ? positionOf(item, this.frame, this.setting) : null;
  }
  get obstacles(): number { return this.setting?.obstacles.length ?? 0; }

  /** What is being done by keys: a cross, a thing on its way to it, an area or an obstacle that ends at it. */
  showCursor(at: Spot | null, task: PlaceTask, corner: Spot | null): void {
    this.cursor = at;
    this.dragged = at !== null && task.kind === 'move' ? { item: task.item, toM: at } : null;
    if (task.kind === 'add_obstacle') this.markDisc(corner, at);
    else this.mark(at !== null && corner !== null ? between(at, corner) : null);
  }

  setMode(mode: Mode): void {
    this.input.mode = mode;
    this.scene.canvas.style.cursor = mode === 'look' ? '' : 'crosshair';
  }

  /** Whether anything was under way. */
  cancel(): boolean { return this.input.cancel(); }

  fit(): void {
    this.touched = false;
    this.camera = null;
    this.actions.changed();
  }

  zoom(factor: number): void {
    if (this.camera) this.look(zoomedAt(this.camera, factor, { x: this.camera.widthPx / 2, y: this.camera.heightPx / 2 }));
  }

  /** In shares of the picture. */
  pan(dx: number, dy: number): void {
    if (this.camera) this.look(panned(this.camera, -dx * this.camera.widthPx, -dy * this.camera.heightPx));
    this.actions.moved();
  }

  /** False: the frames of this time are not there yet, and the last picture stays. */
  draw(shared: Shared, nowMs: number): boolean {
    this.legend.show(shared.theme);
    const pair = this.source.pair(shared.timeS, shared.stride);
    const there = pair !== null;
    if (pair) {
      this.recorded = pair.before;
      this.frame = this.own = interpolate(pair.before, pair.after, shared.timeS, this.own);
      this.setting = this.source.settingAt(pair.before.timeS);
    }
    const { frame, setting } = this;
    if (frame === null || setting === null || this.scene.widthPx === 0) return there;
    this.aim(frame, setting, shared, nowMs);
    this.view = this.makeView(frame, setting, shared);
    this.scene.draw(this.view);
    this.showCaption(setting, frame);
    return there;
  }

  dispose(): void {
    this.input.dispose();
    this.scene.dispose();
    this.source.close();
    this.element.remove();
  }

  private makeView(frame: Frame, setting: Setting, shared: Shared): SceneView {
    return {
      frame,
      recorded: this.recorded ?? undefined,
      setting,
      trails: shared.switches.trails ? this.trails(shared) : [],
      selection: shared.selection,
      hovered: this.hovered,
      switches: shared.switches,
      camera: this.camera!,
      theme: shared.theme,
      insets: { top: 0, right: 0, bottom: this.legend.element.offsetHeight + gapPx, left: 0 },
      dragged: this.dragged,
      area: this.area,
      disc: this.disc,
      cursor: this.cursor,
    };
  }

  private trails(shared: Shared): readonly Frame[] {
    const every = Math.max(1, Math.round(0.5 / this.source.tickS)); // half a second apart is plenty
    const frames = this.source.framesBetween(shared.timeS - shared.trailS, shared.timeS, shared.stride);
    return frames.filter((f) => f.tick % every === 0 || shared.stride >= every);
  }

  /** What caption, legend and scale bar cover; in a low picture they may cover a little, or nothing else would fit. */
  private insets(): Insets {
    const { caption, legend } = this;
    const lines = this.scene.widthPx < narrowPx ? 3 : 2; // it has no words yet when the first picture is drawn
    const { heightPx } = this.scene;
    return {
      top: Math.min(Math.max(caption.offsetTop + caption.offsetHeight, captionLinePx * lines), mostTopShare * heightPx), right: 0, left: 0,
      bottom: Math.min(legend.element.offsetHeight + gapPx + scaleBarPx, mostBottomShare * heightPx),
    };
  }

  private aim(frame: Frame, setting: Setting, shared: Shared, nowMs: number): void {
    const { widthPx, heightPx } = this.scene;
    const followed = shared.followed;
    if (this.camera && (this.camera.widthPx !== widthPx || this.camera.heightPx !== heightPx)) {
      this.camera = this.touched || followed !== null ? resized(this.camera, widthPx, heightPx) : null;
    }
    this.camera ??= fitted(boundsOf(setting, frame), widthPx, heightPx, Math.min(fitMarginPx, marginShare * heightPx), this.insets());
    if (followed !== null && followed < frame.robots) {
      const at = { x: column(frame, 'x_m')[followed], y: column(frame, 'y_m')[followed] };
      const share = followShare(Math.min(0.1, Math.max(0, nowMs - this.lastDrawMs) / 1000));
      this.camera = following(this.camera, at, share);
      const away = Math.hypot(this.camera.xM - at.x, this.camera.yM - at.y) * this.camera.scale;
      if (away > 0.5) this.actions.changed();
    }
    this.lastDrawMs = nowMs;
  }

  private look(camera: Camera): void {
    this.lookLike(camera);
    this.actions.looked(this, camera);
  }

  /** At the same place, as large. */
  lookLike({ xM, yM, scale }: Pick<Camera, 'xM' | 'yM' | 'scale'>): void {
    const { widthPx, heightPx } = this.scene;
    this.camera = { xM, yM, scale, widthPx, heightPx };
    this.touched = true;
    this.actions.changed();
  }

  /** The picture is older than the moment that is chosen; said only if that lasts. */
  showWaiting(waiting: boolean, timeS: number, nowMs: number): void {
    this.waitingSinceMs = waiting ? (this.waitingSinceMs ?? nowMs) : null;
    const said = this.waitingSinceMs !== null && nowMs - this.waitingSinceMs > slowMs;
    this.busy.hidden = !said;
    if (said) setText(this.busy, this.live ? `Simulating up to ${timeS.toFixed(1)} s …` : 'Loading …');
  }

  private showCaption(setting: Setting, frame: Frame): void {
    const alive = column(frame, 'alive');
    let living = 0;
    for (let i = 0; i < frame.robots; ++i) living += alive[i];
    const dead = frame.robots - living;
    const reading = setting.reading === 'corrected' ? '' : ` (${setting.reading})`;
    const { drawn, all, about } = this.scene.radioLinks;
    const deeds = this.deeds();
    const loss = deeds.lossAt(frame.timeS);
    setText(this.captionText, [
      `${setting.algorithm}${reading}`,
      `${living} robots${dead > 0 ? `, ${dead} dead` : ''}`,
      `${frame.targets.x.length} targets`,
      ...(loss > 0 ? [`${Math.round(1000 * loss) / 10} % loss`] : []),
      ...(setting.line_of_sight ? ['line of sight'] : []),
      ...(deeds.isBlackoutAt(frame.timeS) ? ['blackout'] : []),
      ...(drawn < all ? [`the shortest ${drawn} of ${about ? `about ${Number(all.toPrecision(2))}` : all} links`] : []),
    ].join(' · '));
    this.showStory(setting, frame, living);
  }

  /** The goal and how far it is, and in the end how it went. */
  private showStory(setting: Setting, frame: Frame, living: number): void {
    const outcome = outcomeOf(this.source.header.value?.result ?? {});
    const over = outcome !== null && frame.timeS >= outcome.endS - 1e-6;
    const { held, wanted } = heldTargets(frame, setting.target_tolerance_m);
    const state = over ? (outcome.good ? 'good' : 'bad') : living === 0 ? 'bad' : '';
    if (this.story.dataset.state !== state) this.story.dataset.state = state;
    if (over) setText(this.story, [outcome.headline, ...outcome.details].join(' · '));
    else if (living === 0) setText(this.story, 'All robots have died: nothing more will happen');
    else setText(this.story, `${held} of ${wanted} ${wanted === 1 ? 'target' : 'targets'} held by a worker`);
  }

  /** Of the configuration as it is now: it lists what a visitor has done. */
  private deeds(): Deeds {
    const config = this.source.header.value?.config ?? '';
    if (config !== this.deedsOf) {
      this.deedsOf = config;
      this.done = new Deeds(config);
    }
    return this.done;
  }

  /** What was done to the radio, as events. */
  get deedEvents(): readonly RunEvent[] { return this.deeds().events; }
  lossAt(timeS: number): number { return this.deeds().lossAt(timeS); }

  get live(): boolean { return this.source.header.value?.kind === 'live'; }

  private world(atPx: Spot): Spot { return this.camera ? toWorld(this.camera, atPx) : { x: 0, y: 0 }; }

  private rectangle(fromPx: Spot, toPx: Spot): Bounds {
    return between(this.world(fromPx), this.world(toPx));
  }

  private intentions(): ConstructorParameters<typeof Input>[1] {
    const { actions } = this;
    return {
      itemAt: (atPx, touch) =>
        this.frame && this.setting && this.camera
          ? itemAt(this.frame, this.setting, this.camera, atPx, touch ? touchReachPx : pointerReachPx) : null,
      gripAt: (atPx, touch) =>
        this.live && this.frame && this.setting && this.camera
          ? gripAt(this.frame, this.setting, this.camera, atPx, touch ? touchReachPx : pointerReachPx) : null,
      pan: (dx, dy) => {
        if (this.camera) this.look(panned(this.camera, dx, dy));
        actions.moved();
      },
      zoom: (factor, atPx) => { if (this.camera) this.look(zoomedAt(this.camera, factor, atPx)); },
      hover: (item) => {
        if (sameItem(item, this.hovered)) return;
        this.hovered = item;
        if (this.input.mode === 'look') {
          const grab = item !== null && this.live && item.kind !== 'robot';
          this.scene.canvas.style.cursor = grab ? 'grab' : item ? 'pointer' : '';
        }
        actions.changed();
      },
      pick: (item) => actions.select(this, item),
      dragStart: (item, atPx) => this.drag({ item, toM: this.world(atPx) }),
      dragMove: (item, atPx) => this.drag({ item, toM: this.world(atPx) }),
      dragEnd: (item, atPx, dropped) => {
        this.drag(null);
        if (!dropped) return;
        actions.move(item, this.world(atPx));
      },
      areaMove: (fromPx, toPx) => {
        if (!this.live) return;
        if (this.input.mode === 'disc') this.markDisc(this.world(fromPx), this.world(toPx));
        else this.mark(this.rectangle(fromPx, toPx));
      },
      areaEnd: (fromPx, toPx, taken) => {
        this.mark(null);
        this.markDisc(null, null);
        if (!taken || !this.live) return;
        if (this.input.mode === 'disc') actions.addObstacle(this.world(fromPx), this.world(toPx));
        else actions.killArea(this.rectangle(fromPx, toPx));
      },
      add: (atPx) => { if (this.live) actions.addTarget(this.world(atPx)); },
    };
  }

  private drag(dragged: { item: Item; toM: Spot } | null): void {
    this.dragged = dragged;
    this.actions.changed();
  }

  private markDisc(at: Spot | null, edge: Spot | null): void {
    this.disc = at !== null && edge !== null ? { at, radiusM: Math.hypot(edge.x - at.x, edge.y - at.y) } : null;
    this.actions.changed();
  }

  private mark(area: Bounds | null): void {
    this.area = area;
    this.actions.changed();
  }
}

/** One of the kind: the first target, or the first living robot of the role. */
function itemOf(part: Part, frame: Frame): Item | null {
  if (part === 'target') return frame.targets.x.length > 0 ? { kind: 'target', index: 0 } : null;
  const role = column(frame, 'role'), alive = column(frame, 'alive');
  const index = role.findIndex((r, i) => r === roles.indexOf(part) && alive[i] === 1);
  return index < 0 ? null : { kind: 'robot', index };
}

/** The rectangle with these corners. */
export function between(a: Spot, b: Spot): Bounds {
  return { minX: Math.min(a.x, b.x), maxX: Math.max(a.x, b.x), minY: Math.min(a.y, b.y), maxY: Math.max(a.y, b.y) };
}

function positionOf({ kind, index }: Item, frame: Frame, setting: Setting): Spot | null {
  if (kind === 'robot') return index < frame.robots ? { x: column(frame, 'x_m')[index], y: column(frame, 'y_m')[index] } : null;
  if (kind === 'target') return index < frame.targets.x.length ? { x: frame.targets.x[index], y: frame.targets.y[index] } : null;
  const obstacle = setting.obstacles[index];
  if (obstacle === undefined) return null;
  const [x, y] = centerOf(obstacle);
  return { x, y };
}
