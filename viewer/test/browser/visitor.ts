// SPDX-License-Identifier: MIT
// What a visitor does and sees, in words of the page: used by the tests that play it.
import { mkdtempSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { expect } from 'vitest';

export async function waitForRun(tab: Page): Promise<void> {
  await tab.waitForFunction(() => document.title.includes('– Banyan'));
  await tab.waitForSelector('.stage canvas');
}

interface PageInside {
  player: { timeS: number; waiting: boolean };
  stages: { shown: { timeS: number } | null }[];
  place(kind: string, index: number): { x: number; y: number };
}

const calmFrames = 3; // what was done has been drawn, and what that led to

/** Until the page shows what it was told: on a busy machine that takes a while. */
export async function settle(tab: Page): Promise<void> {
  await tab.evaluate((enough) => new Promise<void>((done) => {
    let calm = 0;
    const look = () => {
      calm = (window as unknown as { banyan: PageInside }).banyan.player.waiting ? 0 : calm + 1;
      if (calm >= enough) done();
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  }), calmFrames);
}

/** Of the next picture. */
export async function timeShown(tab: Page): Promise<number> {
  await settle(tab);
  return await tab.$eval('.timeline input', (e) => Number((e as HTMLInputElement).value));
}

/** Moves the timeline's handle and waits for the picture of that moment. */
export async function seekTo(tab: Page, timeS: number): Promise<void> {
  const play = await tab.$('button.play[aria-label^="Pause"]');
  if (play) await play.click();
  await tab.$eval('.timeline input', (element, t) => {
    const input = element as HTMLInputElement;
    input.value = String(t);
    input.dispatchEvent(new Event('input', { bubbles: true }));
  }, timeS);
  await settle(tab);
  await tab.waitForFunction((t) => (window as unknown as { banyan: PageInside }).banyan.stages
    .every(({ shown }) => shown !== null && Math.abs(shown.timeS - t) < 1e-6), timeS);
  await settle(tab);
}

/** Where robots and targets are on the screen: the page tells tests what it has drawn. */
export async function placeOf(tab: Page, kind: 'robot' | 'target' | 'obstacle', index: number): Promise<{ x: number; y: number }> {
  return await tab.evaluate(([k, i]) => {
    const { banyan } = window as unknown as { banyan: PageInside };
    return banyan.place(k, i);
  }, [kind, index] as const);
}

export async function clickRobot(tab: Page, robot: number): Promise<void> {
  const { x, y } = await placeOf(tab, 'robot', robot);
  await tab.mouse.click(x, y);
  await tab.waitForFunction((name) => document.querySelector('.robot-head h2')?.textContent === name, `Robot ${robot}`);
  await settle(tab);
}

/** The rows of a table of facts, by name. */
export async function factsShown(tab: Page, table = '.facts:not(.message):not(.beside)'): Promise<Record<string, string>> {
  return await tab.$eval(`.inspectors ${table}`, (element) =>
    Object.fromEntries([...(element as HTMLTableElement).rows].map((row) => [row.cells[0].textContent ?? '', row.cells[1].textContent ?? ''])));
}

/** Expects that the list of events has one with these words; it shows only those in view, so it is filtered. */
export async function expectEvent(tab: Page, words: string): Promise<void> {
  await tab.click('#tab-events');
  await tab.fill('.events input', words);
  await expect.poll(() => tab.textContent('.events-rows')).toContain(words);
}

/** The rows of a CSV file, by column. */
export function table(csv: string): Record<string, string>[] {
  const [head, ...lines] = csv.trim().split('\n');
  const names = head.split(',');
  return lines.map((line) => Object.fromEntries(line.split(',').map((cell, k) => [names[k], cell])));
}

/** Presses what hands out a file, and returns where it lies. */
export async function saved(tab: Page, selector: string, folder: string): Promise<string> {
  const download = tab.waitForEvent('download');
  await tab.click(selector);
  const file = await download;
  const path = join(mkdtempSync(join(folder, 'saved-')), file.suggestedFilename());
  await file.saveAs(path);
  return path;
}

/** How many pixels of each colour ("r,g,b") the picture has. */
export async function canvasPixels(tab: Page): Promise<Record<string, number>> {
  return await tab.$eval('.stage canvas', (element) => {
    const canvas = element as HTMLCanvasElement;
    const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
    const counts: Record<string, number> = {};
    for (let k = 0; k < data.length; k += 4) {
      const key = `${data[k]},${data[k + 1]},${data[k + 2]}`;
      counts[key] = (counts[key] ?? 0) + 1;
    }
    return counts;
  });
}
