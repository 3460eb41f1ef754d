// SPDX-License-Identifier: MIT
// A recording in the page, as a visitor uses it. What is shown is compared with `banyan export` and the
// series table of the same run.
import { readFileSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { banyan, scenario, served } from './harness';
import { canvasPixels, clickRobot, factsShown, plotValues, seekTo, settle, table, timeShown } from './visitor';

let recording: string;
let rows: Record<string, string>[]; // of the exported table

const { folder, visit: open } = served((home) => {
  recording = home.record('run', scenario('three-targets'), '--series');
  rows = table(banyan('export', recording, '--csv'));
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

  it('shows what the selected robot said last, in fields', async () => {
    const { tab } = await visit();
    await seekTo(tab, 6);
    await tab.keyboard.press('3');
    await tab.keyboard.press('Enter');
    await tab.waitForSelector('.message th:text-is("id")');
    const fields = await factsShown(tab, '.message');
    expect(fields.id).toBe('3');
    expect(Object.keys(fields).length).toBeGreaterThan(30);
  });

  it('has the numbers of the series table under its plots', async () => {
    const { tab } = await visit();
    const series = table(readFileSync(join(folder.path, 'run', 'series.csv'), 'utf8'));
    for (const timeS of [1, 7.5]) {
      await seekTo(tab, timeS);
      const row = series.find((r) => Math.abs(Number(r.time_s) - timeS) < 1e-6)!;
      const [broken, fiedler, farthest, committed] = await plotValues(tab);
      expect(Number(broken)).toBe(Number(row.broken_by_distance) + Number(row.broken_by_occlusion));
      expect(Number(fiedler)).toBeCloseTo(Number(row.fiedler), 3);
      expect(Number.parseFloat(farthest)).toBeCloseTo(Number(row.worst_target_distance_m), 2);
      expect(Number(committed)).toBe(Number(row.committed));
    }
  });

  it('has the numbers of the selected robot as plots, and values under the pointer in step', async () => {
    const { tab, errors } = await visit();
    await seekTo(tab, 8);
    for (const key of ['1', '1', 'Enter']) await tab.keyboard.press(key);
    const choose = (plot: number, curve: string) => tab.selectOption(`.plot:nth-child(${plot + 1}) .plot-choice`, curve);
    await choose(0, 'robot: x_m');
    await choose(1, 'robot: parent');
    await choose(3, 'robot: target');
    const exported = (robot: number, timeS: number) => rows.find((row) => Number(row.robot) === robot && Math.abs(Number(row.time_s) - timeS) < 1e-6)!;
    const expectRow = async (row: Record<string, string>) => {
      await expect.poll(async () => Number.parseFloat((await plotValues(tab))[0])).toBeCloseTo(Number(row.x_m), 1);
      const [, parent, , target] = await plotValues(tab);
      expect([parent, target]).toEqual([row.parent, row.target].map((cell) => (cell === '' ? '–' : cell)));
    };
    await expectRow(exported(11, 8));
    await seekTo(tab, 3);
    await expectRow(exported(11, 3));
    for (const key of ['4', 'Enter']) await tab.keyboard.press(key); // the curves are another robot's then
    await expectRow(exported(4, 3));
    const over = (await (await tab.$('.plot:nth-child(1) .u-over'))!.boundingBox())!;
    await tab.mouse.move(over.x + over.width / 2, over.y + over.height / 2);
    await expect.poll(() => tab.$$eval('.plot-value.hovered', (all) => all.length)).toBe(4);
    const middleS = Number(rows[rows.length - 1].time_s) / 2;
    expect(Math.abs(Number.parseFloat((await plotValues(tab))[0]) - Number(exported(4, Math.round(10 * middleS) / 10).x_m))).toBeLessThan(0.05);
    expect(errors).toEqual([]);
  });

  it('plays, pauses at the end, and changes speed', async () => {
    const { tab } = await visit();
    await tab.keyboard.press('Home');
    await tab.selectOption('select[aria-label=Speed]', '64');
    await tab.keyboard.press(' ');
    const endS = Number(rows[rows.length - 1].time_s);
    await tab.waitForFunction((end) => Math.abs(Number(document.querySelector<HTMLInputElement>('.timeline input')!.value) - end) < 1e-6, endS);
    await tab.waitForSelector('button[aria-label^="Play"]');
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

  it('is drawn in the colours of the roles, dark and light', async () => {
    const { tab } = await visit();
    await seekTo(tab, 8);
    for (const theme of ['light', 'dark']) {
      await tab.evaluate((name) => { if (document.documentElement.dataset.theme !== name) (document.querySelector('[aria-label^="Light or dark"]') as HTMLElement).click(); }, theme);
      await settle(tab);
      const pixels = await canvasPixels(tab);
      for (const color of ['213,94,0', '0,114,178', '0,158,115', '240,228,66']) expect(pixels[color] ?? 0, `${theme} ${color}`).toBeGreaterThan(20);
    }
  });
});

/** The page's own parts, for what no visitor can bring about at will. */
interface Inside {
  plots: { setRuns(runs: object): void };
  events: { setEvents(events: unknown[]): void };
  notice: { warn(warnings: string[], run: object): void; bad(text: string): void };
  told: { events(): unknown[] };
}

describe('panels', () => {
  it('have no curves while nothing is known of a run, and none of the one before', async () => {
    const { tab, errors } = await visit();
    await tab.waitForSelector('.plot .u-over');
    expect(await tab.$eval('.plot .u-over', (e) => getComputedStyle(e).touchAction)).toBe('pan-y');
    await tab.evaluate(() => (window as unknown as { banyan: Inside }).banyan.plots.setRuns({ tables: [], robots: [], fields: [], marks: [] }));
    await tab.keyboard.press('m');
    await settle(tab);
    expect(await tab.$$('.plot .u-over')).toHaveLength(0);
    expect(await plotValues(tab)).toEqual(['', '', '', '']);
    expect(errors).toEqual([]);
  });

  /** A hundred deaths, one every tenth of a second from 0.1 s on: more than there is room for. */
  const listDeaths = (tab: Page) => tab.evaluate(() => {
    const { banyan } = window as unknown as { banyan: Inside };
    banyan.events.setEvents(Array.from({ length: 100 }, (_, k) => ({ tick: k + 1, time_s: 0.1 * (k + 1), kind: 'death', robot: k, target: -1, text: `death ${k}` })));
  });
  const listed = async () => {
    const visitor = await visit();
    await visitor.tab.waitForFunction(() => (window as unknown as { banyan: Inside }).banyan.told.events().length > 0); // the recording's are there
    await listDeaths(visitor.tab);
    return visitor;
  };

  it('list the events around now when they are opened, and each event keeps its row', async () => {
    const { tab } = await listed();
    await seekTo(tab, 8);
    await tab.click('#tab-events');
    const now = await tab.waitForSelector('.event.now button');
    expect(await now.textContent()).toContain('death 79');
    const isInView = () => now.evaluate((e) => {
      const [row, view] = [e.getBoundingClientRect(), e.closest('.events-view')!.getBoundingClientRect()];
      return row.top >= view.top && row.bottom <= view.bottom;
    });
    await expect.poll(isInView).toBe(true);
    await listDeaths(tab); // as after every answer of a live run
    expect(await now.evaluate((e) => e.isConnected)).toBe(true);
    expect(await now.evaluate((e) => e.parentElement!.className)).toBe('event now');
  });

  it('let Tab go through the events, beyond those in view', async () => {
    const { tab } = await listed();
    await tab.click('#tab-events');
    await tab.$eval('.events-view', (e) => { e.scrollTop = 0; });
    await settle(tab);
    await tab.focus('.events-view');
    for (let k = 0; k < 45; ++k) {
      await tab.keyboard.press('Tab');
      await settle(tab); // the list has been scrolled
      expect(await tab.evaluate(() => document.activeElement?.querySelector('.what')?.textContent)).toBe(`death ${k}`);
    }
  });

  it('say of many warnings the first, once, and can be closed', async () => {
    const { tab } = await visit();
    const say = (how: 'warn' | 'bad') => tab.evaluate((name) => {
      const page = window as unknown as { banyan: Inside; warned: object };
      page.warned ??= {};
      const texts = Array.from({ length: 41 }, (_, k) => `chunk ${k} was skipped`);
      if (name === 'warn') page.banyan.notice.warn(texts, page.warned);
      else page.banyan.notice.bad(texts.join('\n'));
    }, how);
    await say('warn');
    expect((await tab.textContent('.notice span'))!.split('\n')).toEqual(['chunk 0 was skipped', 'chunk 1 was skipped', 'chunk 2 was skipped', '… and 38 more: see Run']);
    await tab.click('.notice button');
    await say('warn');
    expect(await tab.isVisible('.notice')).toBe(false);
    await say('bad');
    const box = (await (await tab.$('.notice'))!.boundingBox())!;
    expect(box.y).toBeGreaterThanOrEqual(0);
    await tab.click('.notice button');
    expect(await tab.isVisible('.notice')).toBe(false);
  });
});

describe('a file that cannot be shown', () => {
  const drop = async (tab: Page, name: string, bytes: Buffer) => {
    const path = join(folder.path, name);
    writeFileSync(path, bytes);
    const chooser = tab.waitForEvent('filechooser');
    await tab.click('text=Open …');
    await (await chooser).setFiles(path);
  };

  it.each([
    ['empty.mcap', () => Buffer.alloc(0), /empty/i],
    ['text.mcap', () => Buffer.from('no recording at all, but some text'), /MCAP/],
    ['foreign.mcap', () => foreignRecording(), /Banyan|\/banyan\/frame/],
  ])('%s gets a message, and the run that was there stays', async (name, bytes, message) => {
    const { tab, errors } = await visit();
    await drop(tab, name, bytes());
    await tab.waitForSelector('.notice.bad:visible');
    expect(await tab.textContent('.notice')).toMatch(message);
    await seekTo(tab, 3);
    expect(await timeShown(tab)).toBeCloseTo(3);
    expect(errors).toEqual([]);
  });

  it('a truncated recording is shown as far as it goes, with a warning', async () => {
    const { tab } = await visit();
    const whole = readFileSync(recording);
    await drop(tab, 'cut.mcap', whole.subarray(0, Math.round(statSync(recording).size * 0.7)));
    await tab.waitForSelector('.notice.bad:visible');
    await tab.waitForFunction(() => document.title.startsWith('cut.mcap'));
    expect(Number(await tab.getAttribute('.timeline input', 'max'))).toBeGreaterThan(0);
    await clickRobot(tab, 0);
    expect((await factsShown(tab)).role).not.toBe('');
  });

  it('and a whole one opens after all that', async () => {
    const { tab } = await visit();
    await drop(tab, 'empty.mcap', Buffer.alloc(0));
    await tab.waitForSelector('.notice.bad:visible');
    await drop(tab, 'whole.mcap', readFileSync(recording));
    await tab.waitForFunction(() => document.title.startsWith('whole.mcap'));
    await seekTo(tab, 4);
    expect(await timeShown(tab)).toBeCloseTo(4);
  });
});

/** MCAP of another program: the magic, an empty header, data end, footer, all as the specification says. */
function foreignRecording(): Buffer {
  const magic = Buffer.from([0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a]);
  const record = (opcode: number, content: Buffer) => {
    const head = Buffer.alloc(9);
    head[0] = opcode;
    head.writeBigUInt64LE(BigInt(content.length), 1);
    return Buffer.concat([head, content]);
  };
  const text = (s: string) => Buffer.concat([Buffer.from(Uint32Array.of(s.length).buffer), Buffer.from(s)]);
  return Buffer.concat([magic, record(0x01, Buffer.concat([text('ros2'), text('another program')])), record(0x0f, Buffer.alloc(4)), record(0x02, Buffer.alloc(20)), magic]);
}
