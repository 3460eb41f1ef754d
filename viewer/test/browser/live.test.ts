// SPDX-License-Identifier: MIT
// A live run in the page, the simulation in WebAssembly: what is done to it, what is kept of it, what stands beside it.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { banyan, scenario, served } from './harness';
import { clickRobot, expectEvent, factsShown, placeOf, saved, seekTo, settle, timeShown } from './visitor';

const { folder, visit } = served(() => scenario('three-targets'));

/** Plays on to a moment, and stands there. */
async function playTo(tab: Page, timeS: number): Promise<void> {
  if (await tab.$('button.play[aria-label^="Play"]')) await tab.click('button.play');
  await tab.selectOption('select[aria-label=Speed]', '64');
  await tab.waitForFunction((t) => Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) >= t, timeS);
  await seekTo(tab, timeS);
}

async function killByKeys(tab: Page, robot: number): Promise<void> {
  await tab.keyboard.type(String(robot));
  await tab.keyboard.press('Enter');
  await tab.keyboard.press('Delete');
}

async function hashShown(tab: Page): Promise<string> {
  await tab.click('#tab-run');
  await tab.click('text=State hash');
  await tab.waitForFunction(() => /^[0-9a-f]{16}/.test(document.querySelector('.hash')?.textContent ?? ''));
  return (await tab.textContent('.hash'))!;
}

/** Of a native run that ends after so many ticks of 0.1 s. */
function nativeHash(file: string, ticks: number, out: string): string {
  const json = banyan('run', file, '--no-record', '--json', '--set', `mission.time_limit_s=${ticks / 10}`, '--set', 'mission.stop_when_complete=false', '--force', '--out', join(folder.path, out));
  return (JSON.parse(json) as { result: { hash: string } }).result.hash;
}

async function savedOfLive(tab: Page, button: string): Promise<string> {
  await tab.click('#tab-live');
  return await saved(tab, `text=${button}`, folder.path);
}

async function dragTo(tab: Page, from: { x: number; y: number }, to: { x: number; y: number }): Promise<void> {
  await tab.mouse.move(from.x, from.y);
  await tab.mouse.down();
  for (let k = 1; k <= 5; ++k) await tab.mouse.move(from.x + ((to.x - from.x) * k) / 5, from.y + ((to.y - from.y) * k) / 5);
  await tab.mouse.up();
  await settle(tab);
}

/** Until so many are shown. */
const waitForRuns = (tab: Page, count: number) => tab.waitForFunction((n) => document.querySelectorAll('.stage').length === n, count);
const captions = (tab: Page) => tab.$$eval('.caption > p:first-child', (all) => all.map((e) => e.textContent ?? ''));

async function openInspectors(tab: Page): Promise<void> {
  await tab.waitForSelector('.run-inspector[open]');
  await tab.$$eval('.run-inspector', (all) => { for (const e of all) (e as HTMLDetailsElement).open = true; });
}

async function addFile(tab: Page, file: string): Promise<void> {
  const chooser = tab.waitForEvent('filechooser');
  await tab.click('text=Add …');
  await (await chooser).setFiles(file);
}

