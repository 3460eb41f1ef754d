// SPDX-License-Identifier: MIT
// The page's side, with the worker's logic behind it in the same thread; and the cache alone.
import { describe, expect, it } from 'vitest';
import { FrameCache } from '../src/source/cache';
import { type OpenRequest, Source, type WorkerLike } from '../src/source/client';
import type { Reply, Request } from '../src/source/protocol';
import { RecordingHost } from '../src/source/recording_host';
import { bytesOf, frameAt, zstd } from './support';

class ThreadlessWorker implements WorkerLike {
  onmessage: WorkerLike['onmessage'] = null;
  onerror: WorkerLike['onerror'] = null;
  onmessageerror: WorkerLike['onmessageerror'] = null;
  readonly requests: Request[] = [];
  ended = false;
  private readonly host = new RecordingHost((reply) => setTimeout(() => this.reply(reply), 0), () => zstd);

  constructor(private readonly answers = true) {}
  postMessage(request: Request): void {
    this.requests.push(request);
    if (this.answers) setTimeout(() => this.host.receive(request), 0);
  }
  reply(reply: Reply): void {
    this.onmessage?.({ data: reply } as MessageEvent<Reply>);
  }
  terminate(): void {
    this.ended = true;
  }
}

async function until(condition: () => boolean): Promise<void> {
  while (!condition()) await new Promise((resolve) => setTimeout(resolve, 2));
}

function openThree(worker = new ThreadlessWorker()): Source {
  return new Source(worker, { type: 'open', file: new Blob([bytesOf('three')]), name: 'run.mcap' } as OpenRequest);
}

describe('a source', () => {
  it('has frames once they were fetched, and not before', async () => {
    const source = openThree();
    expect(source.pair(0)).toBeNull();
    await until(() => source.ready);
    expect(source.pair(5.03)).toBeNull();
    expect(source.limit(5, 6, 1)).toBe(5);
    source.prefetch(5.03, 1, 1);
    await until(() => source.pair(5.03) !== null);
    expect(source.pair(5.03)!.before.tick).toBe(50);
    expect(source.pair(5.03)!.after!.tick).toBe(51);
    expect(source.limit(5, 6, 1)).toBe(6);
    expect(source.pair(5.1)!.before.tick).toBe(51);
    expect(source.framesBetween(4.95, 5.25).map((f) => f.tick)).toEqual([50, 51, 52]);
    source.prefetch(999, 0, 1);
    await until(() => source.pair(999) !== null);
    expect(source.pair(999)).toMatchObject({ before: { tick: 117 }, after: null });
    expect(source.limit(11.65, 50, 1)).toBe(50);
  });

  it('tells series and events, and the setting of a moment', async () => {
    const source = openThree();
    await until(() => source.series.value.tick !== undefined);
    expect(source.series.value.alive[0]).toBe(18);
    expect(source.events.value.at(-1)!.kind).toBe('complete');
    expect(source.settingAt(3)!.range_m).toBe(2);
    const message = await source.message(0, 20);
    expect(message).toMatchObject({ id: 0, phase: 3 });
    await expect(source.intervene(3, [])).rejects.toThrow('a recording cannot be changed');
    expect(source.failure.value).toBeNull();
  });

  it('asks for little at a time, and not twice for the same', async () => {
    const worker = new ThreadlessWorker();
    const source = openThree(worker);
    await until(() => source.ready);
    for (let k = 0; k < 50; ++k) source.prefetch(0, 64, 1);
    expect(worker.requests.filter((r) => r.type === 'frames').length).toBe(2);
  });

  it('that could not be opened says why', async () => {
    const source = new Source(new ThreadlessWorker(), { type: 'open', file: new Blob(['?']), name: 'x' });
    await until(() => source.failure.value !== null);
    expect(source.failure.value!.message).toBe('x: is not an MCAP file');
    await expect(source.saveScenario()).rejects.toThrow('not an MCAP');
  });

  it('whose worker crashes is an error in words', async () => {
    const worker = new ThreadlessWorker(false);
    const source = openThree(worker);
    const asked = source.saveRecording();
    worker.onerror!({ message: 'out of memory' } as ErrorEvent);
    await expect(asked).rejects.toThrow('has crashed: out of memory');
    expect(source.failure.value!.message).toContain('out of memory');
    expect(worker.ended).toBe(true);
  });

  it('tells of frames that cannot be had, and tries again when told to', async () => {
    const worker = new ThreadlessWorker(false);
    const source = new Source(worker, { type: 'open_url', url: 'x', name: 'x', size: 0 });
    const header = { settings: [{ timeS: 0, setting: { tick_s: 0.1 } }], robots: 1, startS: 0, endS: 3, growing: false };
    worker.reply({ type: 'header', header } as unknown as Reply);
    for (let id = 1; id <= 3; ++id) {
      expect(source.trouble.value).toBeNull();
      source.prefetch(0, 0, 1);
      worker.reply({ type: 'failed', id, text: 'the server does not answer' });
      await new Promise((resolve) => setTimeout(resolve, 0));
    }
    expect(source.trouble.value!.message).toBe('the server does not answer');
    source.prefetch(0, 0, 1);
    expect(worker.requests.length).toBe(4); // not for ever
    source.retry();
    source.prefetch(0, 0, 1);
    expect(worker.requests.length).toBe(5);
  });

  const liveHeader = (endS: number) => ({
    type: 'header',
    header: { kind: 'live', settings: [{ timeS: 0, setting: { tick_s: 0.1 } }], robots: 1, startS: 0, endS, growing: true },
  }) as unknown as Reply;

  /** Asks for frames and gets the first seven; what the answer is to. */
  function sevenFrames(worker: ThreadlessWorker, source: Source): () => void {
    source.prefetch(0, 1, 1);
    const ask = worker.requests.at(-1) as Extract<Request, { type: 'frames' }>;
    expect(ask).toMatchObject({ type: 'frames', fromS: -0.05, toS: 0.5 });
    const frames = Array.from({ length: 7 }, (_, tick) => frameAt(tick));
    return () => worker.reply({ type: 'frames', id: ask.id, frames, untilS: 0.5, endS: 0.6 });
  }

  async function liveSource(): Promise<{ worker: ThreadlessWorker; source: Source }> {
    const worker = new ThreadlessWorker(false);
    const source = new Source(worker, { type: 'open_live', run: { name: 'x', text: '', overrides: [] } });
    worker.reply(liveHeader(0));
    sevenFrames(worker, source)();
    await until(() => source.pair(0.35) !== null);
    return { worker, source };
  }

  it('forgets what an intervention undid at once, and keeps what was fetched after it', async () => {
    const { worker, source } = await liveSource();
    const done = source.intervene(3, [{ kind: 'die', robot: 0 }]);
    const { id } = worker.requests.at(-1) as Extract<Request, { type: 'intervene' }>;
    expect(source.pair(0.35)).toBeNull(); // the worker has not even seen it
    expect(source.endS).toBeCloseTo(0.3);
    worker.reply(liveHeader(0.6)); // was under way
    expect(source.endS).toBeCloseTo(0.3);
    const answer = sevenFrames(worker, source);
    worker.reply({ type: 'done', id });
    answer();
    await done;
    await until(() => source.pair(0.35) !== null);
    expect(source.endS).toBeCloseTo(0.6);
  });

  it('fetches again what an intervention that could not be made it forget', async () => {
    const { worker, source } = await liveSource();
    const done = source.intervene(3, [{ kind: 'die', robot: 99 }]);
    worker.reply({ type: 'failed', id: (worker.requests.at(-1) as { id: number }).id, text: 'no such robot' });
    await expect(done).rejects.toThrow('no such robot');
    sevenFrames(worker, source)();
    await until(() => source.pair(0.35) !== null);
  });

  it('forgets everything at a reset', async () => {
    const { worker, source } = await liveSource();
    const done = source.reset();
    expect(worker.requests.at(-1)).toMatchObject({ type: 'reset' });
    expect(source.pair(0.35)).toBeNull();
    expect(source.endS).toBe(0);
    worker.reply({ type: 'done', id: (worker.requests.at(-1) as { id: number }).id });
    await done;
  });
});

