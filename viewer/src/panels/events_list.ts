// SPDX-License-Identifier: MIT
// What happened, as a list that follows the clock; a click goes there. Long runs have thousands of
// events: only those in view are in the document.
import type { RunEvent } from '../frame';
import { button, h, setText } from '../dom';
import { eventMark } from './event_marks';
import { clockText } from './transport';

const rowPx = 42; // two lines: most texts need no more
const spare = 8; // rows beyond the edges, so that scrolling shows no gap

/** `run`: the algorithm of the run it is of, when two stand side by side. */
export type ListedEvent = RunEvent & { run?: string };

/** The index of the last event at or before a time; -1: there is none. */
export function lastAt(events: readonly RunEvent[], timeS: number): number {
  let low = 0;
  let high = events.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (events[middle].time_s <= timeS + 1e-9) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

export class EventsList {
  readonly element: HTMLElement;
  private readonly list = h('ol', { class: 'events-rows' });
  private readonly space = h('div', { class: 'events-space' }, this.list);
  /** The text of the present event, however long. */
  private readonly full = h('p', { class: 'event-full', 'aria-live': 'off' });
  private readonly why: HTMLButtonElement;
  private readonly view: HTMLElement;
  private readonly filter: HTMLInputElement;
  private all: ListedEvent[] = [];
  private shown: ListedEvent[] = [];
  private timeS = 0;
  private now = -1; // the last event that has happened
  private visible = false;
  /** Those in the document: of the events from `first` on. An event keeps its row as long as it is in view, or a
   *  click would miss what it was aimed at and Tab would lose its place. */
  private rows: Row[] = [];
  private first = 0;

  constructor(private readonly go: (event: RunEvent) => void, why: (event: ListedEvent) => void) {
    this.why = button('Why?', 'The ticks before, and what both ends believed and said', () => { const event = this.shown[this.now]; if (event) why(event); }, { hidden: true });
    this.filter = h('input', {
      type: 'search', placeholder: 'Filter, such as death or robot 12', 'aria-label': 'Filter the events', oninput: () => this.refilter(),
    });
    this.view = h('div', { class: 'events-view', tabindex: 0, 'aria-label': 'Events', onscroll: () => this.render() }, this.space);
    this.element = h('section', { class: 'events' }, this.filter, this.view, h('div', { class: 'event-foot' }, this.full, this.why));
    new ResizeObserver(() => this.resize()).observe(this.view);
  }

  setEvents(events: ListedEvent[]): void {
    this.all = events;
    this.refilter();
  }

  setTime(timeS: number): void {
    this.timeS = timeS;
    if (this.follow()) this.render();
  }

  /** True: the clock has reached another event. */
  private follow(): boolean {
    const now = lastAt(this.shown, this.timeS);
    if (now === this.now) return false;
    this.now = now;
    setText(this.full, this.shown[now]?.text ?? '');
    const event = this.shown[now];
    this.why.hidden = event?.kind !== 'edges_broken' || event.robot < 0;
    if (!this.view.matches(':hover, :focus-within')) this.scrollToNow();
    return true;
  }

  private scrollToNow(): void {
    this.view.scrollTop = Math.max(0, this.now * rowPx - this.view.clientHeight / 2);
  }

  /** A visitor who opens the list wants to see the present moment. */
  private resize(): void {
    const visible = this.view.clientHeight > 0;
    if (visible && !this.visible) this.scrollToNow();
    this.visible = visible;
    this.render();
  }

  private refilter(): void {
    const words = this.filter.value.toLowerCase().trim();
    const wanted = (e: ListedEvent) => `${e.run ?? ''} ${e.kind} ${e.text}`.toLowerCase().includes(words);
    this.shown = words === '' ? this.all.filter((e) => eventMark(e.kind) !== null) : this.all.filter(wanted);
    this.space.style.height = `${this.shown.length * rowPx}px`;
    this.follow();
    this.render();
  }

  private render(): void {
    const from = Math.max(0, Math.floor(this.view.scrollTop / rowPx) - spare);
    const to = Math.min(this.shown.length, Math.ceil((this.view.scrollTop + this.view.clientHeight) / rowPx) + spare);
    this.move(Math.min(from, to), to);
    this.list.style.transform = `translateY(${this.first * rowPx}px)`;
    this.rows.forEach((row, k) => row.show(this.shown[this.first + k], this.first + k - this.now));
  }

  /** Shows the events from `from` to before `to`; rows in both ranges stay. */
  private move(from: number, to: number): void {
    if (from >= this.first + this.rows.length || to <= this.first) this.clear(from);
    while (this.first < from) {
      this.rows.shift()!.element.remove();
      ++this.first;
    }
    while (this.first + this.rows.length > to) this.rows.pop()!.element.remove();
    while (this.first > from) {
      this.rows.unshift(new Row(this.go));
      this.list.prepend(this.rows[0].element);
      --this.first;
    }
    while (this.first + this.rows.length < to) {
      const row = new Row(this.go);
      this.rows.push(row);
      this.list.append(row.element);
    }
  }

  private clear(first: number): void {
    this.rows = [];
    this.list.replaceChildren();
    this.first = first;
  }
}

/** Of one event, or of another that took its place: only what differs is set. */
class Row {
  readonly element: HTMLElement;
  private event: ListedEvent | null = null;
  private readonly when = h('span', { class: 'when' });
  private readonly sign = h('span', { class: 'sign', 'aria-hidden': 'true' });
  private readonly run = h('span', { class: 'of' });
  private readonly what = h('span', { class: 'what' });
  private readonly button: HTMLButtonElement;

  constructor(go: (event: RunEvent) => void) {
    this.button = h('button', { type: 'button', onclick: () => { if (this.event) go(this.event); } }, this.when, this.sign, this.run, this.what);
    this.element = h('li', { class: 'event' }, this.button);
  }

  /** `ahead`: how many events after the one that is now; negative: before. */
  show(event: ListedEvent, ahead: number): void {
    const name = ahead === 0 ? 'event now' : ahead > 0 ? 'event later' : 'event';
    if (this.element.className !== name) this.element.className = name;
    if (event === this.event) return;
    this.event = event;
    const mark = eventMark(event.kind);
    setText(this.when, clockText(event.time_s));
    setText(this.sign, mark?.sign ?? '·');
    this.sign.style.color = mark ? `var(${mark.color})` : '';
    setText(this.run, event.run ?? '');
    setText(this.what, event.text);
    if (this.button.title !== event.text) this.button.title = event.text;
  }
}
