// SPDX-License-Identifier: MIT
// Recordings that are read while they are written: a file of the native program of which more and more is there,
// against the same file read at once.
import { describe, expect, it } from 'vitest';
import type { Bytes } from '../src/source/bytes';
import type { Frame } from '../src/frame';
import { Problem } from '../src/source/problem';
import type { Header, Reply } from '../src/source/protocol';
import { Recording } from '../src/source/recording';
import { RecordingHost } from '../src/source/recording_host';
import { Source, type WorkerLike } from '../src/source/client';
import type { Request } from '../src/source/protocol';
import { bytesOf, open, random, zstd } from './support';

const noPause = async () => {};
// Of their recordings the first 38,000 bytes are schemas; what is where, banyan's own tests know.

/** A file of which `size` bytes are there so far. */
class Growing implements Bytes {
  size = 0;
  growing = true;
  taken = 0;
  gone = false;
  constructor(public all: Uint8Array, public there = 0) {}
  async look(): Promise<void> {
    if (this.gone) throw new Problem('the server does not answer');
    this.size = this.there;
  }
  async read(offset: number, length: number): Promise<Uint8Array> {
    if (offset + length > this.there) throw new Problem('the file ends too early');
    return this.all.slice(offset, offset + length);
  }
  add(bytes: number): void { this.there = Math.min(this.all.length, this.there + bytes); }
}

async function opened(bytes: Growing): Promise<Recording> {
  await bytes.look();
  return await Recording.open(bytes, 'run.mcap.part', await zstd);
}

const ticks = (frames: Frame[]) => frames.map((frame) => frame.tick);

describe('a recording that grows', () => {
  it('tells in pieces, cut anywhere, what it tells at once', async () => {
    const all = bytesOf('moving');
    const wanted = await open(all);
    const { endS, result, settings } = wanted.headerNow();
    const table = await wanted.table(noPause);
    const next = random(7);
    const bytes = new Growing(all, 45_000);
    const recording = await opened(bytes);
    expect(recording.following).toBe(true);
    expect(recording.headerNow().endS).toBeLessThan(endS);
    const times: number[] = [], events: string[] = [];
    for (let growth = 'more'; growth !== 'over'; ) {
      const told = await recording.table(noPause);
      expect(told.whole).toBe(times.length === 0);
      times.push(...(told.series.time_s ?? []));
      events.push(...told.events.map((event) => event.text));
      const now = recording.headerNow();
      expect(now.warnings).toEqual([]);
      expect((await recording.frames(now.endS, 1e6, 1)).untilS).toBe(now.following ? now.endS : 1e6); // the rest is still to come
      bytes.add(1 + Math.floor(next() * 20_000));
      bytes.growing = bytes.there < all.length;
      growth = await recording.grow();
    }
    const told = await recording.table(noPause);
    times.push(...(told.series.time_s ?? []));
    events.push(...told.events.map((event) => event.text));
    expect(times).toEqual([...table.series.time_s]);
    expect(events).toEqual(table.events.map((event) => event.text));
    expect(recording.headerNow()).toMatchObject({ endS, result, settings, following: false, warnings: [] });
    for (const fromS of [0, 3, endS - 1]) {
      expect(ticks((await recording.frames(fromS, fromS + 2, 1)).frames)).toEqual(ticks((await wanted.frames(fromS, fromS + 2, 1)).frames));
    }
  }, 20_000);

  it('is waited for until there is a moment to show', async () => {
    const bytes = new Growing(bytesOf('three'), 3);
    const opening = opened(bytes);
    setTimeout(() => bytes.add(1000), 100); // channels
    setTimeout(() => bytes.add(45_000), 500);
    expect((await opening).headerNow().endS).toBeGreaterThan(0);
  });

  it('whose writer died is shown as far as it goes, and says so', async () => {
    const bytes = new Growing(bytesOf('three'), 60_000);
    const recording = await opened(bytes);
    bytes.add(20_001);
    bytes.growing = false;
    expect(await recording.grow()).toBe('over');
    const header = recording.headerNow();
    expect(header.following).toBe(false);
    expect(header.result).toEqual({});
    expect(header.warnings.join()).toContain('has ended without finishing it');
    const cut = await open(bytesOf('three').slice(0, 80_001));
    expect(header.endS).toBe(cut.headerNow().endS);
  });

  it('is known again, or not', async () => {
    const bytes = new Growing(bytesOf('three'), 60_000);
    const recording = await opened(bytes);
    expect(await recording.grow()).toBe('none');
    bytes.there = 50_000; // cut short in the middle of what has been read
    expect(await recording.grow()).toBe('another');
    bytes.all = bytesOf('moving');
    bytes.there = 90_000; // another one, longer
    expect(await recording.grow()).toBe('another');
  });

  it('with damage in the middle loses what was in it, and goes on', async () => {
    const all = bytesOf('three');
    all.fill(0xaa, 55_000, 55_200);
    const bytes = new Growing(all, 45_000);
    const recording = await opened(bytes);
    bytes.there = all.length;
    bytes.growing = false;
    expect(await recording.grow()).toBe('over');
    await recording.frames(0, 100, 1);
    expect(recording.headerNow().warnings.join()).toContain('damaged');
    expect(recording.headerNow().endS).toBe((await open(bytesOf('three'))).headerNow().endS);
  });
});

