// SPDX-License-Identifier: MIT
// Recordings of the native program, value by value against its own tables.
import { describe, expect, it } from 'vitest';
import { type Column, column, type Frame, phases, roles } from '../src/frame';
import type { Recording } from '../src/source/recording';
import { bytesOf, fileOf, type Name, numberOf, open, type Row, tableOf } from './support';

const noPause = async () => {};
const names: Name[] = ['three', 'sparse', 'moving', 'large'];

async function allFrames(recording: Recording): Promise<Frame[]> {
  const { endS } = recording.headerNow();
  const frames = new Map<number, Frame>();
  for (let fromS = 0; fromS <= endS; ) {
    const reply = await recording.frames(fromS, endS, 1);
    for (const frame of reply.frames) frames.set(frame.tick, frame);
    if (reply.untilS >= endS) break;
    fromS = reply.untilS;
  }
  return [...frames.values()].sort((a, b) => a.tick - b.tick);
}

function expectRobot(row: Row, frame: Frame, i: number): void {
  const value = (name: Column) => column(frame, name)[i];
  const index = (cell: string) => (cell === '' ? -1 : Number(cell));
  const got = [frame.tick, i, value('x_m'), value('y_m'), value('heading_rad'), value('role'), value('phase'),
    value('parent'), value('old_parent'), value('alive'), value('connected'), value('target')];
  const wanted = [Number(row.tick), Number(row.robot), Number(row.x_m), Number(row.y_m), Number(row.heading_rad),
    roles.indexOf(row.role as 'spare'), phases.indexOf(row.phase as 'init'), index(row.parent), index(row.old_parent),
    Number(row.alive), Number(row.connected), index(row.target)];
  if (got.some((v, k) => v !== wanted[k])) expect(got).toEqual(wanted);
}

describe.each(names)('the recording %s', (name) => {
  it('has the frames of the export', async () => {
    const frames = await allFrames(await open(bytesOf(name)));
    const rows = tableOf(fileOf(name, 'export.csv'));
    expect(frames.reduce((sum, frame) => sum + frame.robots, 0)).toBe(rows.length);
    let row = 0;
    for (const frame of frames) for (let i = 0; i < frame.robots; ++i) expectRobot(rows[row++], frame, i);
  });

  it('has the series of the table', async () => {
    const { series, events } = await (await open(bytesOf(name))).table(noPause);
    const rows = tableOf(fileOf(name, 'series.csv'));
    const first = series.tick.indexOf(Number(rows[0].tick)); // the start is recorded, but no row
    expect(series.tick.length).toBe(rows.length + first);
    for (const key of Object.keys(rows[0])) {
      const wanted = rows.map((row) => numberOf(row[key]));
      expect([...series[key].subarray(first)], key).toEqual(wanted);
    }
    expect(events.some((event) => event.kind === 'complete')).toBe(true);
    expect(events.map((e) => e.time_s)).toEqual(events.map((e) => e.time_s).sort((a, b) => a - b));
  });

  it('has a header without warnings', async () => {
    const header = (await open(bytesOf(name))).headerNow();
    expect(header.warnings).toEqual([]);
    expect(header.settings[0].setting.range_m).toBe(2);
    expect(header.version).toMatch(/^\d/);
    expect(header.result.hash).toMatch(/^[0-9a-f]{16}$/);
    expect(header.robots).toBe((await allFrames(await open(bytesOf(name))))[0].robots);
    expect(JSON.parse(header.config)).toBeTypeOf('object');
  });
});

describe('frames by range and stride', () => {
  it('are those of the range and the nearest on either side', async () => {
    const recording = await open(bytesOf('three'));
    const ticks = async (from: number, to: number, stride: number) =>
      (await recording.frames(from, to, stride)).frames.map((f) => f.tick);
    expect(await ticks(1, 1.3, 1)).toEqual([9, 10, 11, 12, 13, 14]);
    expect(await ticks(1.05, 1.15, 1)).toEqual([10, 11, 12]);
    expect(await ticks(1, 5, 16)).toEqual([0, 16, 32, 48, 64]);
    expect(await ticks(0, 0, 1)).toEqual([0, 1]);
    expect(await ticks(11.7, 99, 1)).toEqual([116, 117]);
    expect(await ticks(11, 12, 64)).toEqual([64, 117]); // the last one is always there
    expect(await ticks(500, 600, 1)).toEqual([117]);
    expect(await ticks(-5, -1, 1)).toEqual([0, 1]);
  });

  it('of a recording of every seventh tick', async () => {
    const recording = await open(bytesOf('sparse'));
    expect((await recording.frames(1.5, 1.6, 1)).frames.map((f) => f.tick)).toEqual([14, 21]);
    expect((await recording.frames(11, 12, 1)).frames.map((f) => f.tick)).toEqual([105, 112, 117]);
  });

  it('are the same in any order and with a tiny cache', async () => {
    const wide = await open(bytesOf('large'));
    const narrow = await open(bytesOf('large'), 1);
    for (const [from, to, stride] of [[40, 42, 1], [0, 80, 64], [10, 11, 2], [80, 90, 1], [3, 30, 32], [41, 41, 1]]) {
      expect(await narrow.frames(from, to, stride)).toEqual(await wide.frames(from, to, stride));
    }
  });

  it('need few bytes and few chunks', async () => {
    const recording = await open(bytesOf('large'));
    expect(recording.chunksUnpacked).toBeLessThanOrEqual(4);
    await recording.frames(0, 0, 1);
    expect(recording.bytesRead).toBeLessThan(bytesOf('large').length / 2);
  });
});

describe('targets', () => {
  it('are those of the last message before a frame', async () => {
    const recording = await open(bytesOf('moving'));
    const frames = await allFrames(recording);
    const { events } = await recording.table(noPause);
    const added = events.filter((event) => event.kind === 'target_added');
    const moved = events.filter((event) => event.kind === 'target_moved');
    expect(added.length + moved.length).toBeGreaterThan(0);
    const at = (tick: number) => frames.find((frame) => frame.tick === tick)!.targets;
    for (const event of added) expect(at(event.tick).x.length).toBeGreaterThan(at(event.tick - 1).x.length);
    for (const { tick, target } of moved) expect(at(tick).x[target]).not.toBe(at(tick - 1).x[target]);
    const single = await (await open(bytesOf('moving'))).frames(frames[700].timeS, frames[700].timeS, 1);
    expect(single.frames.find((f) => f.tick === frames[700].tick)).toEqual(frames[700]);
  });
});
