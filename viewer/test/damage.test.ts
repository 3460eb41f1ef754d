// SPDX-License-Identifier: MIT
// Files that are cut short, damaged, foreign or no recordings: words, never a crash, never nonsense.
import { McapWriter } from '@mcap/core';
import { describe, expect, it } from 'vitest';
import { columns } from '../src/frame';
import { RecordingHost } from '../src/source/recording_host';
import type { Reply } from '../src/source/protocol';
import type { Recording } from '../src/source/recording';
import { bytesOf, open, random, zstd } from './support';

const noPause = async () => {};

/** Another program's file, or one of Banyan's made by hand. */
async function written(topics: Record<string, object[]>, options: object = {}, metadata: [string, Record<string, string>][] = []): Promise<Uint8Array<ArrayBuffer>> {
  const parts: Uint8Array[] = [];
  let size = 0n;
  const writable = {
    write: async (bytes: Uint8Array) => { parts.push(bytes.slice()); size += BigInt(bytes.length); },
    position: () => size,
  };
  const writer = new McapWriter({ writable, ...options });
  await writer.start({ profile: '', library: 'test' });
  for (const [name, entries] of metadata) await writer.addMetadata({ name, metadata: new Map(Object.entries(entries)) });
  for (const [topic, messages] of Object.entries(topics)) {
    const channelId = await writer.registerChannel({ schemaId: 0, topic, messageEncoding: 'json', metadata: new Map() });
    for (const [sequence, message] of messages.entries()) {
      const seconds = (message as { time_s?: number }).time_s ?? 0;
      const time = BigInt(Math.round(seconds * 1e9));
      const data = new TextEncoder().encode(JSON.stringify(message));
      await writer.addMessage({ channelId, sequence, logTime: time, publishTime: time, data });
    }
  }
  await writer.end();
  return new Uint8Array(await new Blob(parts as Uint8Array<ArrayBuffer>[]).arrayBuffer());
}

function frameJson(tick: number, robots = 2): Record<string, unknown> {
  const arrays = columns.map((name) => [name, Array.from({ length: robots }, () => (name === 'label_m' ? -1 : 0))]);
  return { tick, time_s: tick / 10, ...Object.fromEntries(arrays) };
}
const setting = {
  name: 'by hand', algorithm: 'convoy', reading: 'corrected', seed: 1, tick_s: 0.1, radius_m: 0.1, range_m: 3,
  line_of_sight: true, sight_leak: 0, dead_bodies: true, target_tolerance_m: 0.2, time_limit_s: 9, obstacles: [],
};

const told = (value: object): [string, Record<string, string>] => ['banyan.setting', { json: JSON.stringify(value) }];

describe('what is no recording is told in words', () => {
  it.each([
    ['nothing', new Uint8Array(0), 'is empty'],
    ['a text', new TextEncoder().encode('tick,time_s\n1,0.1\n'), 'is not an MCAP file'],
    ['half a magic', Uint8Array.of(0x89, 0x4d), 'is not an MCAP file'],
    ['a bag of zeros', new Uint8Array(1000), 'is not an MCAP file'],
    ['the magic alone', bytesHead(8), 'no channel /banyan/frame'],
  ])('%s', async (_, bytes, words) => {
    await expect(open(bytes as Uint8Array<ArrayBuffer>)).rejects.toThrow(words as string);
  });

  it("another program's file", async () => {
    await expect(open(await written({ '/camera': [{ a: 1 }] }))).rejects.toThrow('is not a recording of Banyan: no channel /banyan/frame');
  });
  it("another program's file with lz4", async () => {
    const bytes = await written({ '/banyan/frame': [frameJson(0)] }, {
      compressChunk: (data: Uint8Array) => ({ compression: 'lz4', compressedData: data }),
    });
    await expect(open(bytes)).rejects.toThrow("compression 'lz4' is not supported, only zstd and none");
  });
  it('a recording without a frame', async () => {
    await expect(open(await written({ '/banyan/frame': [] }))).rejects.toThrow('holds no frame');
  });
  it('a directory', async () => {
    const blob = { size: 4096, slice: () => ({ arrayBuffer: () => Promise.reject(new Error('NotFoundError')) }) };
    const { BlobBytes } = await import('../src/source/bytes');
    const { Recording } = await import('../src/source/recording');
    const opening = Recording.open(new BlobBytes(blob as unknown as Blob), 'x', await zstd);
    await expect(opening).rejects.toThrow('cannot be read; is it a directory');
  });
});

