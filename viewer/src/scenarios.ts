// SPDX-License-Identifier: MIT
// The scenarios that come with Banyan, built into the page: it needs no server to offer them.

export interface Scenario {
  name: string; // of its file, without the ending
  text: string; // TOML
  about: string; // its description, "" without one
}

const files = import.meta.glob<string>('../../scenarios/*.toml', { query: '?raw', import: 'default', eager: true });

const nameOf = (path: string) => path.replace(/^.*\//, '').replace(/\.toml$/, '');
/** The description in a scenario's text, TOML or JSON; "" without one. */
export const aboutOf = (text: string): string =>
  /^\s*(?:description\s*=|"description"\s*:)\s*"((?:[^"\\]|\\.)*)"/m.exec(text)?.[1].replaceAll('\\"', '"') ?? '';

/** A map in a file of its own is out of the page's reach. */
export const needsFiles = (text: string): boolean => /^\s*(?:map|file)\s*=/m.test(text);

export const scenarios: Scenario[] = Object.entries(files)
  .filter(([, text]) => !needsFiles(text))
  .map(([path, text]) => ({ name: nameOf(path), text, about: aboutOf(text) }))
  .sort((a, b) => a.name.localeCompare(b.name, 'en'));
