// SPDX-License-Identifier: MIT
// One run in the picture: its source, its camera, and what the pointer does there. Two stages stand side by
// side when runs are compared; what they share (clock, selection, switches) is the page's.
import { h, setText } from './dom';
import type { Frame, Setting } from './frame';
import { firstMarks, Legend } from './panels/legend';
import { boundsOf } from './scene/bounds';
import { fitted, following, followShare, panned, resized, toPx, toWorld, zoomedAt, type Bounds, type Camera, type Spot } from './scene/camera';
import type { Facts } from './scene/facts';
import { Input, type Mode } from './scene/input';
import { gripAt, itemAt, pointerReachPx, robotsIn, touchReachPx } from './scene/picking';
import { Scene } from './scene/picture';
import type { Theme } from './scene/themes';
import { sameItem, type Item, type SceneView, type Switches } from './scene/view';
import type { Source } from './source/client';
import { column } from './frame';
import { interpolate } from './state/interpolate';

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
  select(item: Item | null): void;
  // Interventions, in all live runs alike.
  moveTarget(target: number, toM: Spot): void;
  moveObstacle(obstacle: number, toM: Spot): void;
  addTarget(atM: Spot): void;
  killArea(area: Bounds): void;
  /** The visitor moved the picture by hand: no robot is followed any more. */
  moved(): void;
  changed(): void; // draw again
}

const fitMarginPx = 44;

export class Stage {
  readonly element: HTMLElement;
  readonly scene: Scene;
  private readonly input: Input;
  private readonly captionText = h('span');
  private readonly caption = h('div', { class: 'caption' }, h('i', { class: 'run-line', 'aria-hidden': 'true' }), this.captionText);
  private readonly legend = new Legend(firstMarks, (mark) => mark); // the words in full are in the help
  private camera: Camera | null = null;
  private touched = false; // the visitor controls the camera; otherwise everything is kept in view
  private hovered: Item | null = null;
  private dragged: { item: Item; toM: Spot } | null = null;
  private area: Bounds | null = null;
  private frame: Frame | null = null; // interpolated
  private own: Frame | undefined; // its memory, used again
  private recorded: Frame | null = null;
  private setting: Setting | null = null;
  private view: SceneView | null = null;
  private lastDrawMs = 0;

  constructor(readonly source: Source, theme: Theme, private readonly actions: StageActions) {
    const picture = h('div', { class: 'picture' });
    this.element = h('div', { class: 'stage' }, picture, this.caption, this.legend.element);
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
      insets: { top: 0, right: 0, bottom: this.legend.element.offsetHeight + 8, left: 0 },
      dragged: this.dragged,
      area: this.area,
    };
  }

  private trails(shared: Shared): readonly Frame[] {
    const every = Math.max(1, Math.round(0.5 / this.source.tickS)); // half a second apart is plenty
    const frames = this.source.framesBetween(shared.timeS - shared.trailS, shared.timeS, shared.stride);
    return frames.filter((f) => f.tick % every === 0 || shared.stride >= every);
  }

  private aim(frame: Frame, setting: Setting, shared: Shared, nowMs: number): void {
    const { widthPx, heightPx } = this.scene;
    const followed = shared.followed;
    if (this.camera && (this.camera.widthPx !== widthPx || this.camera.heightPx !== heightPx)) {
      this.camera = this.touched || followed !== null ? resized(this.camera, widthPx, heightPx) : null;
    }
    this.camera ??= fitted(boundsOf(setting, frame), widthPx, heightPx, fitMarginPx);
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
    this.camera = camera;
    this.touched = true;
    this.actions.changed();
  }

  private showCaption(setting: Setting, frame: Frame): void {
    const alive = column(frame, 'alive');
    let living = 0;
    for (let i = 0; i < frame.robots; ++i) living += alive[i];
    const dead = frame.robots - living;
    const reading = setting.reading === 'corrected' ? '' : ` (${setting.reading})`;
    const { drawn, all } = this.scene.radioLinks;
    const fewer = drawn < all ? ` · the shortest ${drawn} of ${all} links` : '';
    setText(this.captionText, `${setting.algorithm}${reading} · ${living} robots${dead > 0 ? `, ${dead} dead` : ''} · ${frame.targets.x.length} targets${fewer}`);
  }

  private get live(): boolean { return this.source.header.value?.kind === 'live'; }

  private world(atPx: Spot): Spot { return this.camera ? toWorld(this.camera, atPx) : { x: 0, y: 0 }; }

  private rectangle(fromPx: Spot, toPx: Spot): Bounds {
    const a = this.world(fromPx);
    const b = this.world(toPx);
    return { minX: Math.min(a.x, b.x), maxX: Math.max(a.x, b.x), minY: Math.min(a.y, b.y), maxY: Math.max(a.y, b.y) };
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
      pick: (item) => actions.select(item),
      dragStart: (item, atPx) => this.drag({ item, toM: this.world(atPx) }),
      dragMove: (item, atPx) => this.drag({ item, toM: this.world(atPx) }),
      dragEnd: (item, atPx, dropped) => {
        this.drag(null);
        if (!dropped) return;
        if (item.kind === 'target') actions.moveTarget(item.index, this.world(atPx));
        else actions.moveObstacle(item.index, this.world(atPx));
      },
      areaMove: (fromPx, toPx) => this.mark(this.live ? this.rectangle(fromPx, toPx) : null),
      areaEnd: (fromPx, toPx, taken) => {
        this.mark(null);
        if (taken && this.live) actions.killArea(this.rectangle(fromPx, toPx));
      },
      add: (atPx) => { if (this.live) actions.addTarget(this.world(atPx)); },
    };
  }

  private drag(dragged: { item: Item; toM: Spot } | null): void {
    this.dragged = dragged;
    this.actions.changed();
  }

  private mark(area: Bounds | null): void {
    this.area = area;
    this.actions.changed();
  }
}

function positionOf({ kind, index }: Item, frame: Frame, setting: Setting): Spot | null {
  if (kind === 'robot') return index < frame.robots ? { x: column(frame, 'x_m')[index], y: column(frame, 'y_m')[index] } : null;
  if (kind === 'target') return index < frame.targets.x.length ? { x: frame.targets.x[index], y: frame.targets.y[index] } : null;
  const obstacle = setting.obstacles[index];
  if (obstacle === undefined) return null;
  if (!('wall' in obstacle)) return { x: obstacle.center_m[0], y: obstacle.center_m[1] };
  return { x: (obstacle.from_m[0] + obstacle.to_m[0]) / 2, y: (obstacle.from_m[1] + obstacle.to_m[1]) / 2 };
}
