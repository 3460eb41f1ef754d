// SPDX-License-Identifier: MIT
// What a visitor can do to a live run: the simulation in WebAssembly.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { describe, expect, it } from 'vitest';
import { scenario, served } from './harness';
import { dragTo, hashShown, killByKeys, nativeHash, playTo, savedOfLive } from './live_run';
import { clickRobot, expectEvent, factsShown, placeOf, seekTo, settle, timeShown } from './visitor';

const { folder, visit } = served(() => scenario('three-targets'));

describe('a visitor of a live run', () => {
  it('has after 200 ticks the state hash of the native run', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 20);
    expect(await hashShown(tab)).toBe(`${nativeHash(folder, scenario('three-targets'), 200, 'native')} at tick 200`);
    expect(errors).toEqual([]);
  });

  it('a worker turns towards its target when that is dragged away', async () => {
    const { tab } = await visit();
    await playTo(tab, 4);
    const home = await placeOf(tab, 'target', 0);
    const other = await placeOf(tab, 'target', 1);
    const worker = 0; // found by its target
    const robot = await tab.evaluate((target) => {
      const page = (window as unknown as { banyan: { stages: { shown: { targets: { worker: Int32Array } } }[] } }).banyan;
      return page.stages[0].shown.targets.worker[target];
    }, worker);
    await clickRobot(tab, robot);
    const before = Number.parseFloat((await factsShown(tab)).heading);
    await dragTo(tab, home, { x: other.x + 30, y: other.y - 20 });
    const moved = await placeOf(tab, 'target', 0);
    await playTo(tab, 8);
    const now = await placeOf(tab, 'target', 0);
    expect(Math.hypot(now.x - other.x - 30, now.y - other.y + 20)).toBeLessThan(12);
    expect(moved).toBeTruthy();
    const after = Number.parseFloat((await factsShown(tab)).heading);
    // It was on its way to (3, 0); now its target lies at 120 degrees.
    expect(Math.abs(before)).toBeLessThan(0.5);
    expect(after).toBeGreaterThan(1);
  });

  it('a target is dragged by its centre, where its worker stands', async () => {
    const { tab } = await visit();
    await playTo(tab, 25);
    const home = await placeOf(tab, 'target', 0);
    const robot = await tab.evaluate(() => {
      const page = (window as unknown as { banyan: { stages: { shown: { targets: { worker: Int32Array } } }[] } }).banyan;
      return page.stages[0].shown.targets.worker[0];
    });
    const worker = await placeOf(tab, 'robot', robot);
    expect(Math.hypot(worker.x - home.x, worker.y - home.y)).toBeLessThan(15); // it has arrived
    await dragTo(tab, home, { x: home.x - 40, y: home.y + 60 });
    const moved = await placeOf(tab, 'target', 0);
    expect(Math.hypot(moved.x - home.x + 40, moved.y - home.y - 60)).toBeLessThan(12);
  });

  it('robots die one by one or in an area, and what was done is in the saved scenario', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 5);
    await clickRobot(tab, 4);
    await tab.click('.robot-head >> text=Kill');
    await settle(tab);
    await tab.click('#tab-live');
    await tab.click('text=Kill area');
    const root = await placeOf(tab, 'target', 1);
    await dragTo(tab, { x: root.x - 60, y: root.y - 40 }, { x: root.x + 120, y: root.y + 140 });
    await tab.click('#tab-live');
    await tab.fill('#live-loss', '0.3');
    await tab.dispatchEvent('#live-loss', 'change');
    await settle(tab);
    await playTo(tab, 12);
    await expect.poll(() => tab.textContent('.caption')).toMatch(/[1-9]\d* dead/);
    await expectEvent(tab, 'robot 4 died');
    const shown = await hashShown(tab);
    const file = await savedOfLive(tab, 'Save .toml', folder);
    const text = readFileSync(file, 'utf8');
    expect(text).toContain('kind = "die"');
    expect(text).toContain('kind = "set_loss"');
    expect(shown).toBe(`${nativeHash(folder, file, 120, 'again')} at tick 120`);
    expect(errors).toEqual([]);
  });

  it('obstacles are dragged, line of sight is switched, a target is added: a native run repeats it all', async () => {
    const { tab, errors } = await visit();
    await tab.click('#tab-live');
    await tab.selectOption('#live-scenario', 'scattered-discs');
    await tab.click('text=Start');
    await tab.waitForFunction(() => document.title.startsWith('scattered-discs'));
    await playTo(tab, 3);
    const obstacle = await placeOf(tab, 'obstacle', 0);
    await dragTo(tab, obstacle, { x: obstacle.x + 40, y: obstacle.y + 25 });
    const moved = await placeOf(tab, 'obstacle', 0);
    await tab.click('#tab-live');
    await tab.click('#live-sight');
    await settle(tab);
    await tab.click('text=Add target');
    const target = await placeOf(tab, 'target', 0);
    await tab.mouse.click(target.x - 70, target.y + 45);
    await settle(tab);
    await playTo(tab, 9);
    await expect.poll(() => tab.textContent('.caption')).toContain('4 targets');
    for (const words of ['obstacle 0', 'line of sight', 'T3']) await expectEvent(tab, words);
    expect(moved).not.toBeNull();
    const shown = await hashShown(tab);
    const file = await savedOfLive(tab, 'Save .toml', folder);
    expect(readFileSync(file, 'utf8')).toContain('kind = "move_obstacle"');
    expect(shown).toBe(`${nativeHash(folder, file, 90, 'obstacles')} at tick 90`);
    expect(errors).toEqual([]);
  });

  it('goes back in time, does something else, and forgets what was', async () => {
    const { tab } = await visit();
    await playTo(tab, 10);
    await killByKeys(tab, 5);
    await playTo(tab, 12);
    await seekTo(tab, 6);
    await killByKeys(tab, 6);
    await playTo(tab, 12);
    await clickRobot(tab, 5);
    expect((await factsShown(tab)).alive).toBe('yes');
    await clickRobot(tab, 6);
    expect((await factsShown(tab)).alive).toBe('no');
  });

  it('undoes what was done last, all of it at once', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 5);
    await killByKeys(tab, 5);
    await playTo(tab, 8);
    await killByKeys(tab, 6);
    await settle(tab);
    await tab.keyboard.press('u');
    await tab.keyboard.press('Control+z');
    await settle(tab);
    await playTo(tab, 20);
    expect(await hashShown(tab)).toBe(`${nativeHash(folder, scenario('three-targets'), 200, 'undone')} at tick 200`);
    await tab.keyboard.press('u');
    await expect.poll(() => tab.textContent('.notice')).toContain('Nothing has been done');
    expect(errors).toEqual([]);
  });

  it('does again what was undone, by keys and by buttons, until something else is done', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 5);
    await killByKeys(tab, 5);
    await playTo(tab, 8);
    await killByKeys(tab, 6);
    await playTo(tab, 20);
    const shown = await hashShown(tab);
    await tab.keyboard.press('u');
    await tab.click('#tab-live');
    await tab.click('button:text-is("Undo")');
    await seekTo(tab, 5);
    await expect.poll(() => tab.textContent('.caption')).not.toContain('dead');
    await tab.keyboard.press('Control+Shift+z');
    await expect.poll(() => tab.textContent('.caption')).toContain('1 dead');
    await tab.click('button:text-is("Redo")');
    await expect.poll(() => tab.textContent('.caption')).toContain('2 dead'); // at 8 s, to which it went on
    expect(await timeShown(tab)).toBeCloseTo(8.1);
    await playTo(tab, 20);
    expect(await hashShown(tab)).toBe(shown);
    await tab.keyboard.press('u');
    await seekTo(tab, 7);
    await killByKeys(tab, 1);
    await tab.keyboard.press('y');
    await expect.poll(() => tab.textContent('.notice')).toContain('Nothing has been undone');
    expect(errors).toEqual([]);
  });

  it('gets obstacles by pointer and by keys, and loses them: in link, list, timeline, undo', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 4);
    const obstacles = () => tab.evaluate(() => {
      const { stages } = (window as unknown as { banyan: { stages: { source: { settingAt(timeS: number): { obstacles: { center_m: number[]; radius_m: number }[] } }; shown: { timeS: number } }[] } }).banyan;
      return stages[0].source.settingAt(stages[0].shown.timeS).obstacles;
    });
    const place = await placeOf(tab, 'target', 0);
    await tab.click('#tab-live');
    await tab.click('text=Add obstacle');
    await dragTo(tab, { x: place.x - 60, y: place.y + 90 }, { x: place.x - 60, y: place.y + 60 }); // from its middle to its edge
    await expect.poll(async () => (await obstacles()).length).toBe(1);
    const metresPerPx = await tab.evaluate(() => (window as unknown as { banyan: { stages: { metresPerPx: number }[] } }).banyan.stages[0].metresPerPx);
    expect((await obstacles())[0].radius_m).toBeCloseTo(30 * metresPerPx, 2);
    await tab.click('text=Add obstacle');
    await tab.mouse.click(place.x - 60, place.y - 90); // of the usual size
    await expect.poll(async () => (await obstacles()).map((o) => o.radius_m)).toContain(0.25);
    const keys = async (...names: string[]) => { for (const name of names) await tab.keyboard.press(name); };
    await keys('x', 'ArrowUp', 'Shift+ArrowUp', 'Enter', 'Shift+ArrowRight', 'Enter');
    await expect.poll(async () => (await obstacles()).length).toBe(3);
    expect((await obstacles())[2].radius_m).toBeCloseTo(48 * metresPerPx, 2);
    await keys('Shift+n', 'Shift+p', 'g', 'Shift+ArrowUp', 'Enter'); // the last of targets and obstacles
    await expect.poll(async () => (await obstacles())[2].center_m[1]).toBeGreaterThan(80 * metresPerPx);
    await tab.mouse.click(place.x - 60, place.y + 90);
    await keys('Delete');
    await expect.poll(async () => (await obstacles()).length).toBe(2);
    await playTo(tab, 20);
    const shown = await hashShown(tab);
    for (const words of ['obstacle 0 is new', 'obstacle 2 is new', 'obstacle 2 has moved', 'obstacle 0 is gone']) await expectEvent(tab, words);
    const line = (await (await tab.$('.timeline'))!.boundingBox())!;
    await expect.poll(async () => { // along the timeline until its hint tells of it
      for (let x = 0; x < line.width; x += 3) {
        await tab.mouse.move(line.x + x, line.y + line.height / 2);
        if ((await tab.textContent('.timeline-hint'))!.includes('obstacle 0 is new')) return true;
      }
      return false;
    }).toBe(true);
    await tab.click('text=Copy link');
    await expect.poll(() => new URL(tab.url()).hash).toContain('remove_obstacle');
    expect(shown).toBe(`${nativeHash(folder, tab.url().replace('?start', ''), 200, 'obstacles-linked')} at tick 200`);
    await keys('u', 'u', 'u', 'u', 'u');
    await playTo(tab, 20);
    expect(await hashShown(tab)).toBe(`${nativeHash(folder, scenario('three-targets'), 200, 'no-obstacles')} at tick 200`);
    expect(errors).toEqual([]);
  });

  it('says why an edge broke: who stood between, what both ends believed, what was said and not heard', async () => {
    const { tab, errors } = await visit();
    await playTo(tab, 7);
    await tab.click('#tab-live');
    await tab.click('#live-sight');
    await playTo(tab, 8);
    const [from, to] = await tab.evaluate(() => { // the longest edge
      interface Stage { facts(): { edges: { from: number; to: number; link: string }[] }; worldPlaceOf(item: { kind: string; index: number }): { x: number; y: number } }
      const [stage] = (window as unknown as { banyan: { stages: Stage[] } }).banyan.stages;
      const long = ({ from: a, to: b }: { from: number; to: number }) => {
        const [p, q] = [a, b].map((index) => stage.worldPlaceOf({ kind: 'robot', index }));
        return Math.hypot(p.x - q.x, p.y - q.y);
      };
      const [edge] = stage.facts().edges.filter((e) => e.link === 'open').sort((a, b) => long(b) - long(a));
      return [edge.from, edge.to];
    });
    const [a, b] = [await placeOf(tab, 'robot', from), await placeOf(tab, 'robot', to)];
    const middle = { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
    await tab.click('text=Add obstacle');
    await dragTo(tab, middle, { x: middle.x + 8, y: middle.y });
    await playTo(tab, 9);
    await tab.click('#tab-events');
    await tab.fill('.events input', 'hidden by obstacle 0');
    await tab.click('.event button');
    await settle(tab);
    await tab.click('.events button:text-is("Why?")');
    await tab.waitForSelector('dialog.why[open]');
    const text = (await tab.textContent('dialog.why'))!;
    for (const words of ['Why did it break?', 'hidden by obstacle 0', `Robot ${from}`, `Robot ${to}`, `Robot ${to} to robot ${from}`]) expect(text).toContain(words);
    expect(text).toMatch(/\d+ messages each way up to \d+\.\d s/);
    const rows = await tab.$$eval('.why .moments tbody tr', (all) => all.map((row) => [...(row as HTMLTableRowElement).cells].map((cell) => cell.textContent)));
    expect(rows.filter(([, , , heard]) => heard === 'yes').length).toBeGreaterThan(5);
    expect(rows.filter(([, , , heard]) => heard === 'no').length).toBeGreaterThan(0);
    await tab.evaluate(readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8'));
    expect(await tab.evaluate(async () => {
      const { axe } = window as unknown as { axe: { run(where: string): Promise<{ violations: { id: string; impact: string }[] }> } };
      return (await axe.run('dialog.why')).violations.filter(({ impact }) => impact === 'serious' || impact === 'critical').map(({ id }) => id);
    })).toEqual([]);
    // What was not heard last is what the robot says then.
    const [name, , said] = await tab.$eval('.why .unheard tbody tr', (row) => [...(row as HTMLTableRowElement).cells].map((cell) => cell.textContent ?? ''));
    const timeS = Number.parseFloat(/each way up to (\d+\.\d) s/.exec(text)![1]);
    const speaker = Number(await tab.$eval('.why .unheard', (table) => /Robot (\d+)/.exec(table.previousElementSibling!.textContent!)![1]));
    await tab.keyboard.press('Escape');
    await seekTo(tab, timeS);
    await tab.keyboard.type(String(speaker));
    await tab.keyboard.press('Enter');
    await expect.poll(async () => (await factsShown(tab, '.message'))[name]).toBe(said);
    expect(errors).toEqual([]);
  });
});
