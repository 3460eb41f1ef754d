// SPDX-License-Identifier: MIT
// Where the run comes from and how it went: everything an output of Banyan carries inside.
import { button, h } from '../dom';
import type { Setting } from '../frame';
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

function sightOf(setting: Setting): string {
  if (!setting.line_of_sight) return 'not needed';
  const leak = setting.sight_leak ?? 0;
  return leak > 0 ? `bodies and obstacles block, but bodies leak (${leak})` : 'bodies and obstacles block';
}

export class RunFacts {
  readonly element = h('section', { class: 'run-facts', 'aria-label': 'Run' });

  /** `hash`: asks for the state hash of a run at the moment that is shown; answers in words. */
  constructor(private readonly hash: (run: number) => Promise<string>) {}

  update(headers: Header[]): void {
    this.element.replaceChildren(...headers.map((header, k) => this.run(header, k)));
    if (headers.length === 0) this.element.append(h('p', { class: 'hint' }, 'Nothing is open.'));
  }

  private run(header: Header, index: number): HTMLElement {
    const { setting } = header.settings[0];
    const about: [string, string][] = [
      ['algorithm', setting.reading === 'corrected' ? setting.algorithm : `${setting.algorithm}, ${setting.reading}`],
      ['seed', String(header.seed)],
      ['radio range', `${setting.range_m} m`],
      ['line of sight', sightOf(setting)],
      ['version', header.git === '' ? header.version : `${header.version}, ${header.git}`],
    ];
    const result = Object.entries(header.result).filter(([, value]) => value !== '');
    return h(
      'article', {},
      h('h2', {}, header.name),
      table(about),
      ...(header.kind === 'live' ? [this.hashLine(index)] : []),
      ...header.warnings.map((warning) => h('p', { class: 'problems' }, warning)),
      ...(result.length === 0 ? [] : [h('h3', {}, 'Result'), table(result)]),
      ...(header.config === '' ? [] : [h('details', {}, h('summary', {}, 'Configuration'), h('pre', {}, pretty(header.config)))]),
    );
  }

  private hashLine(index: number): HTMLElement {
    const answer = h('output', { class: 'hash' });
    const ask = button('State hash', 'Of the moment that is shown: a native run of the same scenario has the same', () => {
      answer.textContent = '…';
      void this.hash(index).then((text) => { answer.textContent = text; });
    });
    return h('p', { class: 'buttons' }, ask, answer);
  }
}
