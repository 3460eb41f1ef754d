// SPDX-License-Identifier: MIT
// What is written can be read, in both themes: WCAG's contrast of text, at least 4.5.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { contrast } from '../src/scene/themes';

const css = readFileSync(new URL('../src/style.css', import.meta.url), 'utf8');

/** The colours of a theme; what the dark one does not say is as in the light one. */
function colors(theme: 'light' | 'dark'): Record<string, string> {
  const block = (head: string) => css.slice(css.indexOf(head), css.indexOf('}', css.indexOf(head)));
  const found = (text: string) => Object.fromEntries([...text.matchAll(/--([a-z0-9-]+): (#[0-9a-f]{6});/g)].map((m) => [m[1], m[2]]));
  const light = found(block(':root {'));
  return theme === 'light' ? light : { ...light, ...found(block(":root[data-theme='dark']")) };
}

/** Rules that make something see-through: what stands behind changes its contrast, whatever the colours are. */
const seeThrough = [...css.matchAll(/([^{};]+)\{[^{}]*\bopacity: 0?\.\d/g)].map((m) => m[1].replace(/\/\*.*?\*\//gs, '').trim());

it('lets no text be see-through', () => {
  // A line, an icon, and controls that are out of use, which WCAG leaves out.
  expect(seeThrough.sort()).toEqual(['.plot-cursor', '.transport .play.waiting', ':disabled']);
});

describe.each(['light', 'dark'] as const)('the %s theme', (theme) => {
  const color = colors(theme);
  it.each(['text', 'quiet', 'accent', 'bad', 'good'])('has %s that can be read', (name) => {
    for (const ground of ['ground', 'panel']) expect(contrast(color[name], color[ground])).toBeGreaterThanOrEqual(4.5);
  });
  it('has buttons that can be read', () => expect(contrast(color['accent-text'], color.accent)).toBeGreaterThanOrEqual(4.5));
  it.each(['run-1', 'run-2', 'run-3', 'run-4'])('has curves that can be seen: %s', (name) => expect(contrast(color[name], color.panel)).toBeGreaterThanOrEqual(3));
});
