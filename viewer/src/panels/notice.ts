// SPDX-License-Identifier: MIT
// One message at a time over the picture: what went wrong, or what was done. Read out by screen readers.
import { button, h } from '../dom';

const goodForMs = 6000;

export class Notice {
  readonly element = h('div', { class: 'notice', role: 'alert', hidden: true });
  private timer = 0;

  /** Stays until it is closed. */
  bad(text: string): void {
    this.show(text, true);
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
