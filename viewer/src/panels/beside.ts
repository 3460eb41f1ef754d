// SPDX-License-Identifier: MIT
// The same facts of several robots, or of one robot in several runs: a column each, and what they differ in stands out.
import { h } from '../dom';

interface Named { name: string; value: string }

export function beside(titles: readonly string[], all: readonly (readonly Named[])[]): HTMLTableElement {
  const names = [...new Set(all.flatMap((facts) => facts.map(({ name }) => name)))];
  return h('table', { class: 'facts beside' },
    h('thead', {}, h('tr', {}, h('td'), ...titles.map((title) => h('th', { scope: 'col' }, title)))),
    h('tbody', {}, ...names.map((name) => {
      const values = all.map((facts) => facts.find((fact) => fact.name === name)?.value ?? '–');
      const differs = new Set(values).size > 1;
      return h('tr', { class: differs ? 'differs' : undefined }, h('th', { scope: 'row' }, name.replaceAll('_', ' ')), ...values.map((value) => h('td', {}, value)));
    })));
}
