// SPDX-License-Identifier: MIT
// The clock's controls: play, speed, a timeline with the run's events on it. Shows what it is told and
// reports what the visitor does; it keeps no time of its own.
import type { RunEvent } from '../frame';
import { button, h, icon, setText } from '../dom';
import { fastest, slowest } from '../state/player';
import { eventMark } from './event_marks';

export interface Clock {
  playing: boolean;
  waiting: boolean; // for frames that are not there yet
  speed: number; // simulated seconds per second
  keptSpeed: number; // the share of it that a live run keeps up with
  timeS: number;
  startS: number;
  endS: number;
  growing: boolean; // a live run: the end moves
  following: boolean; // a recording that is being written: there is a newest moment,
  newest: boolean; // and it is shown
  loop: { fromS: number; toS: number | null } | null;
}

export interface TransportActions {
  toggle(): void;
  seek(timeS: number): void;
  step(ticks: number): void;
  setSpeed(speed: number): void;
  loop(): void; // begin, end, let go
  follow(): void; // the newest moment
  jump(direction: 1 | -1): void; // to the next or the last notable event
}

const speeds: number[] = [];
for (let speed = slowest; speed <= fastest; speed *= 2) speeds.push(speed);

/** "1:07.3": minutes and seconds with one decimal. */
export function clockText(timeS: number): string {
  const tenths = Math.round(Math.max(0, timeS) * 10);
  const minutes = Math.floor(tenths / 600);
  const rest = tenths - minutes * 600;
  return `${minutes}:${String(Math.floor(rest / 10)).padStart(2, '0')}.${rest % 10}`;
}

/** For what the marks were drawn. */
export interface Drawn {
  width: number; // px
  height: number;
  startS: number;
  endS: number;
}

const worthDrawing = 0.005; // of the timeline

/** Whether marks are in the wrong places. While a live run plays, its end moves with every picture: then they may be
 *  off by less than their distances can be seen. */
export function outdated(drawn: Drawn | null, now: Drawn, playing: boolean): boolean {
  if (drawn === null || drawn.width !== now.width || drawn.height !== now.height || drawn.startS !== now.startS) return true;
  const allowed = playing ? worthDrawing * (now.endS - now.startS) : 0;
  return Math.abs(now.endS - drawn.endS) > allowed;
}

const keepsUp = 0.9;

/** "live", or "0.5×" where it is slower than was chosen. */
function liveText({ speed, keptSpeed }: Pick<Clock, 'speed' | 'keptSpeed'>): string {
  return keptSpeed < keepsUp ? `${Number((speed * keptSpeed).toPrecision(2))}×` : 'live';
}

const loopTitles = { none: 'Loop from here (A)', begun: 'Loop up to here (A)', whole: 'Loop no more (A)' };
const thumb = 7; // px: half of the handle's width, beyond which it does not go
const mostHints = 4;
const hintReachPx = 4;

/** Where a moment is on the timeline. */
function markPx(timeS: number, { startS, endS }: Pick<Clock, 'startS' | 'endS'>, width: number): number {
  return thumb + ((timeS - startS) / (endS - startS)) * (width - 2 * thumb);
}

/** The marked events near a place on the timeline, the nearest first. */
export function eventsNear(events: readonly RunEvent[], clock: Pick<Clock, 'startS' | 'endS'>, x: number, width: number): RunEvent[] {
  if (clock.endS <= clock.startS) return [];
  const away = (event: RunEvent) => Math.abs(markPx(event.time_s, clock, width) - x);
  return events.filter((event) => eventMark(event.kind) !== null && away(event) <= hintReachPx).sort((a, b) => away(a) - away(b));
}

export class Transport {
  readonly element: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly timeline: HTMLInputElement;
  private readonly marks = h('canvas', { class: 'marks', 'aria-hidden': 'true' });
  private readonly hint = h('div', { class: 'timeline-hint', hidden: true });
  private readonly time = h('output', { class: 'time', 'aria-live': 'off' });
  private readonly loop: HTMLButtonElement;
  private readonly range = h('div', { class: 'timeline-loop', 'aria-hidden': 'true', hidden: true });
  private readonly end = h('span', { class: 'time end' });
  private readonly live: HTMLButtonElement;
  private readonly speed: HTMLSelectElement;
  private events: RunEvent[] = [];
  private clock: Clock | null = null;
  private drawn: Drawn | null = null;

  constructor(actions: TransportActions) {
    this.play = button(icon('play'), 'Play', actions.toggle, { class: 'play' });
    this.timeline = h('input', {
      type: 'range', min: 0, max: 1, step: 'any', value: 0, 'aria-label': 'Time',
      oninput: () => actions.seek(Number(this.timeline.value)),
      // The page's keys move the clock, the same wherever the focus is.
      onkeydown: (event: KeyboardEvent) => { if (/^(Arrow|Home|End|Page)/.test(event.key)) event.preventDefault(); },
    });
    this.speed = h(
      'select',
      { title: 'Speed: simulated seconds per second (- and +)', 'aria-label': 'Speed', onchange: () => actions.setSpeed(Number(this.speed.value)) },
      ...speeds.map((s) => h('option', { value: s }, `${s}×`)),
    );
    this.live = button('live', 'Follow the newest moment (End)', actions.follow, { class: 'newest', hidden: true });
    this.loop = button(icon('loop'), loopTitles.none, actions.loop, { class: 'loop' });
    this.element = h(
      'section',
      { class: 'transport', 'aria-label': 'Time' },
      button(icon('last'), 'Last event ([)', () => actions.jump(-1)),
      button(icon('back'), 'One tick back (←)', () => actions.step(-1)),
      this.play,
      button(icon('on'), 'One tick on (→)', () => actions.step(1)),
      button(icon('next'), 'Next event (])', () => actions.jump(1)),
      this.time,
      this.timelineBox(),
      this.end,
      this.live,
      this.loop,
      this.speed,
    );
    new ResizeObserver(() => this.drawMarks(true)).observe(this.marks);
  }

