// SPDX-License-Identifier: MIT
// The page as plain files from any web server, in a folder of its own, with a recording dropped on it.
import { createReadStream, existsSync, readFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import { createRequire } from 'node:module';
import type { AddressInfo } from 'node:net';
import { extname, join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Folder, launch, newContext, open, page, scenario } from './harness';
import { placeOf, seekTo, settle, timeShown, waitForRun } from './visitor';

const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml' };
const folder = new Folder();
let browser: Browser;
let server: Server;
let address: string;

const playedTo = (tab: Page, timeS: number) =>
  tab.waitForFunction((t) => Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) > t, timeS);

beforeAll(async () => {
  server = createServer((request, response) => {
    const name = new URL(request.url ?? '/', 'http://localhost').pathname.replace(/^\/some\/folder\//, '') || 'index.html';
    const file = join(page, name);
    if (!existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    createReadStream(file).pipe(response);
  });
  await new Promise<void>((ready) => server.listen(0, '127.0.0.1', ready));
  address = `http://127.0.0.1:${(server.address() as AddressInfo).port}/some/folder/`;
  browser = await launch();
}, 60_000);
afterAll(async () => {
  server?.close();
  folder.remove();
});

describe('the page without banyan view', () => {
  it('begins with a run that moves', async () => {
    const { tab, errors } = await open(browser, address);
    await waitForRun(tab);
    expect(await tab.title()).toContain('three-targets');
    await tab.waitForFunction(() => Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) > 0.5);
    expect(errors).toEqual([]);
  });

  it('begins with the scenario that its address names', async () => {
    const { tab } = await open(browser, `${address}#rooms`);
    await waitForRun(tab);
    expect(await tab.title()).toContain('rooms');
  });

  it('follows its address while it is open', async () => {
    const { tab, errors } = await open(browser, address);
    await waitForRun(tab);
    await tab.evaluate(() => { location.hash = '#rooms'; });
    await tab.waitForFunction(() => document.title.includes('rooms'));
    await tab.evaluate(() => { location.hash = '#no-such-place'; });
    await expect.poll(() => tab.textContent('body')).toContain('There is no scenario “no-such-place”');
    expect(errors).toEqual([]);
  });

  it('stands still for a visitor who wants no motion', async () => {
    const context = await newContext(browser, { reducedMotion: 'reduce' });
    const tab = await context.newPage();
    await tab.goto(address);
    await waitForRun(tab);
    expect(await tab.$('button.play[aria-label^="Play"]')).not.toBeNull();
    const then = await timeShown(tab);
    await tab.waitForTimeout(300);
    expect(await timeShown(tab)).toBe(then);
  });

  it('loads nothing from elsewhere', async () => {
    const { tab } = await open(browser, address);
    await waitForRun(tab);
    const refused = await tab.evaluate(() => new Promise<string>((said) => {
      document.addEventListener('securitypolicyviolation', (event) => said(event.effectiveDirective));
      void fetch('https://example.org/').catch(() => {});
    }));
    expect(refused).toBe('connect-src');
  });

  it('shows a newcomer around, who may leave, and not twice', async () => {
    const { tab, errors } = await open(browser, address);
    await waitForRun(tab);
    await tab.waitForSelector('.tour:visible');
    for (let k = 0; k < 5; ++k) await tab.click('.tour >> text=Next');
    await playedTo(tab, 2);
    await tab.click('.tour button:text-is("Kill a connector")'); // its words are in the text, too
    await expect.poll(() => tab.textContent('.caption')).toContain('1 dead');
    await tab.click('.tour >> text=Skip');
    await tab.reload();
    await waitForRun(tab);
    expect(await tab.isVisible('.tour')).toBe(false);
    expect(errors).toEqual([]);
  });

  it('says what it waits for, also where it cannot run at all', async () => {
    const context = await newContext(browser, { javaScriptEnabled: false });
    const tab = await context.newPage();
    await tab.goto(address);
    expect(await tab.isVisible('text=loading …')).toBe(true);
    await expect.poll(() => tab.$eval('.late', (e) => getComputedStyle(e).opacity), { timeout: 10_000 }).toBe('1');
    expect(await tab.textContent('.late')).toContain('banyan view');
  });

  it.each([['light', 1280, 720], ['dark', 1280, 720], ['light', 390, 844]] as const)('has nothing serious for axe to find: %s, %d px', async (theme, width, height) => {
    const { tab } = await open(browser, address, { width, height });
    await waitForRun(tab);
    await tab.click('.tour >> text=Skip');
    if (theme === 'dark') await tab.keyboard.press('m');
    await playedTo(tab, 2);
    await tab.keyboard.press(' ');
    await settle(tab);
    await tab.evaluate(readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
    const found: string[] = [];
    const others = theme === 'light' && width > 1000 ? ['robot', 'events', 'view'] : []; // each takes a while
    const look = async () => {
      await settle(tab);
      found.push(...await tab.evaluate(async () => {
        const { axe } = window as unknown as { axe: { run(): Promise<{ violations: { id: string; impact: string; nodes: { html: string }[] }[] }> } };
        const { violations } = await axe.run();
        return violations.filter(({ impact }) => impact === 'serious' || impact === 'critical').map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(' ')}`);
      }));
    };
    for (const panel of ['run', ...others, 'live']) {
      await tab.click(`#tab-${panel}`);
      await look();
    }
    await tab.click('text=Many seeds …');
    await tab.waitForSelector('.many-summary table');
    await look();
    expect([...new Set(found)]).toEqual([]);
  });

  it('has on a phone the picture and a panel in sight at once, and nothing to scroll but that', async () => {
    const { tab } = await open(browser, address, { width: 390, height: 844 });
    await waitForRun(tab);
    await tab.click('.tour >> text=Skip');
    await tab.click('#tab-live');
    await tab.click('text=Add target'); // scrolls the panel
    const inSight = (selector: string) => tab.$eval(selector, (e) => { const box = e.getBoundingClientRect(); return box.top >= 0 && box.bottom <= innerHeight && box.height > 0; });
    for (const selector of ['.stage canvas', '.notice', '.transport']) expect(await inSight(selector), selector).toBe(true);
    expect(await tab.evaluate(() => document.documentElement.scrollHeight <= innerHeight && document.documentElement.scrollWidth <= innerWidth)).toBe(true);
    await tab.click('#tab-plots');
    expect(await tab.isVisible('.plot')).toBe(true);
  });

  it('opens a recording and a scenario that are dropped on it', async () => {
    const { tab, errors } = await open(browser, address);
    await waitForRun(tab);
    const drop = async (name: string, path: string, twice = false) => {
      const bytes = readFileSync(path).toString('base64');
      const data = await tab.evaluateHandle(([file, base64, count]) => {
        const transfer = new DataTransfer();
        for (let k = 0; k < count; ++k) transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], file));
        return transfer;
      }, [name, bytes, twice ? 2 : 1] as const);
      for (const type of ['dragenter', 'dragover', 'drop']) await tab.dispatchEvent('html', type, { dataTransfer: data });
      await tab.waitForFunction((file) => document.title.startsWith(file), name);
    };
    await drop('mine.mcap', folder.record('run', scenario('three-targets'), '--force'));
    await seekTo(tab, 3);
    expect(await timeShown(tab)).toBeCloseTo(3);
    await drop('both.mcap', join(folder.path, 'run', 'run.mcap'), true);
    await tab.waitForFunction(() => document.querySelectorAll('.stage').length === 2);
    await tab.mouse.move(300, 300);
    await tab.mouse.wheel(0, -300);
    await settle(tab);
    const [first, second] = [await placeOf(tab, 'robot', 3, 0), await placeOf(tab, 'robot', 3, 1)];
    const width = await tab.$eval('.stage', (e) => e.getBoundingClientRect().width);
    expect(Math.abs(second.x - first.x - width)).toBeLessThan(2); // one camera
    await drop('mine.toml', scenario('rooms'));
    await expect.poll(() => tab.textContent('.caption')).toContain('36 robots');
    expect(errors).toEqual([]);
  });
});
