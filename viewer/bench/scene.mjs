// SPDX-License-Identifier: MIT
// How fast is the picture? Draws made-up swarms in headless Chromium without a GPU, at 1280x720, and prints a table.
//   node viewer/bench/scene.mjs             the page's own Scene
//   node viewer/bench/scene.mjs --compare   and the plain drawings that decided between Canvas 2D and PixiJS; the
//                                           latter if it is there: npm install --no-save pixi.js@8
// CHROMIUM is the browser's path, /usr/bin/chromium if unset. Times depend on what else the machine does: its load
// is printed, and so is the processor time of all of Chromium's processes, which depends on it less.
import { createRequire } from 'node:module';
import { loadavg, cpus } from 'node:os';
import { fileURLToPath } from 'node:url';
import { readFile } from 'node:fs/promises';
import { chromium } from 'playwright-core';
import { build } from 'esbuild';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];
const seconds = 4;

async function bundle() {
  const built = await build({ entryPoints: [here('page.ts')], bundle: true, write: false, format: 'iife', target: 'es2022' });
  return built.outputFiles[0].text;
}

async function pixi() {
  try {
    const main = createRequire(import.meta.url).resolve('pixi.js');
    return await readFile(main.replace(/lib[\\/][^\\/]+$/, 'dist/pixi.min.js'), 'utf8');
  } catch {
    return null;
  }
}

async function cpuSeconds(session) {
  const { processInfo } = await session.send('SystemInfo.getProcessInfo');
  return processInfo.reduce((sum, process) => sum + process.cpuTime, 0);
}

async function run(title, renderer, args, scripts) {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: [...flags, ...args] });
  const session = await browser.newBrowserCDPSession();
  console.log(`\n${title}`);
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
    page.on('pageerror', (error) => console.log(`  ${error.message}`));
    for (const content of scripts) await page.addScriptTag({ content });
    const layouts = await page.evaluate(() => window.layouts);
    for (const [index, layout] of layouts.entries()) {
      const before = await cpuSeconds(session);
      const count = await page.evaluate(([r, k, s]) => window.measure(r, k, s), [renderer, index, seconds]);
      const cpu = (await cpuSeconds(session)) - before;
      const pictures = count.fps * seconds + 45;
      console.log(`  ${layout.name.padEnd(30)} ${String(count.links).padStart(6)} links  ${count.fps.toFixed(1).padStart(5)} fps (goal ${layout.goalFps})` +
        `  ${count.medianMs.toFixed(1).padStart(6)} ms, p95 ${count.p95Ms.toFixed(1).padStart(6)} ms  CPU ${((1000 * cpu) / pictures).toFixed(0).padStart(4)} ms/picture  ${count.about}`);
    }
  } catch (error) {
    console.log(`  does not work: ${String(error.message).split('\n')[0]}`);
  }
  await browser.close();
}

const code = await bundle();
console.log(`${cpus().length} processors, ${cpus()[0].model.trim()}; load ${loadavg()[0].toFixed(1)} at the start`);
if (process.argv.includes('--compare')) {
  await run('plain picture, Canvas 2D', 'canvas', [], [code]);
  const library = await pixi();
  if (!library) console.log('\nPixiJS is not installed: npm install --no-save pixi.js@8');
  else {
    await run('plain picture, PixiJS 8, as the browser comes', 'pixi', [], [library, code]);
    await run('plain picture, PixiJS 8, without antialiasing', 'jagged', [], [library, code]);
  }
} else {
  await run('Scene, playing', 'scene', [], [code]);
  await run('Scene, playing while the camera moves', 'panning', [], [code]);
  await run('Scene, playing with line of sight, blocked links shown', 'sight', [], [code]);
}
console.log(`load ${loadavg()[0].toFixed(1)} at the end`);
