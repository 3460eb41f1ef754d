// SPDX-License-Identifier: MIT
// What a visitor takes along: picture, drawing, film and tables are files that others can read, and show what the page
// showed.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { scenario, served } from './harness';
import { canvasPixels, saved, seekTo, settle, table } from './visitor';

const { folder, visit } = served((home) => home.record('run', scenario('three-targets'), '--series'));

const colors = ['#f0e442', '#009e73', '#0072b2', '#d55e00'] as const; // of the roles, by number

interface Scene {
  robots: number[]; // of each role
  targets: number;
  edges: number; // that hold
  width: number;
  height: number;
}

/** What the page says it has drawn. */
const sceneShown = (tab: Page) => tab.evaluate((): Scene => {
  interface Stage {
    shown: { targets: { x: Float64Array } };
    facts(): { role: Float64Array; alive: Float64Array; edges: { old: boolean; link: string }[] };
    picture: { canvas: HTMLCanvasElement };
  }
  const [stage] = (window as unknown as { banyan: { stages: Stage[] } }).banyan.stages;
  const { role, alive, edges } = stage.facts();
  return {
    robots: [0, 1, 2, 3].map((wanted) => role.filter((r, i) => r === wanted && alive[i] === 1).length),
    targets: stage.shown.targets.x.length,
    edges: edges.filter((e) => !e.old && e.link === 'open').length,
    width: stage.picture.canvas.clientWidth, height: stage.picture.canvas.clientHeight,
  };
});

/** What an SVG has in it, as the browser reads it. */
const partsOf = (tab: Page, svg: string, roles: readonly string[]) => tab.evaluate(([text, colors]) => {
  const all = new DOMParser().parseFromString(text, 'image/svg+xml');
  const run = all.querySelector('svg.run')!;
  const count = (selector: string) => run.querySelectorAll(selector).length;
  const lines = [...run.querySelectorAll('[class=tree] path:not([stroke-dasharray])')].map((e) => e.getAttribute('d')!.split('M').length - 1);
  return {
    failed: all.querySelector('parsererror')?.textContent ?? '',
    runs: all.querySelectorAll('svg.run').length,
    robots: colors.map((color) => count(`[class="spares and dead"] circle[fill="${color}"], [class=committed] circle[fill="${color}"]`)),
    targets: count('[class=targets] circle[stroke]'),
    edges: lines.reduce((sum, n) => sum + n, 0),
    words: [...run.querySelectorAll('[class=caption] text')].map((e) => e.textContent ?? ''),
    names: [...run.querySelectorAll('[class=labels] text')].map((e) => e.textContent ?? ''),
  };
}, [svg, [...roles]] as const);

/** The share of pixels in which the SVG, as the browser draws it, differs clearly from the picture; below the caption,
 *  which is no part of the canvas. */
const difference = (tab: Page, svg: string) => tab.evaluate(async (text) => {
  const image = new Image();
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
  await image.decode();
  const shown = document.querySelector<HTMLCanvasElement>('.stage canvas')!;
  const again = Object.assign(document.createElement('canvas'), { width: shown.width, height: shown.height });
  const pen = again.getContext('2d')!;
  pen.drawImage(image, 0, 0, shown.width, shown.height);
  const below = 60;
  const [a, b] = [shown.getContext('2d')!, pen].map((p) => p.getImageData(0, below, shown.width, shown.height - below).data);
  let differs = 0;
  for (let k = 0; k < a.length; k += 4) if (Math.abs(a[k] - b[k]) + Math.abs(a[k + 1] - b[k + 1]) + Math.abs(a[k + 2] - b[k + 2]) > 90) ++differs;
  return differs / (a.length / 4);
}, svg);

const keep = async (tab: Page, button: string) => {
  await tab.click('#tab-run');
  return await saved(tab, `.keep button:text-is("${button}")`, folder.path);
};

