// SPDX-License-Identifier: MIT
// Frames per second of the whole page while it simulates, in Chromium without a GPU; and, for machines that have other
// things to do, the processor time that the page's own thread spends on a picture.
//   ./banyan view --no-open     and, in another terminal:     node viewer/bench/live.mjs ADDRESS [SCENARIO…]
import { chromium } from 'playwright-core';

const [address, ...names] = process.argv.slice(2);
if (!address) throw new Error('usage: node viewer/bench/live.mjs ADDRESS [SCENARIO…]');
const settleMs = 4000;
const measureMs = 5000;

/** In the page: how often it could draw and how long all but the slowest twentieth of the pictures take; how many of
 *  them show another moment than the last; and how much is simulated in a second. */
function measure(forMs) {
  const { player } = window.banyan;
  return new Promise((done) => {
    const begin = performance.now();
    const fromS = player.timeS;
    const lengths = [];
    let last = begin, shownS = fromS, moved = 0;
    requestAnimationFrame(function next(now) {
      lengths.push(now - last);
      last = now;
      if (player.timeS !== shownS) ++moved;
      shownS = player.timeS;
      const elapsed = performance.now() - begin;
      if (elapsed < forMs) return requestAnimationFrame(next);
      lengths.sort((a, b) => a - b);
      const perS = 1000 / elapsed;
      done({ fps: lengths.length * perS, moving: moved * perS, pace: (player.timeS - fromS) * perS, pictures: lengths.length,
        p95Ms: lengths[Math.floor(0.95 * lengths.length)] });
    });
  });
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
const session = await page.context().newCDPSession(page);
await session.send('Performance.enable', { timeDomain: 'threadTicks' });
/** Processor time of the page's thread so far, s. */
const busyS = async () => (await session.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'TaskDuration').value;
await page.goto(address);
for (const name of names.length > 0 ? names : ['three-targets', 'paper-large', 'benchmark-1000']) {
  await page.click('#tab-live');
  await page.selectOption('#live-scenario', name);
  await page.click('button[type=submit]');
  await page.waitForFunction((title) => document.title.startsWith(title), name);
  await page.waitForTimeout(settleMs);
  const before = await busyS();
  const { fps, moving, pace, p95Ms, pictures } = await page.evaluate(measure, measureMs);
  const eachMs = (1000 * ((await busyS()) - before)) / pictures;
  const robots = await page.textContent('.caption');
  console.log(`${name.padEnd(16)} ${fps.toFixed(1).padStart(5)} frames/s (${moving.toFixed(1)} of them moved), ${pace.toFixed(2)} s simulated per s, 95 % within ${p95Ms.toFixed(0)} ms, ${eachMs.toFixed(1)} ms of processor time each   (${robots})`);
}
await browser.close();
