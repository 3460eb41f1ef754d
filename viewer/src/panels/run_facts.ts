// SPDX-License-Identifier: MIT
// Where the run comes from and how it went: everything an output of Banyan carries inside.
import { h } from '../dom';
import type { Header } from '../source/protocol';

function table(rows: [string, string][]): HTMLElement {
  return h('table', { class: 'facts' }, h('tbody', {},
    ...rows.map(([name, value]) => h('tr', {}, h('th', { scope: 'row' }, name.replaceAll('_', ' ')), h('td', {}, value)))));
}

function pretty(config: string): string {
  try {
    return JSON.stringify(JSON.parse(config), null, 2);
  } catch {
    return config; // damaged: as it is
  }
}

export class RunFacts {
  readonly element = h('section', { class: 'run-facts', 'aria-label': 'Run' });

  /** One or two runs; `hashes`: the state of a live run at its end so far, as text. */
  update(headers: Header[], hashes: (string | null)[]): void {
    this.element.replaceChildren(...headers.map((header, k) => this.run(header, hashes[k] ?? null)));
    if (headers.length === 0) this.element.append(h('p', { class: 'hint' }, 'Nothing is open.'));
  }

  private run(header: Header, hash: string | null): HTMLElement {
    const { setting } = header.settings[0];
    const about: [string, string][] = [
      ['algorithm', setting.reading === 'corrected' ? setting.algorithm : `${setting.algorithm}, ${setting.reading}`],
      ['seed', String(header.seed)],
      ['radio range', `${setting.range_m} m`],
      ['line of sight', setting.line_of_sight ? 'bodies and obstacles block' : 'not needed'],
      ['version', header.git === '' ? header.version : `${header.version}, ${header.git}`],
    ];
    if (hash !== null) about.push(['state hash', hash]);
    const result = Object.entries(header.result).filter(([, value]) => value !== '');
    return h(
      'article', {},
      h('h2', {}, header.name),
      table(about),
      ...header.warnings.map((warning) => h('p', { class: 'problems' }, warning)),
      ...(result.length === 0 ? [] : [h('h3', {}, 'Result'), table(result)]),
      ...(header.config === '' ? [] : [h('details', {}, h('summary', {}, 'Configuration'), h('pre', {}, pretty(header.config)))]),
    );
  }
}