describe('the cache', () => {
  const block = (from: number, to: number) => Array.from({ length: to - from + 1 }, (_, k) => frameAt(from + k));

  it('keeps to its bytes and drops what was used least recently', () => {
    const cache = new FrameCache(0.1, 1000, 2_000_000);
    const spans = [0, 1, 2].map((index) => ({ stride: 1, index }));
    for (const span of spans) {
      const first = Math.round((cache.startOf(span) + 0.05) / 0.1);
      const frames = block(first, first + 5).map((f) => ({ ...f, data: new Float64Array(18000) }));
      cache.put(span, { frames, untilS: cache.endOf(span), endS: 99 });
      expect(cache.bytesKept).toBeLessThanOrEqual(2_000_000);
    }
    expect(cache.missingFrom(spans[2])).toBeNull();
    expect(cache.missingFrom(spans[0])).not.toBeNull();
  });

  it('puts pieces of a block together', () => {
    const cache = new FrameCache(0.1, 1);
    const span = { stride: 1, index: 0 };
    cache.put(span, { frames: block(0, 4), untilS: 0.4, endS: 0.4 });
    expect(cache.missingFrom(span)).toBeCloseTo(0.4);
    expect(cache.pair(0.4, 1, true)).toMatchObject({ before: { tick: 4 }, after: null });
    expect(cache.pair(0.45, 1, true)).toBeNull();
    expect(cache.pair(0.45, 1, false)).toBeNull();
    cache.put(span, { frames: block(4, 70), untilS: 6.35, endS: 9 });
    expect(cache.missingFrom(span)).toBeNull();
    expect(cache.pair(0.45, 1, true)).toMatchObject({ before: { tick: 4 }, after: { tick: 5 } });
  });

  it('serves a coarser frame in need, a finer one always', () => {
    const cache = new FrameCache(0.1, 1);
    cache.put({ stride: 4, index: 0 }, { frames: [frameAt(0), frameAt(4), frameAt(8)], untilS: 99, endS: 99 });
    expect(cache.pair(0.5, 1, false)).toMatchObject({ before: { tick: 4 }, after: { tick: 8 } });
    expect(cache.pair(0.5, 1, false, false)).toBeNull();
    expect(cache.pair(0.5, 16, false, false)).toMatchObject({ before: { tick: 4 } });
  });
});
