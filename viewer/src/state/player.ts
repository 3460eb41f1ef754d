// SPDX-License-Identifier: MIT
// The clock of what is shown. It is driven by requestAnimationFrame's time, handed in, and never runs ahead
// of frames that are not there yet. Several sources side by side share one.
import { Chase } from './chase';

/** What the clock needs of a source (source/client.ts). */
export interface Playable {
  readonly ready: boolean;
  readonly startS: number;
  readonly endS: number;
  readonly growing: boolean;
  readonly following: boolean;
  readonly tickS: number;
  limit(fromS: number, toS: number, stride: number): number;
  prefetch(timeS: number, speed: number, stride: number): void;
}

export const slowest = 1 / 4;
export const fastest = 64;
const suitedS = 300;
const longestStepMs = 250; // a page in the background gets no frames; it does not leap afterwards
const shownPerS = 20; // frames of the run that are worth showing, per second
const slack = 1e-9;
const comfortWallS = 0.15; // of playing that a live run is ahead of the clock where it keeps up,
const comfortTicks = 4; // or at high speeds so much
const slowestEase = 0.05;
const keptShare = 0.02; // of a new value, per picture: what is read off must not flicker

/** The tick in which the clock of a run stands, or the last one that there is: what the visitor does happens after
 *  it. Not that of the picture, which shows every 32nd tick at high speed. */
export function tickAt(timeS: number, { tickS, endS }: Pick<Playable, 'tickS' | 'endS'>): number {
  return Math.max(0, Math.floor(Math.min(timeS, endS) / tickS + 1e-6));
}

export class Player {
  /** s since the start of the run; what is to be shown now. */
  timeS = 0;
  playing = false;
  speed = 1;
  private chosen = false; // the speed, by the visitor
  /** The frames for `timeS`, or for going on, are not there yet. */
  waiting = false;
  /** Shows the newest moment of a recording that is being written, as fast as it comes. */
  newest = false;
  /** Played again and again; `toS` null: its end has not been chosen yet. */
  loop: { fromS: number; toS: number | null } | null = null;
  private kept = 1;
  private lastMs: number | null = null;
  private backwards = false; // the last jump: what is fetched ahead lies there
  private readonly chase = new Chase();
  private sources: readonly Playable[] = [];

  /** The first call sets the clock to the start. */
  attach(sources: readonly Playable[]): void {
    const first = this.sources.length === 0;
    this.sources = sources;
    if (first) this.timeS = this.startS;
    else this.timeS = this.clamped(this.timeS);
  }

  get startS(): number {
    return this.open.length === 0 ? 0 : Math.min(...this.open.map((s) => s.startS));
  }
  get endS(): number {
    return Math.max(0, ...this.open.map((s) => s.endS));
  }
  get growing(): boolean {
    return this.open.some((s) => s.growing);
  }
  /** There is a newest moment that moves by itself. */
  get following(): boolean {
    return this.open.some((s) => s.following);
  }
  get tickS(): number {
    return this.open.length === 0 ? 0.1 : Math.min(...this.open.map((s) => s.tickS));
  }
  /** The stride of the ticks shown at this speed: a power of two. */
  get stride(): number {
    if (!this.playing) return 1;
    const most = this.pace / (shownPerS * this.tickS);
    return most < 2 ? 1 : 2 ** Math.floor(Math.log2(most));
  }
  /** What is kept of the chosen speed, because a live run does not keep up; 1: all of it. */
  get keptSpeed(): number {
    return this.playing && this.growing ? this.kept : 1;
  }
  /** Seconds of the run per second. */
  private get pace(): number {
    return this.newest ? this.chase.speed : this.speed;
  }
  get atEnd(): boolean {
    return !this.growing && this.timeS >= this.endS - slack;
  }

  /** At the end it starts again. */
  play(): void {
    if (this.atEnd && this.following) return this.follow();
    if (this.atEnd) this.jump(this.startS);
    this.playing = true;
  }
  pause(): void {
    this.playing = this.newest = false;
  }
  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** To the nearest power of two there is. */
  setSpeed(speed: number): void {
    if (!(speed > 0)) return;
    this.newest = false;
    this.chosen = true;
    this.speed = Math.min(fastest, Math.max(slowest, 2 ** Math.round(Math.log2(speed))));
  }
  /** Unless a speed has been chosen: a mission of up to five minutes as it is, a longer one so much faster. */
  suit(limitS: number): void {
    if (!this.chosen) this.speed = Math.min(fastest, 2 ** Math.floor(Math.log2(Math.max(1, limitS / suitedS))));
  }
  faster(): void {
    this.setSpeed(2 * this.speed);
  }
  slower(): void {
    this.setSpeed(this.speed / 2);
  }

