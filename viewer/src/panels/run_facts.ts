// SPDX-License-Identifier: MIT
// Where the run comes from and how it went: everything an output of Banyan carries inside.
import { button, h } from '../dom';
import type { Setting } from '../frame';
import { outcomeOf, percent } from '../state/outcome';
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

type Row = [column: string, words: string, unit: string];

/** What is asked for first, in words; all other columns of the run table are below, as they are called there. */
const sections: [title: string, rows: Row[]][] = [
  ['Time', [
    ['completion_time_s', 'complete after', 's'], ['time_limit_s', 'limit', 's'], ['time_bound_s', 'no swarm could before', 's'],
    ['time_ratio', 'of that bound', '×'],
  ]],
  ['Robots', [
    ['robots', 'at the start', ''], ['committed', 'used at the end', ''], ['robots_bound', 'needed at least', ''],
    ['oracle_robots', 'of an oracle', ''], ['deaths', 'died', ''], ['driven_m', 'driven by each', 'm'],
  ]],
  ['Connection', [
    ['disconnected_time_ratio', 'time with a broken edge', '%'], ['disconnected_time_ratio_by_distance', 'by distance', '%'],
    ['disconnected_time_ratio_by_occlusion', 'by occlusion', '%'], ['split_ticks', 'ticks in several parts', ''],
    ['recovery_time_s', 'whole again after the last death', 's'], ['held_again_s', 'a dead worker\'s target held again (median)', 's'],
  ]],
  ['Work', [
    ['insertions', 'insertions', ''], ['handovers', 'hand-overs of the root', ''], ['repairs', 'repairs', ''],
    ['elections', 'elections', ''], ['replacements', 'workers replaced', ''], ['epochs', 'trees grown', ''],
    ['bytes_per_robot_s', 'broadcast by each robot', 'bytes/s'],
  ]],
];

/** A number as it is read; digits beyond what is seen tell nothing. */
export function written(value: string, unit: string): string {
  const number = Number(value);
  if (value === '' || !Number.isFinite(number)) return value;
  if (unit === '%') return percent(number);
  const text = Number.isInteger(number) ? String(number) : Math.abs(number) >= 100 ? number.toFixed(1) : number.toFixed(2);
  return unit === '' ? text : `${text} ${unit}`;
}

function resultSections(result: Record<string, string>): HTMLElement[] {
  const known = ([column]: Row) => (result[column] ?? '') !== '';
  const parts = sections.map(([title, rows]): [string, Row[]] => [title, rows.filter(known)]).filter(([, rows]) => rows.length > 0);
  const rest = Object.entries(result).filter(([, value]) => value !== '');
  return [
    ...parts.flatMap(([title, rows]) => [h('h3', {}, title), table(rows.map(([column, words, unit]) => [words, written(result[column], unit)]))]),
    ...(rest.length === 0 ? [] : [h('details', {}, h('summary', {}, 'All columns of the run table'), rawTable(rest))]),
  ];
}

function rawTable(rows: [string, string][]): HTMLElement {
  return h('table', { class: 'facts raw' }, h('tbody', {}, ...rows.map(([name, value]) => h('tr', {}, h('th', { scope: 'row' }, name), h('td', {}, value)))));
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
    const outcome = outcomeOf(header.result);
    return h(
      'article', {},
      h('h2', {}, header.name),
      ...(outcome === null ? [] : [
        h('p', { class: 'headline', 'data-state': outcome.good ? 'good' : 'bad' }, outcome.headline),
        h('p', {}, `${outcome.details.join(', ')}.`),
      ]),
      table(about),
      ...(header.kind === 'live' ? [this.hashLine(index)] : []),
      ...header.warnings.map((warning) => h('p', { class: 'problems' }, warning)),
      ...resultSections(header.result),
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
