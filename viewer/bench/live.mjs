// SPDX-License-Identifier: MIT
// Frames per second of the whole page while it simulates, in Chromium without a GPU.
//   ./banyan view --no-open     and, in another terminal:     node viewer/bench/live.mjs ADDRESS [SCENARIO…]
import { chromium } from 'playwright-core';

const [address, ...names] = process.argv.slice(2);
if (!address) throw new Error('usage: node viewer/bench/live.mjs ADDRESS [SCENARIO…]');
const settleMs = 4000;
const measureMs = 5000;

/** In the page: how often it draws, and how long all but the slowest twentieth of the pictures take. */
function measure(forMs) {
  return new Promise((done) => {
    const begin = performance.now();
    const lengths = [];
    let last = begin;
    requestAnimationFrame(function next(now) {
      lengths.push(now - last);
      last = now;
      const elapsed = performance.now() - begin;
      if (elapsed < forMs) return requestAnimationFrame(next);
      lengths.sort((a, b) => a - b);
      done({ fps: (1000 * lengths.length) / elapsed, p95Ms: lengths[Math.floor(0.95 * lengths.length)] });
    });
  });
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.goto(address);
for (const name of names.length > 0 ? names : ['three-targets', 'paper-large', 'benchmark-1000']) {
  await page.click('#tab-live');
  await page.selectOption('#live-scenario', name);
  await page.click('button[type=submit]');
  await page.waitForFunction((title) => document.title.startsWith(title), name);
  await page.waitForTimeout(settleMs);
  const { fps, p95Ms } = await page.evaluate(measure, measureMs);
  const robots = await page.textContent('.caption');
  console.log(`${name.padEnd(16)} ${fps.toFixed(1).padStart(5)} frames/s, 95 % within ${p95Ms.toFixed(0)} ms   (${robots})`);
}
await browser.close();
