// SPDX-License-Identifier: MIT
// What visitors of a live run do and see, for the tests of it.
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { banyan, type Folder } from './harness';
import { saved, seekTo, settle } from './visitor';

/** Plays on to a moment, and stands there. */
export async function playTo(tab: Page, timeS: number): Promise<void> {
  if (await tab.$('button.play[aria-label^="Play"]')) await tab.click('button.play');
  await tab.selectOption('select[aria-label=Speed]', '64');
  await tab.waitForFunction((t) => Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) >= t, timeS);
  await seekTo(tab, timeS);
}

export async function killByKeys(tab: Page, robot: number): Promise<void> {
  await tab.keyboard.type(String(robot));
  await tab.keyboard.press('Enter');
  await tab.keyboard.press('Delete');
}

export async function hashShown(tab: Page): Promise<string> {
  await tab.click('#tab-run');
  await tab.click('text=State hash');
  await tab.waitForFunction(() => /^[0-9a-f]{16}/.test(document.querySelector('.hash')?.textContent ?? ''));
  return (await tab.textContent('.hash'))!;
}

/** Of a native run that ends after so many ticks of 0.1 s. */
export function nativeHash(folder: Folder, file: string, ticks: number, out: string): string {
  const json = banyan('run', file, '--no-record', '--json', '--set', `mission.time_limit_s=${ticks / 10}`, '--set', 'mission.stop_when_complete=false', '--out', join(folder.path, out));
  return (JSON.parse(json) as { result: { hash: string } }).result.hash;
}

export const lossShown = (tab: Page) => tab.$eval('#live-loss', (e) => Number((e as HTMLInputElement).value));
export const isPlaying = (tab: Page) => tab.$('button.play[aria-label^="Pause"]').then((button) => button !== null);

export async function savedOfLive(tab: Page, button: string, folder: Folder): Promise<string> {
  await tab.click('#tab-live');
  return await saved(tab, `text=${button}`, folder.path);
}

export async function dragTo(tab: Page, from: { x: number; y: number }, to: { x: number; y: number }): Promise<void> {
  await tab.mouse.move(from.x, from.y);
  await tab.mouse.down();
  for (let k = 1; k <= 5; ++k) await tab.mouse.move(from.x + ((to.x - from.x) * k) / 5, from.y + ((to.y - from.y) * k) / 5);
  await tab.mouse.up();
  await settle(tab);
}
