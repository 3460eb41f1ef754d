// SPDX-License-Identifier: MIT
// The keys, and what the signs in the picture mean.
import { button, h } from '../dom';
import { terms } from '../glossary';
import { legendMarks } from '../scene/legend';
import type { Theme } from '../scene/themes';
import { Legend } from './legend';

const keys: [string, string][] = [
  ['Space', 'play, pause'],
  ['← →', 'one tick back, on; with Shift ten'],
  ['Home End', 'to the beginning, to the end'],
  ['[ ]', 'to the last, the next event: insertion, hand-over, broken edge, death …'],
  ['− +', 'slower, faster'],
  ['A', 'loop from here; again: up to here; again: no more'],
  ['0–9 Enter', 'select a robot by its number'],
  ['N P', 'select the next, the previous robot; with Shift target or obstacle'],
  ['F', 'follow the selected robot'],
  ['0', 'fit everything into the picture'],
  ['PgUp PgDn', 'zoom in, out; Alt with arrows moves the picture'],
  ['L B O R I', 'radio links, blocked links, old tree, trails, numbers'],
  ['T X K', 'live: add a target, add an obstacle, kill an area; then arrows (Shift: far) and Enter, or the pointer'],
  ['G', 'live: grab the selected target or obstacle; then arrows (Shift: far) and Enter'],
  ['U Y', 'live: undo what was done last; do it again'],
  ['Delete', 'live: kill the selected robot, remove the selected target or obstacle'],
  ['M', 'light, dark'],
  ['Escape', 'let go'],
  ['?', 'this help'],
];

export class Help {
  readonly element: HTMLDialogElement;
  private readonly legend = new Legend(legendMarks);

  constructor(tour: () => void) {
    const rows = keys.map(([key, meaning]) => h('tr', {}, h('td', {}, ...key.split(' ').flatMap((k) => [h('kbd', {}, k), ' '])), h('td', {}, meaning)));
    this.element = h(
      'dialog',
      { 'aria-label': 'Help' },
      h('div', { class: 'help' },
        h('section', {},
          h('h2', {}, 'Keys'),
          h('table', {}, h('tbody', {}, ...rows))),
        h('section', {},
          h('h2', {}, 'Signs'),
          this.legend.element,
          h('h2', {}, 'Pointer'),
          h('p', { class: 'hint' },
            'Drag to move the picture, turn the wheel or pinch to zoom, click a robot to look into it. In a live run drag targets and obstacles; ' +
            'double click adds a target; a drag with Shift draws an area in which all robots die; Delete removes the selected ' +
            'robot, target or obstacle. Drop files to open them, with Shift beside what is shown.'))),
      h('details', { class: 'glossary' }, h('summary', {}, 'Glossary'),
        h('dl', {}, ...terms.flatMap(({ name, meaning }) => [h('dt', {}, name), h('dd', {}, meaning)]))),
      h('div', { class: 'buttons' }, button('Tour', 'A guided half minute', () => { this.element.close(); tour(); })),
      button('Close', 'Close', () => this.element.close(), { class: 'primary' }),
    );
    this.element.addEventListener('click', (event) => { if (event.target === this.element) this.element.close(); });
  }

  open(theme: Theme): void {
    this.legend.show(theme);
    this.element.showModal();
    this.element.scrollTop = 0; // the focus is on the button at its end
  }
}
