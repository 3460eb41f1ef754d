// SPDX-License-Identifier: MIT
// The marks of the picture for a legend beside it, as SVG text of 28 x 18 px.
import type { Theme } from './themes';

export const legendMarks = [
  'root', 'worker', 'connector', 'spare', 'dead', 'target', 'tree', 'oldTree', 'broken', 'joining', 'link', 'blocked',
  'trail',
] as const;
export type LegendMark = (typeof legendMarks)[number];

export const legendWords: Record<LegendMark, string> = {
  root: 'root', worker: 'worker', connector: 'connector', spare: 'spare', dead: 'dead',
  target: 'target and tolerance, filled: held',
  tree: 'tree, thicker towards the root', oldTree: 'old tree', broken: 'broken edge', joining: 'spare about to join',
  link: 'radio link', blocked: 'in range, no line of sight', trail: 'trail',
};

const line = (color: string, width: number, more = '') =>
  `<path d="M2 9H26" fill="none" stroke="${color}" stroke-width="${width}" stroke-linecap="round" ${more}/>`;
const disc = (color: string, radius: number, more = '') => `<circle cx="14" cy="9" r="${radius}" fill="${color}" ${more}/>`;

function shapes(mark: LegendMark, theme: Theme): string {
  const outline = `stroke="${theme.outline}"`;
  const [spare, connector, worker, root] = theme.roles;
  switch (mark) {
    case 'root': return disc('none', 7.6, `stroke="${root}" stroke-width="1.8"`) + disc(root, 4.6, outline);
    case 'worker': return disc(worker, 5.5, outline) + disc('#ffffff', 2.1);
    case 'connector': return disc(connector, 5.5, outline);
    case 'spare': return disc(spare, 5.5, outline);
    case 'dead': return disc(theme.dead, 5.5) +
      `<path d="M11.4 6.4l5.2 5.2m0-5.2l-5.2 5.2" stroke="${theme.background}" stroke-width="1.4"/>`;
    case 'target': return disc(theme.target, 7, `fill-opacity="0.2" stroke="${theme.target}" stroke-width="1.75"`) +
      `<path d="M10.5 9h7M14 5.5v7" stroke="${theme.target}" stroke-width="1.5"/>`;
    case 'tree': return `<path d="M2 6.6L26 8.2V9.8L2 11.4Z" fill="${theme.tree}"/>`;
    case 'oldTree': return line(theme.oldTree, 4, 'style="stroke-linecap:butt" stroke-dasharray="6 4"');
    case 'broken': return line(theme.broken, 3, 'stroke-dasharray="0 6"') +
      `<path d="M10.4 14.5L13.6 3.5M14.4 14.5L17.6 3.5" stroke="${theme.background}" stroke-width="5"/>` +
      `<path d="M10.4 14.5L13.6 3.5M14.4 14.5L17.6 3.5" stroke="${theme.broken}" stroke-width="2" stroke-linecap="round"/>`;
    case 'joining':
      return `<path d="M2 9H25M20 5.5L25 9L20 12.5" fill="none" stroke="${connector}" stroke-width="1.75"/>`;
    case 'link': return line(theme.link, 1);
    case 'blocked': return line(theme.blocked, 1.25, 'style="stroke-linecap:butt" stroke-dasharray="3 4"');
    case 'trail': return line(connector, 3, `stroke-opacity="${theme.trailAlpha}"`);
  }
}

/** For innerHTML; it holds nothing that came from a file. */
export function legendSvg(mark: LegendMark, theme: Theme): string {
  return `<svg width="28" height="18" viewBox="0 0 28 18" aria-hidden="true">${shapes(mark, theme)}</svg>`;
}
