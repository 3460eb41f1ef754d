// SPDX-License-Identifier: MIT
// The page as plain files from any web server, in a folder of its own, with a recording dropped on it.
import { createReadStream, existsSync, readFileSync } from 'node:fs';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join } from 'node:path';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Folder, launch, open, page, scenario } from './harness';
import { seekTo, timeShown, waitForRun } from './visitor';

const types: Record<string, string> = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.svg': 'image/svg+xml' };
const folder = new Folder();
let browser: Browser;
let server: Server;
let address: string;

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
  await browser?.close();
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
    const context = await browser.newContext({ reducedMotion: 'reduce' });
    const tab = await context.newPage();
    await tab.goto(address);
    await waitForRun(tab);
    expect(await tab.$('button.play[aria-label^="Play"]')).not.toBeNull();
    const then = await timeShown(tab);
    await tab.waitForTimeout(300);
    expect(await timeShown(tab)).toBe(then);
    await context.close();
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

  it('opens a recording and a scenario that are dropped on it', async () => {
    const { tab, errors } = await open(browser, address);
    await waitForRun(tab);
    const drop = async (name: string, path: string) => {
      const bytes = readFileSync(path).toString('base64');
      const data = await tab.evaluateHandle(([file, base64]) => {
        const transfer = new DataTransfer();
        transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], file));
        return transfer;
      }, [name, bytes] as const);
      for (const type of ['dragenter', 'dragover', 'drop']) await tab.dispatchEvent('html', type, { dataTransfer: data });
      await tab.waitForFunction((file) => document.title.startsWith(file), name);
    };
    await drop('mine.mcap', folder.record('run', scenario('three-targets')));
    await seekTo(tab, 3);
    expect(await timeShown(tab)).toBeCloseTo(3);
    await drop('mine.toml', scenario('rooms'));
    await expect.poll(() => tab.textContent('.caption')).toContain('36 robots');
    expect(errors).toEqual([]);
  });
});
