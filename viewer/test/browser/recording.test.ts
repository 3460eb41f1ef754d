// SPDX-License-Identifier: MIT
// A recording in the page, as a visitor uses it. What is shown is compared with `banyan export` of the same run.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { banyan, scenario, served } from './harness';
import { canvasPixels, clickRobot, factsShown, saved, seekTo, settle, table, timeShown } from './visitor';

let recording: string;
let rows: Record<string, string>[]; // of the exported table

const { folder, visit: open } = served((home) => {
  recording = home.record('run', scenario('three-targets'));
  rows = table(banyan('export', recording));
  return recording;
});

const visit = async (): ReturnType<typeof open> => {
  const visitor = await open();
  await seekTo(visitor.tab, 1); // it plays as soon as it is open
  return visitor;
};

describe('a recording', () => {
  it('is scrubbed to a moment, and a robot that is clicked shows what the export says', async () => {
    const { tab, errors } = await visit();
    for (const timeS of [0, 5, 11.3]) {
      await seekTo(tab, timeS);
      const now = rows.filter((row) => Math.abs(Number(row.time_s) - timeS) < 1e-6);
      expect(now.length).toBeGreaterThan(0);
      for (const row of [now[0], now[now.length >> 1], now[now.length - 1]]) {
        await clickRobot(tab, Number(row.robot));
        const facts = await factsShown(tab);
        expect(facts.position).toBe(`${Number(row.x_m).toFixed(4)}, ${Number(row.y_m).toFixed(4)} m`);
        expect(facts.heading).toBe(`${Number(row.heading_rad).toFixed(4)} rad`);
        expect(facts.role).toBe(row.role);
        expect(facts.phase).toBe(row.phase);
        expect(facts.parent).toBe(row.parent === '' ? '–' : `robot ${row.parent}`);
        expect(facts.alive).toBe(row.alive === '1' ? 'yes' : 'no');
        expect(facts.target).toBe(row.target === '' ? '–' : `T${row.target}`);
      }
    }
    expect(errors).toEqual([]);
  });

  it('is used with the keyboard alone', async () => {
    const { tab, errors } = await visit();
    await tab.keyboard.press('Home');
    expect(await timeShown(tab)).toBeCloseTo(0);
    for (let k = 0; k < 3; ++k) await tab.keyboard.press('ArrowRight');
    expect(await timeShown(tab)).toBeCloseTo(0.3);
    await tab.keyboard.press('Shift+ArrowRight');
    expect(await timeShown(tab)).toBeCloseTo(1.3);
    await tab.keyboard.press('ArrowLeft');
    expect(await timeShown(tab)).toBeCloseTo(1.2);
    await tab.keyboard.press('End');
    expect(await timeShown(tab)).toBeCloseTo(Number(rows[rows.length - 1].time_s));
    await tab.keyboard.press('[');
    const complete = await timeShown(tab);
    await tab.keyboard.press('[');
    expect(await timeShown(tab)).toBeLessThan(complete);
    await tab.keyboard.press(']');
    expect(await timeShown(tab)).toBeCloseTo(complete);
    await tab.keyboard.type('11');
    await tab.keyboard.press('Enter');
    await settle(tab);
    await expect.poll(() => tab.textContent('.robot-head h2')).toBe('Robot 11');
    await tab.keyboard.press('n');
    await settle(tab);
    await expect.poll(() => tab.textContent('.robot-head h2')).toBe('Robot 12');
    await tab.keyboard.press('f');
    await settle(tab);
    await expect.poll(() => tab.textContent('.robot-head button')).toBe('Unfollow');
    await tab.keyboard.press('Escape');
    await settle(tab);
    await expect.poll(() => tab.isVisible('.robot-head')).toBe(false);
    await tab.keyboard.press('?');
    await settle(tab);
    await expect.poll(() => tab.isVisible('dialog')).toBe(true);
    await tab.keyboard.press('Escape');
    await settle(tab);
    await expect.poll(() => tab.isVisible('dialog')).toBe(false);
    // Every control is reached by Tab.
    const reached = new Set<string>();
    for (let k = 0; k < 40; ++k) {
      await tab.keyboard.press('Tab');
      reached.add(await tab.evaluate(() => document.activeElement?.getAttribute('aria-label') ?? document.activeElement?.textContent ?? ''));
    }
    for (const name of ['Time', 'Speed', 'Play (space)', 'Robot']) expect(reached, name).toContain(name);
    expect(errors).toEqual([]);
  });

  it('is kept as a picture of its size, with the same pixels', async () => {
    const { tab } = await visit();
    await seekTo(tab, 8);
    const shown = await canvasPixels(tab);
    await tab.click('#tab-run');
    const bytes = readFileSync(await saved(tab, '.keep button:text-is("Picture")', folder.path));
    const { width, height } = await tab.$eval('.stage canvas', (e) => ({ width: e.clientWidth, height: e.clientHeight }));
    expect(bytes.subarray(0, 8)).toEqual(Buffer.from([0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]));
    expect([bytes.readUInt32BE(16), bytes.readUInt32BE(20)]).toEqual([width, height]);
    const kept = pixelsOf(bytes);
    for (const color of ['213,94,0', '0,114,178', '0,158,115', '240,228,66']) expect(kept[color], color).toBe(shown[color]);
  });

  it('a truncated recording is shown as far as it goes, with a warning', async () => {
    const { tab } = await visit();
    const whole = readFileSync(recording);
    const path = join(folder.path, 'cut.mcap');
    writeFileSync(path, whole.subarray(0, Math.round(whole.length * 0.7)));
    const chooser = tab.waitForEvent('filechooser');
    await tab.click('text=Open …');
    await (await chooser).setFiles(path);
    await tab.waitForSelector('.notice.bad:visible');
    await tab.waitForFunction(() => document.title.startsWith('cut.mcap'));
    expect(Number(await tab.getAttribute('.timeline input', 'max'))).toBeGreaterThan(0);
    await clickRobot(tab, 0);
    expect((await factsShown(tab)).role).not.toBe('');
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
