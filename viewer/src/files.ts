// SPDX-License-Identifier: MIT
// How a file gets into the page: dropped on it, chosen, or named by the program that serves it.
import { h } from './dom';
import type { Scenario } from './scenarios';

export type Opened = { recording: File } | { scenario: { name: string; text: string } };

const largestScenario = 1 << 20; // bytes: beyond, it is no scenario

/** What a file is, by its name and its first bytes; throws an Error in words if it is neither. */
export async function judge(file: File): Promise<Opened> {
  const name = file.name.toLowerCase();
  if (/\.(toml|json)$/.test(name)) {
    if (file.size > largestScenario) throw new Error(`${file.name} is too large for a scenario (${Math.round(file.size / 1e6)} MB)`);
    return { scenario: { name: file.name, text: await file.text() } };
  }
  return { recording: file }; // its reader reports what is wrong with it
}

/** Names under which the files of runs side by side are saved: none twice. */
export function apart(names: string[], algorithms: string[]): string[] {
  if (names.length < 2) return names;
  return names.map((name, k) => {
    const twin = algorithms.filter((algorithm) => algorithm === algorithms[k]).length > 1;
    const which = twin ? `${algorithms[k]}-${k + 1}` : algorithms[k];
    return name.replace(/(\.[^.]*)?$/, (ending) => `-${which}${ending}`);
  });
}

/** `beside`: Shift was held. */
export function acceptDrops(open: (files: File[], beside: boolean) => void): void {
  const root = document.documentElement;
  let inside = 0; // dragenter and dragleave come for every element
  const show = () => root.classList.toggle('dragging', inside > 0);
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  root.addEventListener('dragenter', (event) => { if (hasFiles(event)) { ++inside; show(); } });
  root.addEventListener('dragleave', (event) => { if (hasFiles(event)) { inside = Math.max(0, inside - 1); show(); } });
  root.addEventListener('dragover', (event) => { if (hasFiles(event)) event.preventDefault(); });
  root.addEventListener('drop', (event) => {
    event.preventDefault();
    inside = 0;
    show();
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) open(files, event.shiftKey);
  });
}

export function chooseFile(open: (files: File[]) => void): void {
  const input = h('input', { type: 'file', multiple: true, accept: '.mcap,.part,.toml,.json' });
  input.addEventListener('change', () => { if (input.files?.length) open([...input.files]); });
  input.click();
}

/** What `banyan view` was given. */
export interface Start {
  recording?: { name: string; size: number; url: string };
  scenario?: { name: string; text: string; overrides: string[] };
}

/** What `banyan view` offers to run; null from any other server. */
export async function askScenarios(): Promise<Scenario[] | null> {
  const list = await ask<{ name: string; description: string; text: string }[]>('./scenarios.json');
  return list?.map(({ name, description, text }) => ({ name, about: description, text })) ?? null;
}

/** {} from any other server. The program names its own addresses with `?start`, so that no other is asked for a
 *  file that it does not have. */
export async function askServer(): Promise<Start> {
  return (await ask<Start>('./start.json')) ?? {};
}

async function ask<Answer>(file: string): Promise<Answer | null> {
  if (!new URLSearchParams(location.search).has('start')) return null;
  try {
    const answer = await fetch(file, { cache: 'no-store' });
    return answer.ok && (answer.headers.get('content-type') ?? '').includes('json') ? ((await answer.json()) as Answer) : null;
  } catch {
    return null; // the server is gone
  }
}
