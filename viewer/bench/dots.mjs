// SPDX-License-Identifier: MIT
// Which way to draw 10,000 small squares is the fastest? Each way in headless Chromium without a GPU, at 1280x720; what
// counts is the processor time of all of its processes, which depends least on what else the machine does.
//   node viewer/bench/dots.mjs
import { loadavg } from 'node:os';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { chromium } from 'playwright-core';

const pictures = 80;
const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];

async function cpuS(session) {
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  return processInfo.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

async function measure(way, code) {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: flags });
  try {
    const session = await browser.newBrowserCDPSession();
    const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
    await page.addScriptTag({ content: code });
    const draw = (count) => page.evaluate(([name, n]) => window.draw(name, n), [way, count]);
    await draw(10); // warm
    const before = await cpuS(session);
    const fps = await draw(pictures);
    const ms = (1000 * ((await cpuS(session)) - before)) / pictures;
    console.log(`${way.padEnd(28)} ${ms.toFixed(1).padStart(5)} ms of processor time per picture, ${fps.toFixed(0).padStart(3)} pictures/s`);
  } finally {
    await browser.close();
  }
}

const entry = fileURLToPath(new URL('dots.ts', import.meta.url));
const built = await build({ entryPoints: [entry], bundle: true, write: false, format: 'iife', target: 'es2022' });
console.log(`load ${loadavg()[0].toFixed(1)}`);
for (const way of ['nothing', 'fillRect', 'own pixels', 'off-screen, in a worker', 'WebGL, in the picture', 'WebGL alone']) await measure(way, built.outputFiles[0].text);
