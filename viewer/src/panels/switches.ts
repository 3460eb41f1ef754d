// SPDX-License-Identifier: MIT
// What the picture shows beside the robots.
import { button, h } from '../dom';
import type { Switches } from '../scene/view';
import type { Store } from '../state/store';

const names: [keyof Switches, string][] = [
  ['links', 'Radio links (L)'],
  ['blocked', 'Blocked links: in range, but no line of sight (B)'],
  ['oldTree', 'The old tree, during a reconstruction (O)'],
  ['trails', 'Trails (R)'],
  ['labels', 'Distance to the root and depth, as each robot believes'],
  ['ids', 'Numbers of the robots (I)'],
];

export class SwitchPanel {
  readonly element: HTMLElement;
  private readonly boxes = new Map<keyof Switches, HTMLInputElement>();
  private readonly theme: HTMLSelectElement;

  constructor(private readonly store: Store, fit: () => void) {
    this.theme = h('select', { id: 'theme', onchange: () => store.set({ theme: this.theme.value as 'auto' | 'light' | 'dark' }) },
      ...['auto', 'light', 'dark'].map((name) => h('option', { value: name }, name)));
    this.element = h(
      'section', { 'aria-label': 'View' },
      ...names.map(([name, text]) => this.box(name, text)),
      h('div', { class: 'field' }, h('label', { for: 'theme' }, 'Colours'), this.theme),
      h('div', { class: 'buttons' }, button('Fit into the picture', 'Fit (0)', fit)),
    );
    store.subscribe(() => this.update());
    this.update();
  }

  private box(name: keyof Switches, text: string): HTMLElement {
    const box = h('input', { type: 'checkbox', onchange: () => this.store.toggle(name) });
    this.boxes.set(name, box);
    return h('label', { class: 'switch' }, box, text);
  }

  private update(): void {
    for (const [name, box] of this.boxes) box.checked = this.store.state.switches[name];
    this.theme.value = this.store.state.theme;
  }
}