function bytesHead(length: number): Uint8Array {
  return Uint8Array.of(0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a).subarray(0, length);
}

describe('a recording that was cut short', () => {
  it.each([0.3, 0.5, 0.77, 0.9, 0.999])('at %d of its length is read up to there', async (share) => {
    const whole = bytesOf('large');
    const recording = await open(whole.slice(0, Math.floor(share * whole.length)));
    const header = recording.headerNow();
    expect(header.warnings[0]).toBe('the file was cut short: it has no end; read by scanning what is there');
    expect(header.config).not.toBe('');
    expect(header.endS).toBeGreaterThan(share * 40);
    const full = await open(whole);
    const middle = header.endS / 2;
    expect(await recording.frames(middle, middle + 1, 1)).toEqual({ ...(await full.frames(middle, middle + 1, 1)), endS: header.endS });
    const { series } = await recording.table(noPause);
    expect(series.time_s.length).toBeGreaterThan(share * 400);
  });

  it('anywhere never breaks', async () => {
    const whole = bytesOf('three');
    for (let length = 9; length < whole.length; length += 2311) {
      const bytes = whole.slice(0, length);
      await open(bytes).then(async (r) => expect((await r.frames(0, 3, 1)).frames.length).toBeGreaterThan(0),
        (error: Error) => expect(error.message).toMatch(/no channel|holds no frame/));
    }
  });
});

describe('damage inside', () => {
  it('costs only the chunk it is in', async () => {
    const bytes = bytesOf('large');
    for (let i = 0; i < 64; ++i) bytes[Math.floor(bytes.length / 2) + i] ^= 0x55;
    const recording = await open(bytes);
    expect(recording.headerNow().warnings).toEqual([]); // nobody has read that far yet
    const count = async (r: Recording) => {
      const ticks = new Set<number>();
      for (let fromS = 0; fromS < 88; fromS += 4) for (const { tick } of (await r.frames(fromS, fromS + 4, 1)).frames) ticks.add(tick);
      return ticks.size;
    };
    const left = await count(recording);
    expect(recording.headerNow().warnings.join()).toMatch(/^a damaged chunk was skipped.* \(at byte \d+\)$/);
    const all = await count(await open(bytesOf('large')));
    expect(left).toBeLessThan(all);
    expect(left).toBeGreaterThan(0.7 * all);
    expect((await recording.table(noPause)).series.tick.length).toBeGreaterThan(0.7 * all);
    expect((await recording.frames(0, 87.3, 64)).frames.length).toBeGreaterThan(10);
  });

  it('of the index makes it scan', async () => {
    const bytes = bytesOf('three');
    bytes[bytes.length - 300] ^= 1;
    const recording = await open(bytes);
    expect(recording.headerNow().warnings).toEqual(['its index is damaged (checksum); read by scanning what is there']);
    expect((await recording.frames(0, 99, 1)).frames.length).toBe(118);
    expect(recording.headerNow().result.hash).toMatch(/^[0-9a-f]{16}$/);
  });

  it('anywhere, at random, never breaks', async () => {
    const whole = bytesOf('three');
    const next = random(20261122);
    for (let round = 0; round < 120; ++round) {
      const bytes = whole.slice();
      for (let flips = 1 + Math.floor(4 * next()); flips > 0; --flips) bytes[Math.floor(next() * bytes.length)] ^= 1 << Math.floor(8 * next());
      const end = next() < 0.3 ? Math.floor(next() * bytes.length) : bytes.length;
      try {
        const recording = await open(bytes.slice(0, end));
        const { frames } = await recording.frames(0, 99, 1 + Math.floor(4 * next()));
        for (const frame of frames) expect(frame.data.every(Number.isFinite)).toBe(true);
        await recording.table(noPause);
      } catch (error) {
        expect((error as Error).name).toBe('Problem');
      }
    }
  });
});

