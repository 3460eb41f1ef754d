// SPDX-License-Identifier: MIT
// The keys, and what the signs in the picture mean.
import { button, h } from '../dom';

const keys: [string, string][] = [
  ['Space', 'play, pause'],
  ['← →', 'one tick back, on; with Shift ten'],
  ['Home End', 'to the beginning, to the end'],
  ['[ ]', 'to the last, the next event: insertion, hand-over, broken edge, death …'],
  ['− +', 'slower, faster'],
  ['digits, Enter', 'select a robot by its number'],
  ['N P', 'select the next, the previous robot'],
  ['F', 'follow the selected robot'],
  ['0', 'fit everything into the picture'],
  ['PgUp PgDn', 'zoom in, out; Alt with arrows moves the picture'],
  ['L B O R I', 'radio links, blocked links, old tree, trails, numbers'],
  ['T K', 'live: add a target, kill an area'],
  ['Delete', 'live: kill the selected robot'],
  ['M', 'light, dark'],
  ['Escape', 'let go'],
  ['?', 'this help'],
];

export function helpDialog(): HTMLDialogElement {
  const rows = keys.map(([key, meaning]) => h('tr', {}, h('td', {}, ...key.split(' ').flatMap((k) => [h('kbd', {}, k), ' '])), h('td', {}, meaning)));
  const dialog = h(
    'dialog',
    { 'aria-label': 'Help' },
    h('h2', {}, 'Keys'),
    h('table', {}, h('tbody', {}, ...rows)),
    h('p', { class: 'hint' },
      'Drag to move the picture, turn the wheel or pinch to zoom, click a robot to look into it. In a live run drag targets and obstacles; ' +
      'double click adds a target. Thick lines are the tree, dashed orange ones the tree before the last reconstruction, dotted ones tree edges without a radio link.'),
    button('Close', 'Close', () => dialog.close(), { class: 'primary' }),
  );
  dialog.addEventListener('click', (event) => { if (event.target === dialog) dialog.close(); });
  return dialog;
}