describe('a live run', () => {
  it('has after 200 ticks the state hash of the native run', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 20);
    expect(await hashShown(tab)).toBe(`${nativeHash(scenario('three-targets'), 200, 'native')} at tick 200`);
    expect(errors).toEqual([]);
  });

  it('goes back in time, does something else, and forgets what was', async () => {
    const { tab } = await visit();
    await playTo(tab, 10);
    await killByKeys(tab, 5);
    await playTo(tab, 12);
    await seekTo(tab, 6);
    await killByKeys(tab, 6);
    await playTo(tab, 12);
    await clickRobot(tab, 5);
    expect((await factsShown(tab)).alive).toBe('yes');
    await clickRobot(tab, 6);
    expect((await factsShown(tab)).alive).toBe('no');
  });

  it('obstacles are dragged, line of sight is switched, a target is added: a native run repeats it all', async () => {
    const { tab, errors } = await visit();
    await tab.click('#tab-live');
    await tab.selectOption('#live-scenario', 'scattered-discs');
    await tab.click('text=Start');
    await tab.waitForFunction(() => document.title.startsWith('scattered-discs'));
    await playTo(tab, 3);
    const obstacle = await placeOf(tab, 'obstacle', 0);
    await dragTo(tab, obstacle, { x: obstacle.x + 40, y: obstacle.y + 25 });
    const moved = await placeOf(tab, 'obstacle', 0);
    await tab.click('#tab-live');
    await tab.click('#live-sight');
    await settle(tab);
    await tab.click('text=Add target');
    const target = await placeOf(tab, 'target', 0);
    await tab.mouse.click(target.x - 70, target.y + 45);
    await settle(tab);
    await playTo(tab, 9);
    await expect.poll(() => tab.textContent('.caption')).toContain('4 targets');
    for (const words of ['obstacle 0', 'line of sight', 'T3']) await expectEvent(tab, words);
    expect(moved).not.toBeNull();
    const shown = await hashShown(tab);
    const file = await savedOfLive(tab, 'Save .toml');
    expect(readFileSync(file, 'utf8')).toContain('kind = "move_obstacle"');
    expect(shown).toBe(`${nativeHash(file, 90, 'obstacles')} at tick 90`);
    expect(errors).toEqual([]);
  });

  it('is saved as a recording that the program reads', async () => {
    const { tab } = await visit();
    await playTo(tab, 6);
    const file = await savedOfLive(tab, 'Save .mcap');
    const csv = banyan('export', file);
    expect(csv.includes('\n50,5.0000,')).toBe(true);
  });

  it('says in words what is wrong with a scenario, and stays usable', async () => {
    const { tab } = await visit();
    await tab.click('#tab-live');
    await tab.click('summary');
    await tab.fill('#live-keys', 'radio.lost = 0.3\nradio.range_m = -1');
    await tab.click('text=Start');
    await tab.waitForSelector('.live .problems li');
    const problems = (await tab.textContent('.live .problems'))!;
    expect(problems).toContain('radio.lost');
    expect(problems).toContain('radio.loss');
    expect(problems).toContain('radio.range_m');
    await tab.fill('#live-keys', 'radio.loss = 0.3\nseed = 77');
    await tab.click('text=Start');
    await tab.waitForFunction(() => document.querySelector('.what-runs')?.textContent?.includes('seed 77'));
    await playTo(tab, 2);
    expect(await timeShown(tab)).toBeCloseTo(2);
  });

  it('a recording stands beside a live run: one clock, an inspector each, and only one can be interfered with', async () => {
    const file = folder.record('other', scenario('three-targets'), '--seed', '4', '--set', 'mission.algorithm=outwards', '--set', 'swarm.redundancy=4', '--force');
    const { tab, errors } = await visit();
    await addFile(tab, file);
    await waitForRuns(tab, 2);
    await seekTo(tab, 4);
    await expect.poll(() => captions(tab)).toEqual([expect.stringMatching(/^convoy · 18 robots/), expect.stringMatching(/^outwards · 24 robots/)]);
    // Robot 3 as the program knows it, of the recording; and as a run alone has it, of the live one.
    await tab.keyboard.type('3');
    await tab.keyboard.press('Enter');
    await openInspectors(tab);
    await settle(tab);
    const row = banyan('export', file, '--from', '3.95', '--to', '4.05').split('\n').map((line) => line.split(','));
    const column = (name: string) => Number(row.find((cells) => cells[row[0].indexOf('robot')] === '3')![row[0].indexOf(name)]);
    const [x, y] = (await factsShown(tab, '.run-inspector:nth-of-type(2) .facts:not(.message)')).position.split(',').map(Number.parseFloat);
    expect([x, y]).toEqual([expect.closeTo(column('x_m'), 3), expect.closeTo(column('y_m'), 3)]);
    await expect.poll(() => tab.$$eval('.facts.message', (all) => all.map((e) => (e as HTMLTableElement).rows.length > 5))).toEqual([true, true]);
    expect(await tab.$$eval('.run-inspector .danger', (all) => all.map((e) => (e as HTMLElement).hidden))).toEqual([false, true]);
    await tab.keyboard.press('Delete');
    await settle(tab);
    await expect.poll(() => captions(tab)).toEqual([expect.stringContaining('1 dead'), expect.not.stringContaining('dead')]);
    await expectEvent(tab, 'died');
    await tab.click('text=Copy link');
    await expect.poll(() => tab.textContent('.notice')).toContain('no address');
    await tab.click('.stage[data-run="1"] .close-run');
    expect(await tab.$$('.stage')).toHaveLength(1);
    await expect.poll(() => captions(tab)).toEqual([expect.stringMatching(/^outwards/)]);
    expect(errors).toEqual([]);
  });
});