describe('what a file says is not trusted', () => {
  const bad: [string, Record<string, unknown>][] = [
    ['another length', { y_m: [0] }], ['a text', { x_m: 'all' }], ['null', { heading_rad: [null, 0] }],
    ['out of range', { role: [0, 7] }], ['not whole', { parent: [0.5, 0] }], ['far away', { x_m: [1e300, 0] }],
    ['no tick', { tick: -1 }],
  ];
  it.each(bad)('a frame with %s is skipped', async (_, change) => {
    const frames = [frameJson(0), { ...frameJson(1), ...change }, frameJson(2)];
    const recording = await open(await written({ '/banyan/frame': frames }, {}, [told(setting)]));
    const reply = await recording.frames(0, 1, 1);
    expect(reply.frames.map((f) => f.tick)).toEqual([0, 2]);
    expect(recording.headerNow().warnings.join()).toContain('the frame at 0.1 s was skipped');
  });

  it('a parent that there is not is nobody', async () => {
    const recording = await open(await written({ '/banyan/frame': [{ ...frameJson(0), parent: [1, 500] }] }));
    const { frames } = await recording.frames(0, 0, 1);
    expect([...frames[0].data.subarray(12 * 2, 13 * 2)]).toEqual([1, -1]);
  });

  it('without a setting there are defaults, and a warning', async () => {
    const { settings, warnings } = (await open(await written({ '/banyan/frame': [frameJson(0)] }))).headerNow();
    expect(settings[0].setting).toMatchObject({ range_m: 2, radius_m: 0.07, tick_s: 0.1, obstacles: [] });
    expect(warnings.join()).toContain('no banyan.setting');
  });

  it('a damaged setting keeps what is sound in it', async () => {
    const bytes = await written({ '/banyan/frame': [frameJson(0)] }, {}, [told({ ...setting, radius_m: 'big', tick_s: 0 })]);
    const { settings, warnings } = (await open(bytes)).headerNow();
    expect(settings[0].setting).toMatchObject({ range_m: 3, radius_m: 0.07, tick_s: 0.1, line_of_sight: true });
    expect(warnings.join()).toContain("the setting's 'radius_m' is not a number; a default is assumed");
  });
});

describe('a recording', () => {
  it('of another format version is refused', async () => {
    const bytes = await written({ '/banyan/frame': [frameJson(0)] }, {}, [['banyan.provenance', { format_version: '2', version: '0.9.0' }]]);
    await expect(open(bytes)).rejects.toThrow(
      "is a recording of format version '2', and this page reads 1: open it with the version of banyan that made it (0.9.0)");
  });

  it('has settings that change, and messages', async () => {
    const moved = { ...setting, time_s: 0.5, obstacles: [{ disc: true, center_m: [1, 2], radius_m: 0.3 }] };
    const bytes = await written({
      '/banyan/setting': [setting, moved],
      '/banyan/frame': Array.from({ length: 10 }, (_, tick) => ({ ...frameJson(tick), role: [3, 1] })),
      '/banyan/messages': [1, 4].map((tick) => ({ tick, time_s: tick / 10, flood_done: [0, 1], root_id: [tick, -1] })),
    }, {}, [told(setting)]);
    const recording = await open(bytes);
    const { settings } = recording.headerNow();
    expect(settings.map((s) => [s.timeS, s.setting.obstacles.length])).toEqual([[0, 0], [0.5, 1]]);
    expect(await recording.message(0, 0)).toBeNull();
    expect(await recording.message(0, 3)).toMatchObject({ id: 0, role: 3, flood_done: 0, root_id: 1 });
    expect(await recording.message(1, 9)).toMatchObject({ id: 1, role: 1, flood_done: 1, root_id: -1 });
    expect(await recording.message(7, 9)).toBeNull();
  });
});

describe('the worker', () => {
  const replies: Reply[] = [];
  const host = new RecordingHost((reply) => replies.push(reply), () => zstd);
  const settled = async (count: number) => {
    while (replies.length < count) await new Promise((resolve) => setTimeout(resolve, 5));
  };

  it('stays usable after a failure', async () => {
    host.receive({ type: 'open', file: new Blob(['nonsense, no file']), name: 'a.txt' });
    await settled(1);
    expect(replies[0]).toEqual({ type: 'failed', id: 0, text: 'a.txt: is not an MCAP file' });
    host.receive({ type: 'frames', id: 1, fromS: 0, toS: 1, stride: 1 });
    await settled(2);
    expect(replies[1]).toMatchObject({ type: 'failed', id: 1 });
    host.receive({ type: 'open', file: new Blob([bytesOf('three')]), name: 'b.mcap' });
    host.receive({ type: 'frames', id: 2, fromS: 0, toS: 1, stride: NaN });
    host.receive({ type: 'intervene', id: 3, tick: 0, events: [] });
    await settled(6);
    expect(replies.slice(2).map((r) => r.type)).toEqual(['header', 'frames', 'failed', 'series']);
  });
});
