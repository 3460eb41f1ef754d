// SPDX-License-Identifier: MIT
// A live run in the page: its address, its story, its keys, what is kept of it.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { banyan, scenario, served, Server } from './harness';
import { hashShown, isPlaying, killByKeys, lossShown, nativeHash, playTo, savedOfLive } from './live_run';
import { clickRobot, expectEvent, factsShown, placeOf, seekTo, settle, timeShown, waitForRun } from './visitor';

const { folder, visit } = served(() => scenario('three-targets'));

describe('a live run', () => {
  it('is an address, from which the page and the program come to the same hash', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 5);
    await killByKeys(tab, 5);
    await playTo(tab, 6);
    await tab.click('#tab-live');
    await tab.click('text=Blackout');
    await playTo(tab, 20);
    await clickRobot(tab, 3);
    const shown = await hashShown(tab);
    await tab.click('text=Copy link');
    await expect.poll(() => new URL(tab.url()).hash).toContain('do=');
    const link = tab.url().replace('?start', ''); // elsewhere
    expect(shown).toBe(`${nativeHash(folder, link, 200, 'linked')} at tick 200`);
    const again = await tab.context().newPage();
    await again.goto(link);
    await waitForRun(again);
    await expect.poll(() => timeShown(again)).toBeCloseTo(20);
    await expect.poll(() => again.textContent('.robot-head h2')).toBe('Robot 3');
    expect(await hashShown(again)).toBe(shown);
    for (const words of ['robot 5 died', 'blackout']) await expectEvent(again, words);
    await again.close();
    // Elsewhere, by `banyan view LINK`: on another port, and from another server's address.
    const server = await Server.start(link.replace(/^http:\/\/[^/]*/, 'https://example.org/elsewhere'));
    try {
      await tab.goto(server.url);
      await waitForRun(tab);
      await expect.poll(() => timeShown(tab)).toBeCloseTo(20);
      expect(await hashShown(tab)).toBe(shown);
      expect(await tab.textContent('.robot-head h2')).toBe('Robot 3');
    } finally {
      await server.stop();
    }
    expect(errors).toEqual([]);
  });

  it('says what was done and how it ended: in caption, list and story', async () => {
    const { tab } = await visit();
    await playTo(tab, 3);
    await tab.click('#tab-live');
    await tab.fill('#live-loss', '0.3');
    await tab.dispatchEvent('#live-loss', 'change');
    await settle(tab);
    await expect.poll(() => tab.textContent('.caption')).toContain('30 % loss');
    await tab.click('text=Blackout');
    await settle(tab);
    await expect.poll(() => tab.textContent('.caption')).toContain('blackout');
    await expect.poll(() => tab.textContent('.story')).toMatch(/^[0-3] of 3 targets held/);
    await playTo(tab, 60);
    await expect.poll(() => tab.textContent('.story')).toMatch(/^Complete after \d+\.\d s · \d+ of 18 robots used/);
    await expectEvent(tab, 'packet loss is 30 % from now on');
    await expectEvent(tab, 'blackout: nobody hears anything for 1 s');
    await tab.click('#tab-run');
    expect(await tab.textContent('.headline')).toMatch(/^Complete after/);
  });

  it('has places that are chosen by keys: a target is added and moved, an area dies', async () => {
    const { tab } = await visit();
    await playTo(tab, 2);
    const keys = async (...names: string[]) => { for (const name of names) await tab.keyboard.press(name); };
    await keys('t', 'ArrowUp', 'Shift+ArrowUp', 'Enter');
    await expect.poll(() => tab.textContent('.caption')).toContain('4 targets');
    const before = await placeOf(tab, 'target', 3);
    await keys('Shift+p', 'g', 'Shift+ArrowRight', 'Enter');
    await settle(tab);
    await expect.poll(async () => Math.round((await placeOf(tab, 'target', 3)).x - before.x)).toBeGreaterThan(30);
    await keys('k', 'ArrowUp', 'Enter', ...Array<string>(5).fill('Shift+ArrowLeft'), ...Array<string>(4).fill('Shift+ArrowDown'), 'Enter');
    await expect.poll(() => tab.textContent('.caption')).toMatch(/[1-9]\d* dead/);
  });

  it('is reset to its begin, without what was done', async () => {
    const { tab } = await visit();
    await playTo(tab, 5);
    await killByKeys(tab, 5);
    await playTo(tab, 7);
    await tab.click('#tab-live');
    await tab.click('button:text-is("Reset")');
    await settle(tab);
    expect(await timeShown(tab)).toBeLessThan(1);
    await playTo(tab, 20);
    expect(await hashShown(tab)).toBe(`${nativeHash(folder, scenario('three-targets'), 200, 'reset')} at tick 200`);
  });

  it('is reset from what was done before its first tick', async () => {
    const { tab } = await visit();
    await seekTo(tab, 0);
    await killByKeys(tab, 5);
    await settle(tab);
    await tab.click('#tab-live');
    await tab.click('button:text-is("Reset")');
    await playTo(tab, 2);
    expect(await tab.textContent('.caption')).not.toContain('dead');
  });

  it('shows loss and line of sight as they are at the moment that is shown', async () => {
    const { tab } = await visit();
    await playTo(tab, 3);
    await tab.click('#tab-live');
    expect(await lossShown(tab)).toBe(0);
    await tab.focus('#live-loss');
    await tab.keyboard.press('ArrowRight');
    await tab.keyboard.press('ArrowRight');
    const sight = await tab.isChecked('#live-sight');
    await tab.click('#live-sight');
    await settle(tab);
    await tab.waitForTimeout(200); // a while in which nothing may spring back
    expect(await lossShown(tab)).toBe(0.1);
    expect(await tab.isChecked('#live-sight')).toBe(!sight);
    const now = await timeShown(tab);
    expect(now).toBeGreaterThan(3.05); // it went on to where it is seen
    await seekTo(tab, 2);
    expect(await lossShown(tab)).toBe(0);
    expect(await tab.isChecked('#live-sight')).toBe(sight);
    await seekTo(tab, now);
    expect(await lossShown(tab)).toBe(0.1);
    await tab.click('button:text-is("Reset")');
    await settle(tab);
    await expect.poll(() => lossShown(tab)).toBe(0);
  });

  it('has its keys: 0 and Enter for robot 0, space for the clock after Start and after a click on a button', async () => {
    const { tab } = await visit();
    await tab.keyboard.press('0');
    await tab.keyboard.press('Enter');
    await expect.poll(() => tab.textContent('.robot-head h2')).toBe('Robot 0');
    await tab.click('#tab-live');
    await tab.fill('#live-seed', '7');
    await tab.click('text=Start');
    await tab.waitForFunction(() => document.querySelector('.what-runs')?.textContent?.includes('seed 7'));
    await tab.waitForFunction(() => document.activeElement?.matches('button.play'));
    expect(await isPlaying(tab)).toBe(true);
    await tab.keyboard.press(' ');
    await settle(tab);
    expect(await isPlaying(tab)).toBe(false);
    await tab.click('text=Blackout');
    await settle(tab);
    await tab.keyboard.press(' ');
    await settle(tab);
    expect(await isPlaying(tab)).toBe(true);
    const text = readFileSync(await savedOfLive(tab, 'Save .toml', folder), 'utf8');
    expect(text.split('kind = "blackout"')).toHaveLength(2); // one of it
  });

  it('says nothing of a run that is no longer there', async () => {
    const { tab } = await visit();
    await playTo(tab, 1);
    await tab.evaluate(() => {
      const { stages } = (window as unknown as { banyan: { stages: { source: { intervene(): Promise<void> } }[] } }).banyan;
      stages[0].source.intervene = () => new Promise((_, reject) => { Object.assign(window, { failLate: () => reject(new Error('too late')) }); });
    });
    await killByKeys(tab, 5);
    await tab.click('#tab-live');
    await tab.fill('#live-seed', '9');
    await tab.click('text=Start');
    await tab.waitForFunction(() => document.querySelector('.what-runs')?.textContent?.includes('seed 9'));
    await tab.evaluate(() => (window as unknown as { failLate(): void }).failLate());
    await settle(tab);
    expect(await tab.textContent('.stages')).not.toContain('too late');
  });

  it('is saved as a recording that the program reads', async () => {
    const { tab } = await visit();
    await playTo(tab, 6);
    const file = await savedOfLive(tab, 'Save .mcap', folder);
    const csv = banyan('export', file, '--csv');
    expect(csv.includes('\n50,5.0000,')).toBe(true);
  });

  it('two algorithms run side by side with the same seed and one clock', async () => {
    const { tab, errors } = await visit();
    await tab.click('#tab-live');
    await tab.selectOption('#live-algorithm', 'outwards');
    await tab.selectOption('#live-versus', 'inwards');
    await tab.fill('#live-seed', '5');
    await tab.click('text=Start');
    await tab.waitForFunction(() => document.querySelectorAll('.stage').length === 2);
    await playTo(tab, 3);
    const captions = () => tab.$$eval('.caption', (all) => all.map((e) => e.textContent ?? '').join(' | '));
    await expect.poll(captions).toMatch(/outwards.*\|.*inwards/);
    expect(await timeShown(tab)).toBeCloseTo(3);
    // One robot in both runs: what the page says of each is what its inspector says where it is clicked.
    await tab.keyboard.type('3');
    await tab.keyboard.press('Enter');
    await expect.poll(() => tab.$$eval('.in-all thead th', (all) => all.map((e) => e.textContent))).toEqual(['outwards', 'inwards']);
    const inAll = await tab.$$eval('.in-all tbody tr', (all) => all.map((row) => [...(row as HTMLTableRowElement).cells].map((cell) => cell.textContent ?? '')));
    for (const run of [0, 1]) {
      const at = await placeOf(tab, 'robot', 3, run);
      await tab.mouse.click(at.x, at.y);
      await expect.poll(() => tab.textContent('.run-inspector[open] > summary')).toBe(['outwards', 'inwards'][run]);
      await settle(tab);
      const facts = await factsShown(tab, '.run-inspector[open] .facts:not(.message)');
      expect(Object.fromEntries(inAll.map((row) => [row[0], row[1 + run]]))).toEqual(facts);
    }
    await tab.click('#tab-live');
    const names: string[] = [];
    tab.on('download', (download) => names.push(download.suggestedFilename()));
    await tab.click('text=Save .toml');
    await expect.poll(() => names.sort()).toEqual(['three-targets-inwards.toml', 'three-targets-outwards.toml']);
    expect(errors).toEqual([]);
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
});
