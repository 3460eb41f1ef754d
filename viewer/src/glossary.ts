// SPDX-License-Identifier: MIT
// The words of the field, from the document that defines them (docs/glossary.md), built into the page.
import text from '../../docs/glossary.md?raw';

export interface Term { name: string; meaning: string }

/** The rows of its tables: "| **root** | *paper*: the robot ... | `Role::root` |". */
export function termsOf(markdown: string): Term[] {
  const rows = [...markdown.matchAll(/^\| \*\*(.+?)\*\*(.*?) \| (.+?) \|/gm)];
  return rows.map(([, name, more, meaning]) => ({ name: plain(name + more), meaning: plain(meaning) }));
}

const plain = (words: string) => words.replace(/\[([^\]]*)\]\([^)]*\)/g, '$1').replace(/[*`]/g, '').trim();

export const terms: readonly Term[] = termsOf(text);