  /** What the marks near the pointer mean. */
  private timelineBox(): HTMLElement {
    const box = h('div', { class: 'timeline' }, this.range, this.marks, this.timeline, this.hint);
    box.addEventListener('pointermove', (event) => {
      const x = event.clientX - this.marks.getBoundingClientRect().left;
      const near = this.clock === null ? [] : eventsNear(this.events, this.clock, x, this.marks.clientWidth);
      this.hint.hidden = near.length === 0;
      const width = this.marks.clientWidth;
      this.hint.style.insetInlineStart = x < width / 2 ? `${x}px` : 'auto';
      this.hint.style.insetInlineEnd = x < width / 2 ? 'auto' : `${width - x}px`;
      setText(this.hint, [...near.slice(0, mostHints).map((e) => `${clockText(e.time_s)} ${e.text}`), ...(near.length > mostHints ? [`… and ${near.length - mostHints} more`] : [])].join('\n'));
    });
    box.addEventListener('pointerleave', () => { this.hint.hidden = true; });
    return box;
  }

  setEvents(events: RunEvent[]): void {
    const same = events.length === this.events.length && events.every((event, k) => event === this.events[k]);
    this.events = events;
    if (!same) this.drawMarks(true);
  }

  /** The keys of the page work there, and space plays. */
  focus(): void { this.play.focus(); }

  update(clock: Clock): void {
    this.clock = clock;
    const title = clock.playing ? 'Pause (space)' : 'Play (space)';
    if (this.play.title !== title) {
      this.play.replaceChildren(icon(clock.playing ? 'pause' : 'play'));
      this.play.title = title;
      this.play.setAttribute('aria-label', title);
    }
    this.play.classList.toggle('waiting', clock.playing && clock.waiting);
    setText(this.time, clockText(clock.timeS));
    this.live.hidden = !clock.following;
    this.live.setAttribute('aria-pressed', String(clock.newest));
    setText(this.end, clock.growing ? liveText(clock) : clockText(clock.endS));
    this.end.title = clock.keptSpeed < keepsUp ? 'The simulation does not keep up: it is shown slower than chosen' : '';
    this.timeline.min = String(clock.startS);
    this.timeline.max = String(Math.max(clock.endS, clock.startS + 1e-3));
    this.timeline.value = String(clock.timeS);
    this.timeline.setAttribute('aria-valuetext', `${clock.timeS.toFixed(1)} seconds`);
    const speed = String(clock.speed);
    if (this.speed.value !== speed) this.speed.value = speed;
    this.showLoop(clock);
    this.drawMarks(false);
  }

  private showLoop({ loop, timeS, startS, endS }: Clock): void {
    const title = loop === null ? loopTitles.none : loop.toS === null ? loopTitles.begun : loopTitles.whole;
    if (this.loop.title !== title) {
      this.loop.title = title;
      this.loop.setAttribute('aria-label', title);
      this.loop.setAttribute('aria-pressed', String(loop !== null));
    }
    this.range.hidden = loop === null;
    if (loop === null) return;
    const width = this.marks.clientWidth;
    const from = markPx(loop.fromS, { startS, endS }, width), to = markPx(loop.toS ?? Math.max(timeS, loop.fromS), { startS, endS }, width);
    this.range.style.left = `${from}px`;
    this.range.style.width = `${Math.max(2, to - from)}px`;
  }

  /** The colours have changed. */
  restyle(): void {
    this.drawMarks(true);
  }

  private drawMarks(always: boolean): void {
    if (this.clock === null) return;
    const width = this.marks.clientWidth;
    const height = this.marks.clientHeight;
    const { startS, endS } = this.clock;
    const now = { width, height, startS, endS };
    if (!always && !outdated(this.drawn, now, this.clock.playing)) return;
    this.drawn = now;
    const ratio = window.devicePixelRatio;
    this.marks.width = Math.round(width * ratio);
    this.marks.height = Math.round(height * ratio);
    const context = this.marks.getContext('2d');
    if (context === null || endS <= startS) return;
    context.scale(ratio, ratio);
    const style = getComputedStyle(this.marks);
    const colors = new Map<string, string>(); // asking for one costs more than drawing with it
    const colorOf = (name: string): string => {
      if (!colors.has(name)) colors.set(name, style.getPropertyValue(name));
      return colors.get(name)!;
    };
    for (const event of this.events) {
      const mark = eventMark(event.kind);
      if (mark === null) continue;
      const x = markPx(event.time_s, { startS, endS }, width);
      context.fillStyle = colorOf(mark.color);
      context.fillRect(x - 0.75, height * (1 - mark.height), 1.5, height * mark.height);
    }
  }
}
