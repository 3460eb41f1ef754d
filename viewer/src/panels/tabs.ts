// SPDX-License-Identifier: MIT
// Panels that share one place, with the usual keys of tabs: arrows change the tab, Tab enters it.
import { h } from '../dom';

export interface Tab {
  name: string;
  title: string;
  content: HTMLElement;
  className?: string;
}

export class Tabs {
  readonly element: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private readonly panels: HTMLElement[];

  constructor(private readonly tabs: Tab[], label: string) {
    this.buttons = tabs.map((tab) =>
      h('button', { type: 'button', role: 'tab', id: `tab-${tab.name}`, 'aria-controls': `panel-${tab.name}`, onclick: () => this.show(tab.name) }, tab.title));
    this.panels = tabs.map((tab) =>
      h('div', { class: `tab ${tab.className ?? ''}`, role: 'tabpanel', id: `panel-${tab.name}`, 'aria-labelledby': `tab-${tab.name}` }, tab.content));
    const list = h('div', { class: 'tabs', role: 'tablist', 'aria-label': label, onkeydown: (event: KeyboardEvent) => this.onKey(event) }, ...this.buttons);
    this.element = h('aside', { class: 'side' }, list, ...this.panels);
    this.show(tabs[0].name);
  }

  show(name: string): void {
    this.tabs.forEach((tab, k) => {
      const chosen = tab.name === name;
      this.buttons[k].setAttribute('aria-selected', String(chosen));
      this.buttons[k].tabIndex = chosen ? 0 : -1;
      this.panels[k].hidden = !chosen;
    });
  }

  /** A tab that is there only on some screens. */
  offer(name: string, offered: boolean): void {
    const k = this.tabs.findIndex((tab) => tab.name === name);
    if (!offered && !this.panels[k].hidden) this.show(this.tabs[0].name);
    this.buttons[k].hidden = !offered;
  }

  private onKey(event: KeyboardEvent): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    const now = this.buttons.findIndex((b) => b.getAttribute('aria-selected') === 'true');
    let next = now;
    do next = (next + step + this.tabs.length) % this.tabs.length;
    while (this.buttons[next].hidden);
    this.show(this.tabs[next].name);
    this.buttons[next].focus();
  }
}
