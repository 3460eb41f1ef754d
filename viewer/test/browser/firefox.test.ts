// SPDX-License-Identifier: MIT
// The page in Debian's Firefox, as a smoke test: a run plays, a recording is opened.
import { existsSync } from 'node:fs';
import puppeteer, { type Browser, type Page } from 'puppeteer-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Folder, scenario, Server } from './harness';

const folder = new Folder();
let browser: Browser;
let live: Server;
let recording: Server;
let tab: Page;
const errors: string[] = [];

beforeAll(async () => {
  const executablePath = process.env.FIREFOX ?? '/usr/bin/firefox-esr';
  if (!existsSync(executablePath)) throw new Error('the package firefox-esr is not installed');
  live = await Server.start(scenario('three-targets'));
  recording = await Server.start(folder.record('run', scenario('three-targets')));
  browser = await puppeteer.launch({ browser: 'firefox', executablePath, headless: true });
  tab = await browser.newPage();
  tab.on('pageerror', (error) => errors.push(String(error)));
  await tab.setViewport({ width: 1280, height: 720 });
}, 120_000);
afterAll(async () => {
  await browser?.close();
  await live?.stop();
  await recording?.stop();
  folder.remove();
});

async function visit(server: Server): Promise<void> {
  await tab.goto(server.url);
  await tab.waitForFunction(() => document.title.includes('– Banyan'), { timeout: 60_000 });
}
const text = (selector: string) => tab.$eval(selector, (e) => e.textContent ?? '');
const until = (condition: string) => tab.waitForFunction(condition, { timeout: 30_000 });

describe('in Firefox', () => {
  it('a live run plays', async () => {
    await visit(live);
    await until("Number(document.querySelector('.timeline input').value) > 1");
    expect(await text('.caption')).toContain('18 robots');
  });

  it('a recording is read, and its end is told', async () => {
    await visit(recording);
    await tab.keyboard.press('End');
    await until("/Complete after/.test(document.querySelector('.story').textContent)");
    await until("document.querySelector('.plot .u-over') !== null");
    expect(errors).toEqual([]);
  });
});
