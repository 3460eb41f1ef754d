// SPDX-License-Identifier: MIT
// One message at a time over the picture: what went wrong, or what was done. Read out by screen readers.
import { button, h } from '../dom';
import { kindOf } from '../source/problem';

const goodForMs = 6000;
const mostWarnings = 3; // a damaged file has dozens

export class Notice {
  readonly element = h('div', { class: 'notice', role: 'alert', hidden: true });
  private timer = 0;
  private warned = ''; // of the run last warned of
  private run: object | null = null;

  /** Stays until it is closed. */
  bad(text: string): void {
    this.show(text, true);
  }

  /** Warnings about what is open, `run`; the panel Run has all of them. What has been said of it once is not said
   *  again: the visitor may have closed it. */
  warn(warnings: readonly string[], run: object): void {
    const all = warnings.map(kindOf).join('\n'); // one more damaged frame is no news
    if (run === this.run && all === this.warned) return;
    this.run = run;
    this.warned = all;
    if (warnings.length > 0) this.bad(shortened(warnings).join('\n'));
  }

  /** Goes by itself. */
  good(text: string): void {
    this.show(text, false);
    this.timer = window.setTimeout(() => this.hide(), goodForMs);
  }

  hide(): void {
    this.element.hidden = true;
  }

  private show(text: string, bad: boolean): void {
    window.clearTimeout(this.timer);
    this.element.classList.toggle('bad', bad);
    this.element.replaceChildren(h('span', {}, text), button('×', 'Close', () => this.hide()));
    this.element.hidden = false;
  }
}

/** The first, and how many there are besides. */
export function shortened(warnings: readonly string[]): string[] {
  const left = warnings.length - mostWarnings;
  return left <= 0 ? [...warnings] : [...warnings.slice(0, mostWarnings), `… and ${left} more: see Run`];
}
