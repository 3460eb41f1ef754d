// SPDX-License-Identifier: MIT
// Pictures of the scene, to look at: node viewer/bench/gallery.mjs RUNS OUT [NAME]
// RUNS has a folder per scenario with its run.mcap (banyan run scenarios/NAME.toml --out RUNS/NAME).
import { fileURLToPath } from 'node:url';
import { mkdirSync } from 'node:fs';
import { chromium } from 'playwright-core';
import { build } from 'esbuild';
import { readRecording } from './recording.mjs';

const on = { links: true, blocked: false, oldTree: true, trails: true, labels: false, ids: false };
const shots = [
  { name: 'three', run: 'three-targets', at: 6, theme: 'light' },
  { name: 'three-dark', run: 'three-targets', at: 6, theme: 'dark', view: { switches: { ...on, ids: true }, selection: { kind: 'robot', index: 3 } } },
  { name: 'large', run: 'paper-large', at: 35, theme: 'light', view: { switches: { ...on, blocked: true } } },
  { name: 'large-dark', run: 'paper-large', at: 35, theme: 'dark' },
  { name: 'large-old', run: 'paper-large', at: 43.5, theme: 'light', view: { switches: { ...on, ids: true } } },
  { name: 'large-near', run: 'paper-large', at: 26.1, theme: 'light', zoom: 3, where: { x: 2, y: 1 }, view: { switches: { ...on, ids: true, labels: true } } },
  { name: 'path', run: 'paper-large', at: 35, theme: 'light', zoom: 1.7, where: { x: 0, y: 0 }, view: { selection: { kind: 'robot', index: 88 }, hovered: { kind: 'robot', index: 58 } } },
  { name: 'path-dark', run: 'paper-large', at: 60, theme: 'dark', zoom: 1.7, where: { x: 0, y: 0 }, view: { selection: { kind: 'robot', index: 88 }, switches: { ...on, labels: true } } },
  { name: 'start', run: 'paper-large', at: 0, theme: 'light' },
  { name: 'rooms', run: 'rooms', at: 42, theme: 'light', view: { selection: { kind: 'target', index: 1 }, hovered: { kind: 'obstacle', index: 4 } } },
  { name: 'rooms-dark', run: 'rooms', at: 42, theme: 'dark', view: { switches: { ...on, blocked: true } } },
  { name: 'discs', run: 'scattered-discs', at: 30, theme: 'light', view: { dragged: { item: { kind: 'obstacle', index: 3 }, toM: { x: 3, y: 0 } } } },
  { name: 'deaths', run: 'deaths', at: 24, theme: 'light', view: { area: { minX: -1, minY: -1, maxX: 1, maxY: 2 } } },
  { name: 'deaths-now', run: 'deaths', at: 80.2, theme: 'dark' },
  { name: 'thousand', run: 'benchmark-1000', at: 16, theme: 'light' },
  { name: 'thousand-dark', run: 'benchmark-1000', at: 16, theme: 'dark' },
  { name: 'phone', run: 'paper-large', at: 60, theme: 'light', size: [390, 844] },
  { name: 'phone-dark', run: 'three-targets', at: 8.8, theme: 'dark', size: [390, 844] },
];

const [runs, out, only] = process.argv.slice(2);
mkdirSync(out, { recursive: true });
const built = await build({ entryPoints: [fileURLToPath(new URL('gallery.ts', import.meta.url))], bundle: true, write: false, format: 'iife', target: 'es2022' });
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'] });
const recordings = new Map();
for (const shot of shots.filter((s) => !only || s.name.includes(only))) {
  if (!recordings.has(shot.run)) recordings.set(shot.run, await readRecording(`${runs}/${shot.run}/run.mcap`));
  const { setting, frames } = recordings.get(shot.run);
  const index = Math.max(0, frames.findLastIndex((f) => f.timeS <= shot.at + 1e-9));
  const trails = [];
  for (let k = index - 5; k >= 0 && k > index - 80; k -= 5) trails.unshift(frames[k]);
  const [width, height] = shot.size ?? [1280, 720];
  const page = await browser.newPage({ viewport: { width, height }, deviceScaleFactor: shot.size ? 2 : 1 });
  page.on('pageerror', (e) => console.log(shot.name, e.stack));
  await page.addScriptTag({ content: built.outputFiles[0].text });
  const said = await page.evaluate((w) => window.show(w), { setting, frame: frames[index], trails, theme: shot.theme, view: shot.view ?? {}, zoom: shot.zoom, at: shot.where });
  await page.screenshot({ path: `${out}/${shot.name}.png` });
  console.log(shot.name, said);
  await page.close();
}
await browser.close();