describe('what is kept', () => {
  it.each(['light', 'dark'])('is a drawing with as many robots, edges and targets, which looks like the picture: %s', async (theme) => {
    const { tab, errors } = await visit();
    await seekTo(tab, 8);
    if (theme === 'dark') await tab.keyboard.press('m');
    for (const key of ['1', '1', 'Enter', 'i']) await tab.keyboard.press(key); // with a selection and with ids
    await settle(tab);
    const file = await keep(tab, 'Drawing');
    const svg = readFileSync(file, 'utf8');
    expect(file).toMatch(/run\.svg$/);
    const { failed, runs, words, names, ...parts } = await partsOf(tab, svg, colors);
    expect(failed).toBe('');
    expect(runs).toBe(1);
    const { robots, targets, edges } = await sceneShown(tab);
    expect(parts).toEqual({ robots: robots.map((n, role) => (role === 3 ? 2 * n : n)), targets, edges }); // the root has a ring
    expect(words[0]).toBe('convoy · 18 robots · 3 targets');
    for (const name of ['T0', 'T1', 'T2', '11']) expect(names).toContain(name);
    expect(await difference(tab, svg)).toBeLessThan(0.004);
    await seekTo(tab, 1);
    expect(await difference(tab, svg)).toBeGreaterThan(0.008); // it would be seen
    expect(errors).toEqual([]);
  });

  it('is a picture of that size, with the same pixels', async () => {
    const { tab } = await visit();
    await seekTo(tab, 8);
    const shown = await canvasPixels(tab);
    const bytes = readFileSync(await keep(tab, 'Picture'));
    const { width, height } = await sceneShown(tab);
    expect(bytes.subarray(0, 8)).toEqual(Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]));
    expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual([width, height]);
    const kept = pixelsOf(bytes);
    for (const color of ['213,94,0', '0,114,178', '0,158,115', '240,228,66']) expect(kept[color], color).toBe(shown[color]);
  });

  it('is a film, of as many runs as are shown', async () => {
    const { tab, errors } = await visit();
    await seekTo(tab, 2);
    await tab.click('#tab-run');
    await tab.click('.keep button:text-is("Film")');
    await tab.keyboard.press('Escape');
    await tab.keyboard.press(' ');
    await tab.waitForFunction(() => Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) > 2.8);
    const file = await keep(tab, 'Stop filming');
    expect(file).toMatch(/run\.webm$/);
    const { width, height } = await sceneShown(tab);
    const told = JSON.parse(execFileSync('ffprobe', ['-v', 'error', '-count_frames', '-show_streams', '-show_format', '-of', 'json', file], { encoding: 'utf8' })) as
      { streams: { codec_type: string; width: number; height: number; nb_read_frames: string }[]; format: { format_name: string } };
    expect(told.format.format_name).toContain('webm');
    expect(told.streams).toHaveLength(1);
    const [film] = told.streams;
    expect([film.codec_type, film.width, film.height]).toEqual(['video', width, height]);
    expect(Number(film.nb_read_frames)).toBeGreaterThan(4);
    expect(errors).toEqual([]);
  });

  it('is the table that the program writes', async () => {
    const { tab } = await visit();
    await seekTo(tab, 8);
    const [ours, its] = [await keep(tab, 'Table'), join(folder.path, 'run', 'series.csv')].map((file) => table(readFileSync(file, 'utf8')));
    expect(Object.keys(ours[0]).sort()).toEqual(Object.keys(its[0]).sort());
    const later = ours.filter(({ tick }) => tick !== '0'); // which the program leaves out
    expect(later).toHaveLength(its.length);
    for (const k of [0, 40, its.length - 1]) {
      for (const name of ['tick', 'time_s', 'committed', 'worst_target_distance_m']) expect(Number(later[k][name]), name).toBeCloseTo(Number(its[k][name]), 3);
    }
  });
});

/** Of a PNG, by colour; decoded by a program that is no browser. */
function pixelsOf(png: Buffer): Record<string, number> {
  const raw = execFileSync('ffmpeg', ['-v', 'error', '-i', '-', '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'], { input: png, maxBuffer: 1 << 28 });
  const counts: Record<string, number> = {};
  for (let k = 0; k < raw.length; k += 3) {
    const key = `${raw[k]},${raw[k + 1]},${raw[k + 2]}`;
    counts[key] = (counts[key] ?? 0) + 1;
  }
  return counts;
}