  /** From here; then to here; then no more. */
  nextLoop(): void {
    this.newest = false;
    if (this.loop === null) this.loop = { fromS: this.timeS, toS: null };
    else if (this.loop.toS === null && this.timeS > this.loop.fromS + this.tickS) this.loop.toS = this.timeS;
    else this.loop = null;
  }

  seek(timeS: number): void {
    this.newest = false;
    if (Number.isFinite(timeS)) this.jump(this.clamped(timeS));
  }
  home(): void {
    this.newest = false;
    this.jump(this.startS);
  }
  end(): void {
    if (this.following) return this.follow();
    this.jump(this.endS);
    if (!this.growing) this.playing = false;
  }
  /** To the newest moment, and on with it. */
  follow(): void {
    if (!this.following) return;
    this.jump(this.endS);
    this.playing = this.newest = true;
    this.loop = null;
  }
  /** To another tick, and stand still. A live run is simulated for it. */
  step(ticks: number): void {
    this.playing = this.newest = false;
    const tick = ticks > 0 ? Math.floor(this.timeS / this.tickS + 1e-6) : Math.ceil(this.timeS / this.tickS - 1e-6);
    const timeS = (tick + Math.round(ticks)) * this.tickS;
    this.jump(this.growing ? Math.max(this.startS, timeS) : this.clamped(timeS));
  }

  /** Standing still before this moment, on to it. A live run is simulated for it. */
  goOnTo(timeS: number): void {
    if (!this.playing && this.timeS < timeS - slack) this.jump(timeS);
  }

  /** Once per picture; `nowMs` as requestAnimationFrame says it. True: something has changed. */
  frame(nowMs: number): boolean {
    const before = { timeS: this.timeS, playing: this.playing, waiting: this.waiting };
    const elapsedMs = this.lastMs === null ? 0 : Math.min(Math.max(nowMs - this.lastMs, 0), longestStepMs);
    this.lastMs = nowMs;
    if (this.following) this.chase.note(nowMs, this.endS);
    else this.newest = false;
    if (this.open.length > 0) this.advance(elapsedMs / 1000);
    return this.timeS !== before.timeS || this.playing !== before.playing || this.waiting !== before.waiting;
  }

  private get open(): readonly Playable[] {
    return this.sources.filter((source) => source.ready);
  }

  private advance(elapsedS: number): void {
    const { stride } = this;
    let goal = this.playing ? this.goal(elapsedS) : this.timeS;
    if (!this.growing) goal = Math.min(goal, Math.max(this.endS, this.timeS));
    const here = this.reach(this.timeS, this.timeS + slack, stride) >= this.timeS + slack / 2;
    const reached = here && goal > this.timeS ? this.reach(this.timeS, goal, stride) : this.timeS;
    this.waiting = !here || (this.playing && reached < goal - slack);
    if (this.playing) this.backwards = false;
    this.timeS = reached;
    const { loop } = this;
    if (this.playing && loop !== null && loop.toS !== null && (reached >= loop.toS || this.atEnd)) return this.jump(loop.fromS);
    if (this.playing && this.atEnd) this.newest = this.playing = this.following;
    const speed = this.playing ? this.pace : 0;
    for (const source of this.open) source.prefetch(this.timeS, this.backwards ? -1 : speed, stride);
  }

  private goal(elapsedS: number): number {
    return this.newest ? this.chase.next(this.timeS, this.endS, elapsedS) : this.timeS + elapsedS * this.speed * this.ease();
  }

  /** A live run that cannot keep up is shown slower instead of in jerks: the less is ahead, the slower. */
  private ease(): number {
    const aheadS = Math.min(...this.open.filter(({ growing }) => growing).map(({ endS }) => endS - this.timeS));
    const share = Math.min(1, Math.max(slowestEase, aheadS / Math.min(comfortWallS * this.speed, comfortTicks * this.tickS)));
    this.kept += keptShare * (share - this.kept);
    return share;
  }

  /** How far all sources can be shown. */
  private reach(fromS: number, toS: number, stride: number): number {
    return Math.min(...this.open.map((source) => source.limit(fromS, toS, stride)));
  }

  private jump(timeS: number): void {
    this.backwards = timeS < this.timeS;
    this.timeS = timeS;
    this.waiting = true; // until the next frame() says otherwise
  }

  private clamped(timeS: number): number {
    return Math.min(Math.max(timeS, this.startS), this.endS);
  }
}
