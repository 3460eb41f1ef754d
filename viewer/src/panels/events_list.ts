// SPDX-License-Identifier: MIT
// What happened, as a list that follows the clock; a click goes there. Long runs have thousands of
// events: only those in view are in the document.
import type { RunEvent } from '../frame';
import { h } from '../dom';
import { eventMark } from './event_marks';
import { clockText } from './transport';

const rowPx = 26;
const spare = 8; // rows beyond the edges, so that scrolling shows no gap

export class EventsList {
  readonly element: HTMLElement;
  private readonly rows = h('ol', { class: 'events-rows' });
  private readonly space = h('div', { class: 'events-space' }, this.rows);
  private readonly view: HTMLElement;
  private readonly filter: HTMLInputElement;
  private all: RunEvent[] = [];
  private shown: RunEvent[] = [];
  private now = -1; // the last event that has happened

  constructor(private readonly go: (event: RunEvent) => void) {
    this.filter = h('input', {
      type: 'search', placeholder: 'Filter, such as death or robot 12', 'aria-label': 'Filter the events', oninput: () => this.refilter(),
    });
    this.view = h('div', { class: 'events-view', tabindex: 0, 'aria-label': 'Events', onscroll: () => this.render() }, this.space);
    this.element = h('section', { class: 'events' }, this.filter, this.view);
    new ResizeObserver(() => this.render()).observe(this.view);
  }

  setEvents(events: RunEvent[]): void {
    this.all = events;
    this.refilter();
  }

  setTime(timeS: number): void {
    let low = 0;
    let high = this.shown.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.shown[middle].time_s <= timeS + 1e-9) low = middle + 1;
      else high = middle;
    }
    if (low - 1 === this.now) return;
    this.now = low - 1;
    if (!this.view.matches(':hover, :focus-within')) {
      this.view.scrollTop = Math.max(0, this.now * rowPx - this.view.clientHeight / 2);
    }
    this.render();
  }

  private refilter(): void {
    const words = this.filter.value.toLowerCase().trim();
    const wanted = (e: RunEvent) => `${e.kind} ${e.text}`.toLowerCase().includes(words);
    this.shown = words === '' ? this.all.filter((e) => eventMark(e.kind) !== null) : this.all.filter(wanted);
    this.now = -2;
    this.space.style.height = `${this.shown.length * rowPx}px`;
    this.render();
  }

  private render(): void {
    const first = Math.max(0, Math.floor(this.view.scrollTop / rowPx) - spare);
    const last = Math.min(this.shown.length, Math.ceil((this.view.scrollTop + this.view.clientHeight) / rowPx) + spare);
    this.rows.style.transform = `translateY(${first * rowPx}px)`;
    this.rows.replaceChildren(...this.shown.slice(first, last).map((event, k) => this.row(event, first + k)));
  }

  private row(event: RunEvent, index: number): HTMLElement {
    const mark = eventMark(event.kind);
    const sign = h('span', { class: 'sign', 'aria-hidden': 'true' }, mark?.sign ?? '·');
    if (mark) sign.style.color = `var(${mark.color})`;
    const classes = `event${index === this.now ? ' now' : ''}${index > this.now ? ' later' : ''}`;
    return h(
      'li',
      { class: classes },
      h('button', { type: 'button', title: event.text, onclick: () => this.go(event) },
        h('span', { class: 'when' }, clockText(event.time_s)), sign, h('span', { class: 'what' }, event.text)),
    );
  }
}
