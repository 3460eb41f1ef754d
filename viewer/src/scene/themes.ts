// SPDX-License-Identifier: MIT
// The colours of the picture, light and dark. Roles and marks have those of record/palette.hpp (Okabe & Ito's, safe
// for the colour-blind) in both; only what would drown in a dark ground, ink and greys, is turned round.

export interface Theme {
  name: 'light' | 'dark';
  background: string;
  grid: string;
  text: string;
  quietText: string;
  /** By the number of the role: spare, connector, worker, root. */
  roles: readonly [string, string, string, string];
  /** Around every robot; it is what makes a yellow spare seen on white. */
  outline: string;
  /** Where a robot looks. */
  heading: string;
  /** Of spares that are dots without an outline. */
  dot: string;
  dead: string;
  target: string;
  targetText: string;
  tree: string;
  oldTree: string;
  /** Edges whose other end is out of range, occluded or dead. */
  broken: string;
  link: string;
  blocked: string;
  spareTrail: string;
  /** Opacity of the newest part of a trail. */
  trailAlpha: number;
  obstacle: string;
  obstacleEdge: string;
  /** Selection, hovering, the path to the root. */
  accent: string;
}

const roles = ['#f0e442', '#009e73', '#0072b2', '#d55e00'] as const;

export const light: Theme = {
  name: 'light',
  background: '#fdfdfc',
  grid: '#f0efec',
  text: '#1a1a1a',
  quietText: '#5f5f5c',
  roles,
  outline: '#1a1a1a',
  heading: '#1a1a1a',
  dot: '#8a7d00',
  dead: '#595959',
  target: '#cc79a7',
  targetText: '#8f3f6d',
  tree: '#1a1a1a',
  oldTree: '#e69f00',
  broken: '#d55e00',
  link: '#b8b8b8',
  blocked: '#56b4e9',
  spareTrail: '#b0a010',
  trailAlpha: 0.5,
  obstacle: '#a6a098',
  obstacleEdge: '#8b857d',
  accent: '#5a3fd6',
};

export const dark: Theme = {
  name: 'dark',
  background: '#14171a',
  grid: '#1e2226',
  text: '#eceae6',
  quietText: '#a3a7ab',
  roles,
  outline: '#0b0d0f',
  heading: '#b9bcbf',
  dot: '#d8cc3a',
  dead: '#8c8f93',
  target: '#cc79a7',
  targetText: '#e8b3d0',
  tree: '#eceae6',
  oldTree: '#e69f00',
  broken: '#f0732a',
  link: '#5a6168',
  blocked: '#56b4e9',
  spareTrail: '#b0a010',
  trailAlpha: 0.8,
  obstacle: '#56534e',
  obstacleEdge: '#77736c',
  accent: '#b3a2ff',
};

export const themes = { light, dark } as const;

/** `share` of a over b, as one opaque colour: blending every pixel of thousands of lines takes half as long again. */
export function mixed(a: string, b: string, share: number): string {
  const value = (hex: string, at: number) => parseInt(hex.slice(at, at + 2), 16);
  const part = (at: number) => Math.round(share * value(a, at) + (1 - share) * value(b, at));
  return `rgb(${part(1)} ${part(3)} ${part(5)})`;
}

function channel(hex: string, at: number): number {
  const value = parseInt(hex.slice(at, at + 2), 16) / 255;
  return value <= 0.03928 ? value / 12.92 : Math.pow((value + 0.055) / 1.055, 2.4);
}

/** WCAG's relative luminance of "#rrggbb". */
export function luminance(hex: string): number {
  return 0.2126 * channel(hex, 1) + 0.7152 * channel(hex, 3) + 0.0722 * channel(hex, 5);
}

/** WCAG's contrast ratio, 1 to 21: at least 4.5 for text, 3 for marks. */
export function contrast(a: string, b: string): number {
  const [lower, higher] = [luminance(a), luminance(b)].sort((p, q) => p - q) as [number, number];
  return (higher + 0.05) / (lower + 0.05);
}
