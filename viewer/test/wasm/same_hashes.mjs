// SPDX-License-Identifier: MIT
// WebAssembly and the native program come to the same state, bit by bit (docs/determinism.md), in every
// shared scenario but the huge ones. The program is asked anew each time: no hash is written down here.
import assert from 'node:assert/strict';
import { readFile, readdir } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { module, native, open, scenarios, until, withoutFiles } from './together.mjs';

const ticks = 200;
const huge = ['swarm-500.toml', 'swarm-1000.toml', 'swarm-10000.toml', 'benchmark-1000.toml', 'benchmark-10000.toml'];

async function compare(text, overrides = [], tickS = 0.1) {
  const live = open(text, overrides);
  live.step(ticks);
  const result = await native(text, [...overrides, ...until(ticks, tickS)]);
  assert.equal(result.ticks, ticks);
  assert.equal(live.hash(), result.hash);
  live.delete();
}

for (const file of (await readdir(scenarios)).sort()) {
  if (!file.endsWith('.toml') || huge.includes(file)) continue;
  test(`${file}: ${ticks} ticks`, async () => {
    const text = await withoutFiles(join(scenarios, file));
    await compare(text, [], Number(/^tick_s = ([\d.]+)/m.exec(text)?.[1] ?? 0.1));
  });
}

const threeTargets = await readFile(join(scenarios, 'three-targets.toml'), 'utf8');
const rooms = await readFile(join(scenarios, 'rooms.toml'), 'utf8');

for (const algorithm of module.algorithms())
  for (const sight of [true, false])
    test(`rooms, ${algorithm}, line of sight ${sight}`, () =>
      compare(rooms, [`mission.algorithm=${algorithm}`, `radio.line_of_sight=${sight}`]));

test('the linear body, noise and loss, clocks of their own', () =>
  compare(threeTargets, ['robot.body=linear', 'robot.wheel_noise=0.05', 'robot.odometry_noise=0.05',
                         'radio.loss=0.2', 'radio.bearing_noise_deg=3', 'radio.range_noise_m=0.02']));
test('clocks of their own, latency and slots', () =>
  compare(threeTargets, ['clocks.asynchronous=true', 'clocks.drift=0.01', 'radio.latency_ticks=2', 'radio.slots=6']));
test('a seed beyond 32 bits', () => compare(threeTargets, ['seed=9007199254740991']));

test('three-targets: the whole run, its end and its result', async () => {
  const live = open(threeTargets);
  assert.equal(live.finished(), false);
  for (let guard = 0; !live.finished() && guard < 10000; ++guard) live.step(1);
  const result = await native(threeTargets);
  assert.equal(live.tick(), result.ticks);
  assert.equal(live.complete(), result.complete);
  assert.equal(live.hash(), result.hash);
  // Whatever the table says, in the same words; lambda_2 alone may round otherwise (docs/determinism.md).
  const mine = JSON.parse(live.resultJson());
  for (const [column, text] of Object.entries(mine)) {
    if (column.startsWith('fiedler')) continue;
    const value = result[column];
    if (typeof value === 'number') assert.equal(Number(text), value, column);
    else assert.equal(text, value === null ? '' : String(value), column);
  }
});
