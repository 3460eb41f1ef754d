// SPDX-License-Identifier: MIT
// Runs side by side whatever they are: recordings beside live ones, other scenarios, many seeds at once.
import { describe, expect, it } from 'vitest';
import type { Page } from 'playwright-core';
import { banyan, scenario, served } from './harness';
import { playTo } from './live_run';
import { expectEvent, factsShown, seekTo, settle } from './visitor';

const { folder, visit } = served(() => scenario('three-targets'));

/** Until so many runs are shown. */
const shown = (tab: Page, count: number) => tab.waitForFunction((n) => document.querySelectorAll('.stage').length === n, count);
const stages = (tab: Page) => tab.$$eval('.stage', (all) => all.length);
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

async function resultOf(seed: number): Promise<Record<string, number | boolean>> {
  const json = banyan('run', scenario('three-targets'), '--seed', String(seed), '--no-record', '--json', '--force', '--out', `${folder.path}/seed-${seed}`);
  return (JSON.parse(json) as { result: Record<string, number | boolean> }).result;
}

describe('side by side', () => {
  it('a recording stands beside a live run: one clock, an inspector each, and only one can be interfered with', async () => {
    const file = folder.record('other', scenario('three-targets'), '--seed', '4', '--set', 'mission.algorithm=outwards', '--set', 'swarm.redundancy=4', '--force');
    const { tab, errors } = await visit();
    await addFile(tab, file);
    await shown(tab, 2);
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
    expect(await stages(tab)).toBe(1);
    await expect.poll(() => captions(tab)).toEqual([expect.stringMatching(/^outwards/)]);
    expect(errors).toEqual([]);
  });

  it('runs of other scenarios are added, and a link shows all of them again', async () => {
    const { tab, errors } = await visit();
    await tab.click('#tab-live');
    await tab.selectOption('#live-scenario', 'rooms');
    await tab.selectOption('#live-algorithm', 'inwards');
    await tab.fill('#live-seed', '9');
    await tab.click('text=Add beside');
    await shown(tab, 2);
    await playTo(tab, 2);
    const places = (page: Page) => page.evaluate(() => {
      const { stages: all } = (window as unknown as { banyan: { stages: { shown: { data: Float64Array } }[] } }).banyan;
      return all.map(({ shown }) => shown.data[0]);
    });
    const before = await places(tab);
    await tab.click('text=Copy link');
    await expect.poll(() => tab.evaluate(() => location.hash)).toContain('beside=');
    const address = await tab.evaluate(() => location.href.replace('?start', ''));
    await tab.goto('about:blank');
    await tab.goto(address);
    await shown(tab, 2);
    await expect.poll(() => places(tab)).toEqual(before);
    expect(banyan('run', address, '--no-record', '--force', '--out', `${folder.path}/linked`)).toContain('three-targets');
    expect(errors).toEqual([]);
  });

  it('many seeds are shown small with what they come to, and one of them is opened', async () => {
    const { tab, errors } = await visit();
    await tab.click('#tab-live');
    await tab.click('text=Many seeds …');
    await tab.selectOption('#many-count', '4');
    await tab.fill('#many-first', '11');
    await tab.click('.many button[type=submit]');
    await expect.poll(() => tab.textContent('.many-summary h3'), { timeout: 30_000 }).toBe('4 of 4 runs have ended');
    const native = await Promise.all([11, 12, 13, 14].map(resultOf));
    const times = native.map((r) => Number(r.completion_time_s)).sort((a, b) => a - b);
    const shown = await tab.$$eval('.many-summary tbody tr', (all) => Object.fromEntries(all.map((r) => [r.children[0].textContent, r.children[1].textContent])));
    expect(shown.complete).toBe(`${native.filter((r) => r.complete).length} of 4`);
    expect(shown['complete after']).toBe(`${((times[1] + times[2]) / 2).toFixed(1)} s (${times[0].toFixed(1)} s to ${times[3].toFixed(1)} s)`);
    const inked = await tab.$$eval('.small canvas', (all) => all.map((e) => {
      const canvas = e as HTMLCanvasElement;
      return new Set(new Uint32Array(canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size > 10;
    }));
    expect(inked).toEqual([true, true, true, true]);
    await tab.click('.small >> nth=2');
    await expect.poll(() => tab.textContent('.what-runs')).toContain('seed 13');
    expect(errors).toEqual([]);
  });

  it('any field of what a robot says is plotted, in all runs', async () => {
    const { tab } = await visit();
    await tab.click('#tab-live');
    await tab.selectOption('#live-versus', 'outwards');
    await tab.click('text=Start');
    await shown(tab, 2);
    await tab.keyboard.type('5');
    await tab.keyboard.press('Enter');
    await playTo(tab, 3);
    const said = async (run: number) => factsShown(tab, `.run-inspector:nth-of-type(${run}) .facts.message`);
    await openInspectors(tab);
    await expect.poll(async () => (await said(1)).seqno ?? '…').not.toBe('…');
    await expect.poll(async () => (await said(2)).seqno ?? '…').not.toBe('…');
    await expect.poll(() => tab.$$eval('.plot:first-child option', (all) => all.map((e) => (e as HTMLOptionElement).value))).toContain('robot says seqno');
    await tab.selectOption('.plot:first-child select', 'robot says seqno');
    const [first, second] = [Number((await said(1)).seqno), Number((await said(2)).seqno)];
    expect(first).toBeGreaterThan(0);
    await expect.poll(async () => (await tab.textContent('.plot:first-child .plot-value'))!.split(' | ').map(Number)).toEqual([first, second]);
  });
});
