// SPDX-License-Identifier: MIT
// How soon a recording is there, in Chromium without a GPU: the first picture, the plots of the whole run,
// a jump to its middle, and how much was read until then.
//   ./banyan view run.mcap --no-open     and, in another terminal:     node viewer/bench/open.mjs ADDRESS
import { chromium } from 'playwright-core';

const [address] = process.argv.slice(2);
if (!address) throw new Error('usage: node viewer/bench/open.mjs ADDRESS');
const times = 5;

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});

const jump = (share) => {
  const input = document.querySelector('.timeline input');
  input.value = String(share * Number(input.max));
  input.dispatchEvent(new Event('input', { bubbles: true }));
};
const shown = (fromS) => window.banyan.stages.every((stage) => stage.shown !== null && stage.shown.timeS >= fromS);

for (let i = 0; i < times; ++i) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  const page = await context.newPage();
  let read = 0;
  page.on('response', (response) => {
    if (response.status() === 206) read += Number(response.headers()['content-length'] ?? 0);
  });
  const begin = performance.now();
  const since = () => ((performance.now() - begin) / 1000).toFixed(2);
  await page.goto(address);
  await page.waitForFunction(() => window.banyan?.stages.length > 0);
  await page.waitForFunction(shown, 0);
  const first = `first picture ${since()} s (${(read / 1e6).toFixed(1)} MB read)`;
  await page.waitForFunction(() => [...document.querySelectorAll('.plot-value')].some((value) => /\d/.test(value.textContent)));
  const plots = `plots ${since()} s (${(read / 1e6).toFixed(1)} MB)`;
  const jumped = performance.now();
  await page.evaluate(jump, 0.5);
  const half = await page.$eval('.timeline input', (input) => 0.5 * Number(input.max) - 1);
  await page.waitForFunction(shown, half);
  console.log(`${first}, ${plots}, jump to the middle ${((performance.now() - jumped) / 1000).toFixed(2)} s`);
  await context.close();
}
await browser.close();
