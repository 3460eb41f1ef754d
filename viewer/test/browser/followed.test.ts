// SPDX-License-Identifier: MIT
// A mission in the page while it happens: a fleet of processes, its recording, the program that serves it, a visitor.
import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, expect, it } from 'vitest';
import { Folder, launch, open, program, scenario, Server } from './harness';
import { seekTo, timeShown, waitForRun } from './visitor';

const folder = new Folder();
let browser: Browser, server: Server, fleet: ChildProcess;

async function until(what: () => boolean): Promise<void> {
  for (let k = 0; k < 1000 && !what(); ++k) await new Promise((resolve) => setTimeout(resolve, 20));
  expect(what()).toBe(true);
}

beforeAll(async () => {
  const out = join(folder.path, 'fleet');
  fleet = spawn(program, ['fleet', scenario('khepera-three-targets'), '--loopback', '--speed', '4', '--out', out, '--quiet',
    '--set', 'mission.stop_when_complete=false', '--set', 'mission.time_limit_s=50'], { stdio: 'inherit' });
  await until(() => existsSync(join(out, 'run.mcap.part')));
  [server, browser] = await Promise.all([Server.start('--wait', join(out, 'run.mcap')), launch()]);
}, 60_000);
afterAll(async () => {
  await server?.stop();
  fleet?.kill('SIGTERM');
  folder.remove();
});

const newest = (tab: Page) => tab.evaluate(() => (window as unknown as { banyan: { player: { endS: number } } }).banyan.player.endS);

it('is shown live, can be scrubbed back, and ends with its result', async () => {
  const { tab, errors } = await open(browser, server.url);
  await waitForRun(tab);
  const live = tab.locator('button.newest');
  await live.waitFor();
  expect(await live.getAttribute('aria-pressed')).toBe('true');
  const seenS = await newest(tab);
  await tab.waitForFunction((s) => (window as unknown as { banyan: { player: { endS: number } } }).banyan.player.endS > s + 8, seenS);
  const [shownS, endS] = [await timeShown(tab), await newest(tab)];
  expect(shownS).toBeGreaterThan(seenS); // it went on by itself
  expect(endS - shownS).toBeLessThan(16); // four pieces of a second at this speed
  await seekTo(tab, 2);
  expect(await live.getAttribute('aria-pressed')).toBe('false');
  expect(await timeShown(tab)).toBe(2);
  await tab.keyboard.press('End');
  await tab.waitForSelector('button.newest[aria-pressed="true"]');
  if (process.env.BANYAN_SHOT) await tab.screenshot({ path: process.env.BANYAN_SHOT });
  await live.waitFor({ state: 'hidden' }); // the mission is over
  expect(await newest(tab)).toBe(50);
  const header = await tab.evaluate(() => (window as unknown as { banyan: { stages: { source: { header: { value: unknown } } }[] } }).banyan.stages[0].source.header.value);
  expect(header).toMatchObject({ following: false, warnings: [], result: { complete: 'true', ticks: '500' } });
  await tab.waitForFunction(() => (window as unknown as { banyan: { stages: { source: { series: { value: Record<string, ArrayLike<number>> } } }[] } })
    .banyan.stages[0].source.series.value.tick.length === 501);
  expect(errors).toEqual([]);
});