/** A worker without a thread, whose file is at a made-up server. */
class Fed implements WorkerLike {
  onmessage: WorkerLike['onmessage'] = null;
  onerror = null;
  onmessageerror = null;
  private readonly host = new RecordingHost((reply: Reply) => this.onmessage?.({ data: reply } as MessageEvent<Reply>), () => zstd);
  postMessage(request: Request): void { this.host.receive(request); }
  terminate(): void {}
}

/** What is fetched from then on comes from there. */
function serve(bytes: Growing): void {
  globalThis.fetch = (async (_: unknown, init?: RequestInit) => {
    if (bytes.gone) throw new TypeError('Failed to fetch');
    const [, from, to] = /bytes=(\d+)-(\d+)/.exec(String((init!.headers as Record<string, string>).Range))!.map(Number);
    const headers = new Headers(bytes.growing ? { 'Banyan-Growing': '1' } : {});
    if (from >= bytes.there) return new Response(null, { status: 416, headers });
    const body = bytes.all.slice(from, Math.min(to + 1, bytes.there));
    headers.set('Content-Range', `bytes ${from}-${to}/${bytes.there}`);
    return new Response(body, { status: 206, headers });
  }) as typeof fetch;
}

async function until(what: () => boolean): Promise<void> {
  for (let k = 0; k < 800 && !what(); ++k) await new Promise((resolve) => setTimeout(resolve, 10));
  expect(what()).toBe(true);
}

describe('the page beside a recording that grows', () => {
  function follow(bytes: Growing): Source {
    serve(bytes);
    return new Source(new Fed(), { type: 'open_url', url: 'http://x/file', name: 'run.mcap.part', size: bytes.there });
  }
  const fetched = async (source: Source, timeS: number) => {
    await until(() => { source.prefetch(timeS, 0, 1); return source.pair(timeS) !== null; });
    return source.pair(timeS)!.before.timeS;
  };

  it('has the newest moment soon, and all before', async () => {
    const all = bytesOf('three');
    const bytes = new Growing(all, 53_500);
    const source = follow(bytes);
    await until(() => source.following && source.series.value.time_s !== undefined);
    const firstS = source.endS;
    expect(await fetched(source, firstS)).toBe(firstS);
    bytes.add(40_000);
    await until(() => source.endS > firstS);
    expect(await fetched(source, source.endS)).toBe(source.endS);
    expect(await fetched(source, firstS + 0.1)).toBeCloseTo(firstS + 0.1);
    expect(source.pair(firstS + 0.15)!.after!.timeS).toBeCloseTo(firstS + 0.2); // no gap where it ended before
    bytes.there = all.length;
    bytes.growing = false;
    await until(() => !source.following);
    expect(source.header.value!.result.complete).toBe('true');
    await until(() => source.series.value.time_s.at(-1) === source.endS);
    expect(source.header.value!.warnings).toEqual([]);
  });

  it('begins anew with it', async () => {
    const bytes = new Growing(bytesOf('three'), 60_000);
    const source = follow(bytes);
    await until(() => source.following);
    const headers: Header[] = [];
    source.header.subscribe((header) => headers.push(header!));
    expect(await fetched(source, 0.5)).toBe(0.5);
    bytes.all = bytesOf('moving');
    bytes.there = 45_000;
    await until(() => headers.some((header) => header.take === 1));
    expect(source.endS).toBeLessThan(20);
    await fetched(source, source.endS);
    expect(source.pair(0)!.before.robots).toBe((await open(bytesOf('moving'))).headerNow().robots);
    expect(source.failure.value).toBeNull();
  });

  it('keeps what it has when the server is gone', async () => {
    const bytes = new Growing(bytesOf('three'), 60_000);
    const source = follow(bytes);
    await until(() => source.following);
    await fetched(source, 1);
    bytes.gone = true;
    await until(() => !source.following);
    expect(source.header.value!.warnings.join()).toContain('not followed any more: cannot be loaded: the server does not answer');
    expect(await fetched(source, 1)).toBe(1);
  });
});
