// SPDX-License-Identifier: MIT
// The compiled simulation as a source, against what the native program recorded of the same scenario.
import { readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { describe, expect, it } from 'vitest';
import { column, columns } from '../src/frame';
import { History } from '../src/source/history';
import { Deeds } from '../src/state/deeds';
import { LiveRun } from '../src/source/live';
import { LiveHost } from '../src/source/live_host';
import type { LiveModule } from '../src/source/live_module';
import { pack, unpack } from '../src/source/packed';
import type { Reply } from '../src/source/protocol';
import { bytesOf, fileOf, frameAt, numberOf, open, random, tableOf } from './support';

const root = fileURLToPath(new URL('../../', import.meta.url));
const folder = process.env.BANYAN_LIVE ?? path.join(root, 'build/wasm/viewer');
const scenario = readFileSync(path.join(root, 'scenarios/three-targets.toml'), 'utf8');
const request = { name: 'three-targets.toml', text: scenario, overrides: [] };

async function load(): Promise<LiveModule> {
  const { default: create } = await import(/* @vite-ignore */ pathToFileURL(path.join(folder, 'banyan_live.mjs')).href);
  return await create({ wasmBinary: readFileSync(path.join(folder, 'banyan_live.wasm')) });
}
const module = load();

function runTo(run: LiveRun, tick: number): LiveRun {
  while (run.head < tick) run.step();
  return run;
}

describe('a live run', () => {
  it('is the native run', async () => {
    const run = LiveRun.load(await module, request);
    const result = JSON.parse(readFileSync(fileOf('three', 'run.json'), 'utf8')).result;
    runTo(run, result.ticks);
    expect(run.hashAt(run.head)).toBe(result.hash);
    const { frames } = run.framesReply(0, 99, 1);
    const recorded = (await (await open(bytesOf('three'))).frames(0, 99, 1)).frames;
    expect(frames.length).toBe(recorded.length);
    frames.forEach((frame, k) => {
      expect(frame.tick).toBe(recorded[k].tick);
      const apart = frame.data.map((value, i) => Math.abs(value - recorded[k].data[i]));
      expect(Math.max(...apart)).toBeLessThan(0.00051); // want_m has three decimals, poses four
      expect([...frame.targets.worker]).toEqual([...recorded[k].targets.worker]);
    });
    const { series } = run.takeTable()!;
    const rows = tableOf(fileOf('three', 'series.csv'));
    for (const key of Object.keys(rows[0])) {
      if (key === 'fiedler') continue; // computed exactly for --series only
      const apart = rows.map((row, k) => {
        const [a, b] = [series[key][k + 1], numberOf(row[key])];
        return Number.isNaN(a) && Number.isNaN(b) ? 0 : Math.abs(a - b); // empty in both: no batteries
      });
      expect(Math.max(...apart), key).toBeLessThan(1e-4);
    }
    runTo(run, result.ticks + 50); // goes on after completion
    expect(run.header().result.complete).toBe('true');
    run.close();
  });

  it('goes back, and does again what was done there', async () => {
    const plain = runTo(LiveRun.load(await module, request), 90);
    const run = runTo(LiveRun.load(await module, request), 60);
    run.intervene(30, [{ kind: 'die', robot: 3 }]);
    expect(run.head).toBe(30);
    run.takeTable();
    runTo(run, 50);
    run.intervene(30, [{ kind: 'die', robot: 5 }]); // beside the first one
    runTo(run, 90);
    const { frames } = run.framesReply(9, 9, 1);
    expect([3, 5, 4].map((robot) => column(frames[0], 'alive')[robot])).toEqual([0, 0, 1]);
    const table = run.takeTable()!;
    expect(table.whole).toBe(true);
    expect([...table.series.tick]).toEqual(Array.from({ length: 91 }, (_, k) => k));
    const hash = run.hashAt(run.head);
    expect(hash).not.toBe(plain.hashAt(plain.head));
    expect(() => run.intervene(10, [{ kind: 'die', robot: 99 }])).toThrow('robot');
    expect(runTo(run, 90).hashAt(90)).toBe(hash); // nothing is lost by what could not be
    run.close();
    plain.close();
  });

  it('is reset to the scenario, also from what was done before its first tick', async () => {
    const plain = runTo(LiveRun.load(await module, request), 40);
    const run = LiveRun.load(await module, request);
    const before = { config: run.header().config, frames: run.framesReply(0, 0, 1).frames };
    for (const head of [0, 40]) {
      run.intervene(0, [{ kind: 'die', robot: 3 }, { kind: 'set_line_of_sight', line_of_sight: false }]);
      runTo(run, head);
      run.takeTable();
      run.reset();
      expect(run.head).toBe(0);
      expect(run.headerChanged).toBe(true);
      expect(run.header()).toMatchObject({ config: before.config, endS: 0, warnings: [] });
      expect(run.header().settings).toHaveLength(1);
      expect(run.framesReply(0, 9, 1).frames).toEqual(before.frames);
      expect(run.takeTable()).toMatchObject({ whole: true, series: { tick: Float64Array.of(0) } });
    }
    expect(runTo(run, 40).hashAt(40)).toBe(plain.hashAt(40));
    expect(run.takeTable()!.events).toEqual(plain.takeTable()!.events);
    run.close();
    plain.close();
  });

  it('promises nothing behind the last frame of a stride', async () => {
    const run = runTo(LiveRun.load(await module, request), 55);
    expect(run.framesReply(0, 5, 16).untilS).toBeCloseTo(4.8);
    expect(run.framesReply(0, 5, 1).untilS).toBe(5);
    expect(runTo(run, 64).framesReply(0, 5, 16).untilS).toBe(5);
    run.close();
  });

  it('tells at once what was done to it, also where nothing is undone', async () => {
    const run = runTo(LiveRun.load(await module, request), 20);
    expect(new Deeds(run.header().config).lossAt(5)).toBe(0);
    run.intervene(20, [{ kind: 'set_loss', loss: 0.3 }]);
    expect(run.headerChanged).toBe(true);
    runTo(run, 30).intervene(30, [{ kind: 'set_loss', loss: 0.5 }]);
    const loss = new Deeds(run.header().config);
    expect([0, 1.9, 2, 2.9, 3, 99].map((timeS) => loss.lossAt(timeS))).toEqual([0, 0, 0.3, 0.3, 0.5, 0.5]);
    run.intervene(10, []);
    expect(new Deeds(run.header().config).lossAt(5)).toBe(0);
    run.close();
  });

  it('undoes and does again, in whatever order, and then is the run that it was', async () => {
    const run = runTo(LiveRun.load(await module, request), 20);
    run.intervene(20, [{ kind: 'die', robot: 4 }, { kind: 'die', robot: 5 }]);
    runTo(run, 30).intervene(30, [{ kind: 'add_obstacle', position_m: [1, 1], radius_m: 0.3 }]);
    runTo(run, 40).intervene(40, [{ kind: 'remove_obstacle', obstacle: 0 }]);
    const acts = run.header().acts!;
    expect(acts.map(({ tick }) => tick)).toEqual([20, 20, 30, 40]);
    const hash = runTo(run, 60).hashAt(60);
    expect(run.redo()).toBeNull(); // nothing was undone
    expect([run.undo(), run.undo(), run.undo(), run.undo()]).toEqual([40, 30, 20, null]);
    expect(run.header().acts).toEqual([]);
    expect(run.redo()).toBe(20);
    expect(run.redo()).toBe(30); // not simulated yet
    expect(run.header().acts).toEqual(acts.slice(0, 3));
    expect(run.undo()).toBe(run.head); // and taken back before it happened
    expect([run.redo(), run.redo(), run.redo()]).toEqual([30, 40, null]);
    expect(runTo(run, 60).hashAt(60)).toBe(hash);
    expect(run.header().acts).toEqual(acts);
    expect(run.undo()).toBe(40);
    run.intervene(run.head, [{ kind: 'die', robot: 1 }]);
    expect(run.redo()).toBeNull(); // something else was done
    run.close();
  });

  it('has what an address does to it once, and undoes it like anything else', async () => {
    const plain = runTo(LiveRun.load(await module, request), 40);
    const acts = [{ tick: 10, json: '{"kind":"die","robot":4}' }, { tick: 20, json: '{"kind":"die","robot":5}' }];
    const run = runTo(LiveRun.load(await module, { ...request, acts }), 40);
    expect(run.header().acts).toEqual(acts);
    expect([run.undo(), run.undo(), run.undo()]).toEqual([20, 10, null]);
    expect(runTo(run, 40).hashAt(40)).toBe(plain.hashAt(40));
    run.close();
    plain.close();
  });

  it('knows settings that change, messages, files', async () => {
    const run = runTo(LiveRun.load(await module, request), 20);
    run.intervene(20, [{ kind: 'set_line_of_sight', line_of_sight: false }]);
    runTo(run, 25);
    const sights = run.header().settings.map((s) => s.setting.line_of_sight);
    expect(sights.length).toBeGreaterThanOrEqual(1);
    expect(sights.at(-1)).toBe(false);
    expect(run.message(2, 10)).toMatchObject({ id: 2 });
    expect(run.message(2, 0)).toBeNull();
    const recording = await open(run.recording() as Uint8Array<ArrayBuffer>);
    expect(recording.headerNow()).toMatchObject({ endS: 2.5, robots: 18, warnings: [] });
    expect(run.scenario()).toContain('set_line_of_sight');
    run.close();
  });

  it('answers like a recording', async () => {
    const replies: Reply[] = [];
    const host = new LiveHost((reply) => replies.push(reply), async () => await module);
    const of = async (id: number) => {
      for (;;) {
        const found = replies.find((r) => 'id' in r && r.id === id);
        if (found !== undefined) return found;
        await new Promise((resolve) => setTimeout(resolve, 2));
      }
    };
    host.receive({ type: 'open_live', run: { ...request, overrides: ['radio.loss=9'] } });
    expect(await of(0)).toMatchObject({ type: 'failed', problems: [expect.stringContaining('radio.loss')] });
    host.receive({ type: 'open_live', run: request });
    let untilS = 0;
    for (let id = 1; untilS < 5; ++id) {
      host.receive({ type: 'frames', id, fromS: 0, toS: 5, stride: 16 });
      const reply = await of(id);
      if (reply.type !== 'frames') throw new Error(reply.type);
      ({ untilS } = reply);
      if (untilS >= 5) expect(reply.frames.map((f) => f.tick)).toEqual([0, 16, 32, 48, 64]);
    }
    host.receive({ type: 'save_scenario', id: 1001 });
    expect(await of(1001)).toMatchObject({ type: 'file', name: 'three-targets.toml' });
    host.receive({ type: 'reset', id: 1003 });
    expect(await of(1003)).toMatchObject({ type: 'done' });
    expect(replies.filter((reply) => reply.type === 'header').at(-1)).toMatchObject({ header: { endS: 0 } });
    host.receive({ type: 'intervene', id: 1002, tick: 10 ** 6, events: [] });
    expect(await of(1002)).toMatchObject({ type: 'failed', text: 'that moment has not been simulated yet' });
  });
});

describe('packed frames', () => {
  it('come back as they were', () => {
    const next = random(5);
    const frame = frameAt(7, 0.1, 20);
    columns.forEach((name, c) => {
      const real = /_m$|_rad$/.test(name);
      for (let i = 0; i < 20; ++i) frame.data[c * 20 + i] = real ? Math.fround(100 * next() - 50) : Math.floor(3 * next());
    });
    for (const name of ['parent', 'request', 'target'] as const) column(frame, name).set([-1, 65534], 0);
    column(frame, 'epoch')[0] = 65535;
    for (const name of ['alive', 'role'] as const) column(frame, name).fill(1);
    expect(unpack(pack(frame, frame.targets))).toEqual(frame);
  });
});

describe('the history', () => {
  it('is bounded, and coarser the longer ago', () => {
    const history = new History<{ tick: number; bytes: number }>(100);
    for (let tick = 0; tick < 5000; ++tick) history.push({ tick, bytes: 1 });
    expect(history.bytesKept).toBeLessThanOrEqual(100);
    expect(history.last()!.tick).toBe(4999);
    const ticks = history.around(0, 5000, 1).map((entry) => entry.tick);
    expect(ticks[0]).toBe(0);
    expect(ticks.slice(-40)).toEqual(Array.from({ length: 40 }, (_, k) => 4960 + k));
    expect(history.around(1000, 2000, 512).map((e) => e.tick)).toContain(1024);
    history.cut(4990);
    expect(history.last()!.tick).toBe(4990);
    expect(history.at(4993)!.tick).toBe(4990);
  });

  it('gives the range and its neighbours', () => {
    const history = new History<{ tick: number; bytes: number }>(1000);
    for (let tick = 0; tick <= 50; ++tick) history.push({ tick, bytes: 1 });
    const ticks = (from: number, to: number, stride: number) => history.around(from, to, stride).map((e) => e.tick);
    expect(ticks(10, 12, 1)).toEqual([9, 10, 11, 12, 13]);
    expect(ticks(10, 20, 8)).toEqual([8, 16, 24]);
    expect(ticks(49, 99, 1)).toEqual([48, 49, 50]);
    expect(ticks(0, 0, 1)).toEqual([0, 1]);
  });
});
