// SPDX-License-Identifier: MIT
// What the marks in the picture mean: a mark and its words for each.
import { h } from '../dom';
import { legendSvg, legendWords, type LegendMark } from '../scene/legend';
import type { Theme } from '../scene/themes';

/** The few that every visitor needs beside the picture. */
export const firstMarks: readonly LegendMark[] = ['root', 'worker', 'connector', 'spare', 'target'];

export class Legend {
  readonly element: HTMLElement;
  private readonly entries: { mark: LegendMark; sign: HTMLElement }[];
  private theme: Theme | null = null;

  constructor(marks: readonly LegendMark[], wordsOf: (mark: LegendMark) => string = (mark) => legendWords[mark]) {
    this.entries = marks.map((mark) => ({ mark, sign: h('i') }));
    this.element = h('div', { class: 'legend' }, ...this.entries.map(({ mark, sign }) => h('span', {}, sign, wordsOf(mark))));
  }

  show(theme: Theme): void {
    if (theme === this.theme) return;
    this.theme = theme;
    for (const { mark, sign } of this.entries) sign.innerHTML = legendSvg(mark, theme);
  }
}
