// SPDX-License-Identifier: MIT
// Ticks per second of the simulation in the page's worker by the number of threads, in headless Chromium; the page is
// open but stands still.
//   ./banyan view --no-open     and, in another terminal:     node viewer/bench/threads.mjs ADDRESS [SCENARIO…]
import { readFileSync } from 'node:fs';
import { loadavg } from 'node:os';
import { fileURLToPath } from 'node:url';
import { chromium } from 'playwright-core';

const [address, ...names] = process.argv.slice(2);
if (!address) throw new Error('usage: node viewer/bench/threads.mjs ADDRESS [SCENARIO…]');
const rounds = 2; // all numbers of threads in turn, since other work of the machine changes
const toS = 3;

/** In the page: seconds for the ticks up to `toS`, after the first one, which reads and places. */
function simulate([worker, name, text, threads, endS]) {
  return new Promise((done, fail) => {
    const live = new Worker(worker, { type: 'module' });
    let begun = 0;
    const ask = () => live.postMessage({ type: 'frames', id: 1, fromS: 0, toS: begun === 0 ? 0 : endS, stride: 1 });
    live.onmessage = ({ data }) => {
      if (data.type === 'failed') fail(new Error(data.text));
      if (data.type === 'header' && data.header.endS === 0) ask();
      if (data.type !== 'frames') return;
      if (begun === 0) begun = performance.now();
      else if (data.endS >= endS - 1e-9) {
        live.terminate();
        return done((performance.now() - begun) / 1000);
      }
      ask();
    };
    live.postMessage({ type: 'open_live', run: { name, text, overrides: [], threads } });
  });
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
const page = await browser.newPage();
await page.goto(address);
await page.waitForFunction(() => document.title.includes('– Banyan'));
await page.evaluate(() => window.banyan.player.pause());
const worker = page.workers().map((w) => w.url()).find((url) => url.includes('live.worker'));
for (const name of names.length > 0 ? names : ['swarm-1000', 'swarm-10000']) {
  const text = readFileSync(fileURLToPath(new URL(`../../scenarios/${name}.toml`, import.meta.url)), 'utf8');
  const best = { 1: Infinity, 2: Infinity, 4: Infinity };
  for (let k = 0; k < rounds; ++k) {
    for (const threads of [1, 2, 4]) best[threads] = Math.min(best[threads], await page.evaluate(simulate, [worker, `${name}.toml`, text, threads, toS]));
  }
  const rates = Object.entries(best).map(([threads, seconds]) => `${threads}: ${(toS * 10 / seconds).toFixed(1)}`);
  console.log(`${name.padEnd(16)} ticks/s by threads, the best of ${rounds}: ${rates.join(', ')}   (load ${loadavg()[0].toFixed(1)})`);
}
await browser.close();
