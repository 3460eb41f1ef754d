// SPDX-License-Identifier: MIT
// The threads that compute a large run, in a page that was built with them: `./check --deep` builds it.
import { existsSync, readFileSync } from 'node:fs';
import { beforeAll, expect, it } from 'vitest';
import { banyan, page, scenario, served } from './harness';

beforeAll(() => {
  if (!existsSync(`${page}/threads`)) throw new Error('this page was built without threads; `test/steps page-threads` builds one that has them');
});

const { folder, visit } = served(() => scenario('three-targets'));

it('threads compute a large run where the page is isolated, and come to the same state however many they are', async () => {
  const { tab, errors } = await visit();
  expect(await tab.evaluate(() => crossOriginIsolated)).toBe(true);
  const text = readFileSync(scenario('benchmark-1000'), 'utf8');
  const ticks = 10;
  const worker = tab.workers().map((w) => w.url()).find((url) => url.includes('live.worker'))!;
  const hashes = await tab.evaluate(async ([address, scenarioText, tick]) => {
    const run = (threads: number) => new Promise<[number, string]>((done, fail) => {
      const live = new Worker(address as string, { type: 'module' });
      let used = 0;
      live.onmessage = ({ data }) => {
        if (data.type === 'header') used = data.header.threads;
        if (data.type === 'header' && data.header.endS === 0) live.postMessage({ type: 'frames', id: 1, fromS: 0, toS: 0.1 * (tick as number), stride: 1 });
        if (data.type === 'frames') live.postMessage(data.endS >= 0.1 * (tick as number) - 1e-9 ? { type: 'hash', id: 2, tick } : { type: 'frames', id: 1, fromS: 0, toS: 0.1 * (tick as number), stride: 1 });
        if (data.type === 'hash') { live.terminate(); done([used, data.hash]); }
        if (data.type === 'failed') fail(new Error(data.text));
      };
      live.postMessage({ type: 'open_live', run: { name: 'benchmark-1000.toml', text: scenarioText, overrides: [], threads } });
    });
    return [await run(1), await run(2), await run(3), await run(9)];
  }, [worker, text, ticks] as const);
  const json = banyan('run', scenario('benchmark-1000'), '--no-record', '--json', '--set', `mission.time_limit_s=${ticks / 10}`, '--set', 'mission.stop_when_complete=false', '--force', '--out', `${folder.path}/threads`);
  const { hash } = (JSON.parse(json) as { result: { hash: string } }).result;
  expect(hashes).toEqual([[1, hash], [2, hash], [3, hash], [4, hash]]);
  expect(errors).toEqual([]);
}, 120_000);
