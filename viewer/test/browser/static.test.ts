// SPDX-License-Identifier: MIT
// The page as plain files from any web server, in a folder of its own.
import { createReadStream, existsSync, readFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import { createRequire } from 'node:module';
import type { AddressInfo } from 'node:net';
import { extname, join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { launch, open, page } from './harness';
import { settle, waitForRun } from './visitor';

const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml' };
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
afterAll(() => server?.close());

describe('the page without banyan view', () => {
  it('begins with a run that moves', async () => {
    const { tab, errors } = await open(browser, address);
    await waitForRun(tab);
    expect(await tab.title()).toContain('three-targets');
    await tab.waitForFunction(() => Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) > 0.5);
    expect(errors).toEqual([]);
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

  it.each(['light', 'dark'])('has nothing serious for axe to find: %s', async (theme) => {
    const { tab } = await open(browser, address);
    await waitForRun(tab);
    await tab.click('.tour >> text=Skip');
    if (theme === 'dark') await tab.keyboard.press('m');
    await playedTo(tab, 2);
    await tab.keyboard.press(' ');
    await settle(tab);
    await tab.evaluate(readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
    const found: string[] = [];
    const others = theme === 'light' ? ['robot', 'events', 'view'] : []; // each takes a while
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
});
