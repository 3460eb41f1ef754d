// SPDX-License-Identifier: MIT
// What a visitor does, in WebAssembly: refused in words or done; and what is saved is what was seen.
import assert from 'node:assert/strict';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { banyan, module, native, open, scenarios, until } from './together.mjs';

const rooms = await readFile(join(scenarios, 'rooms.toml'), 'utf8');
const threeTargets = await readFile(join(scenarios, 'three-targets.toml'), 'utf8');
const deaths = await readFile(join(scenarios, 'deaths.toml'), 'utf8');

const day = [
  [0, { kind: 'set_loss', loss: 0.1 }],
  [7, { kind: 'die', robot: 4 }],
  [33, { kind: 'move_obstacle', obstacle: 4, position_m: [0.3, -0.7] }],
  [33, { kind: 'set_line_of_sight', line_of_sight: false }],
  [34, { kind: 'add_target', position_m: [1.3, 1.1] }],
  [60, { kind: 'blackout', duration_s: 1.7 }],
  [71, { kind: 'move_target', target: 0, position_m: [-1.1, -1.9], speed_m_s: 0.07 }],
  [71, { kind: 'kill', count: 1, of: 'robots' }],
  [90, { kind: 'remove_target', target: 1 }],
  [97, { kind: 'set_line_of_sight', line_of_sight: true }],
];

function live_through(live, ticks = 150) {
  for (const [tick, event] of day) {
    live.step(tick - live.tick());
    assert.deepEqual(live.intervene(JSON.stringify(event)), [], `${tick}: ${event.kind}`);
  }
  live.step(ticks - live.tick());
}

test('the saved scenario, run by the program, comes to the same state', async () => {
  for (const [name, text] of [['rooms', rooms], ['deaths', deaths]]) {
    const live = open(text, name === 'deaths' ? ['seed=5'] : []);
    if (name === 'rooms') live_through(live);
    else {
      live.step(100);
      assert.deepEqual(live.intervene('{"kind": "kill", "of": "worker_and_parent", "count": 2, "every_s": 1.3}'), []);
      live.step(80);
    }
    const saved = live.scenarioToml();
    const result = await native(saved, until(live.tick()));
    assert.equal(result.ticks, live.tick());
    assert.equal(result.hash, live.hash(), name);
    // And in the browser, loaded again.
    const again = open(saved);
    again.step(live.tick());
    assert.equal(again.hash(), live.hash(), name);
    assert.equal(again.scenarioToml(), saved);
  }
});

test('beyond the end of the mission the saved scenario goes on as far', async () => {
  const live = open(threeTargets);
  while (!live.finished()) live.step(1);
  live.step(20);
  assert.deepEqual(live.intervene('{"kind": "move_target", "target": 0, "position_m": [2, 2]}'), []);
  live.step(37);
  const result = await native(live.scenarioToml());
  assert.equal(result.ticks, live.tick());
  assert.equal(result.hash, live.hash());
});

test('going back and doing the same again ends in the same state', () => {
  const live = open(rooms);
  live_through(live);
  const [hash, frame] = [live.hash(), live.frame()];
  live.rewind(50);
  assert.equal(live.tick(), 50);
  for (const [tick, event] of day.filter(([tick]) => tick >= 50)) {
    live.step(tick - live.tick());
    live.intervene(JSON.stringify(event));
  }
  live.step(150 - live.tick());
  assert.equal(live.hash(), hash);
  assert.deepEqual(live.frame(), frame);
  live.rewind(0);
  live.step(150);
  assert.notEqual(live.hash(), hash, 'everything done has been forgotten');
});

test('a picture has what it needs', () => {
  const live = open(rooms);
  const before = JSON.parse(live.settingJson());
  const version = live.settingVersion();
  live.step(20);
  assert.equal(live.settingVersion(), version);
  live.intervene('{"kind": "move_obstacle", "obstacle": 0, "position_m": [0, 3]}');
  live.intervene('{"kind": "set_line_of_sight", "line_of_sight": false}');
  assert.equal(live.settingVersion(), version, 'it happens in the next step');
  live.step(1);
  const after = JSON.parse(live.settingJson());
  assert.notEqual(live.settingVersion(), version);
  assert.equal(before.line_of_sight, true);
  assert.equal(after.line_of_sight, false);
  assert.notDeepEqual(after.obstacles[0], before.obstacles[0]);
  assert.deepEqual(after.obstacles.slice(1), before.obstacles.slice(1));
  const frame = live.frame();
  assert.equal(frame.length, live.robots() * module.columns().length);
  assert.ok(frame.every(Number.isFinite));
  live.step(100);
  assert.notDeepEqual(live.frame(), frame, 'what was handed out is a copy');
  const targets = JSON.parse(live.targetsJson());
  assert.equal(targets.x_m.length, targets.worker.length);
  assert.equal(JSON.parse(live.metricsJson()).tick, 121);
  assert.ok(JSON.parse(live.takeEventsJson()).length > 0);
  assert.deepEqual(JSON.parse(live.takeEventsJson()), []);
  const message = JSON.parse(live.messageJson(3));
  assert.equal(message.id, 3);
  assert.ok(['spare', 'connector', 'worker', 'root'].includes(message.role));
  assert.equal(live.messageJson(10000), 'null');
});

test('what cannot happen is refused in words and changes nothing', () => {
  const live = open(rooms);
  live.step(10);
  const hash = live.hash();
  const refused = [
    [{ kind: 'die', robot: 1000 }, 'robot: there is no robot 1000; the last one is 35'],
    [{ kind: 'die', robot: 4294967297 }, 'robot: is 4294967297; allowed'],
    [{ kind: 'die', robot: -1 }, 'robot: is -1; allowed'],
    [{ kind: 'move_target', target: 17, position_m: [0, 0] }, 'target: there is no target 17'],
    [{ kind: 'move_obstacle', obstacle: 99, position_m: [0, 0] }, 'obstacle: there is no obstacle 99'],
    [{ kind: 'move_obstacle', obstacle: 1, position_m: [0, null] }, 'position_m[1]: must be a number'],
    [{ kind: 'set_line_of_sight', line_of_sight: 'no' }, 'line_of_sight: must be true or false'],
    [{ kind: 'set_loss', loss: 1.5 }, 'loss: is 1.5; allowed: 0 to 1'],
    [{ kind: 'set_loss', loss: 0.5, time_s: 3 }, 'time_s: '],
    [{ kind: 'set_loss', loss: 0.5, when: 'complete' }, 'when: '],
    [{ kind: 'explode' }, 'kind: must be "die"'],
    [[1, 2], 'an intervention is a table of keys'],
    [7, 'an intervention is a table of keys'],
  ];
  for (const [event, words] of refused) {
    const said = live.intervene(JSON.stringify(event));
    assert.ok(said.some((line) => line.startsWith(words)), `${JSON.stringify(event)}: ${said.join('; ')}`);
  }
  assert.ok(live.intervene('{"kind": ')[0].startsWith('this is not JSON'));
  assert.equal(live.hash(), hash);
  live.step(5);
  const untouched = open(rooms);
  untouched.step(15);
  assert.equal(live.hash(), untouched.hash());
  assert.equal(live.scenarioToml(), untouched.scenarioToml());
});

test('a scenario that cannot be loaded says why, as the program does', async () => {
  const live = new module.Live();
  const wrong = '[radio]\nlos = 3\nloss = 2\n[targets]\ncount = 3\n';
  const said = live.load('worlds/wrong.toml', wrong, ['tick_s=7', 'nonsense']);
  assert.equal(live.loaded(), false);
  const at = await mkdtemp(join(tmpdir(), 'banyan-wasm-'));
  const file = join(at, 'wrong.toml');
  await writeFile(file, wrong);
  const native = await banyan('validate', file, '--set', 'tick_s=7', '--set', 'nonsense').catch((error) => error);
  await rm(at, { recursive: true });
  for (const line of said)
    assert.ok(native.stderr.includes(line.replace('worlds/wrong.toml', file)), `${line}\n--- not in ---\n${native.stderr}`);
  assert.equal(said.length, 4);
  assert.deepEqual(live.load('a.toml', threeTargets, ['robot.body=box2d']), [
    "--set robot.body=box2d: error: robot.body: the body model box2d is not in the browser's build; use disks or linear",
  ]);
  for (const call of [() => live.step(1), () => live.hash(), () => live.frame(), () => live.recording()])
    assert.throws(call, { message: 'no scenario is loaded' });
  assert.deepEqual(live.load('a.toml', threeTargets, []), []);
  assert.throws(() => live.rewind(1), { message: 'there is no tick 1 yet' });
});

test('numbers are written as the program writes them', async () => {
  const odd = ['radio.range_m=1.9000000000000001', 'mission.time_limit_s=123456.7', 'radio.loss=1e-5', 'robot.radius_m=0.07040001',
               'mission.settle_s=0.30000000000000004', 'targets.phase_deg=33.3', 'radio.bearing_noise_deg=1.7'];
  const live = open(threeTargets, odd, 'three-targets.toml');
  const at = await mkdtemp(join(tmpdir(), 'banyan-wasm-'));
  try {
    const file = join(at, 'three-targets.toml');
    await writeFile(file, threeTargets);
    await banyan('run', file, '--quiet', '--out', join(at, 'out'), ...odd.flatMap((o) => ['--set', o]), '--set', 'mission.time_limit_s=2');
    const saved = JSON.parse(await readFile(join(at, 'out', 'run.json'), 'utf8')).config;
    const mine = JSON.parse(live.configJson());
    mine.mission.time_limit_s = 2;
    assert.deepEqual(mine, saved);
  } finally {
    await rm(at, { recursive: true, force: true });
  }
});

// Of every magnitude, and whole ones beyond what digits tell apart: what libc++ 14 cannot write.
test('so are numbers in messages', async () => {
  let bits = 1n;
  const any = (k) => {
    bits = BigInt.asUintN(64, bits * 6364136223846793005n + 1442695040888963407n);
    if (k % 3 === 0) return -Number(bits % 1000000n) / 10 ** (k % 11);
    if (k % 3 === 1) return -Number(bits) * 2 ** (k % 30);
    return new Float64Array(new BigUint64Array([bits | 0x8000000000000000n]).buffer)[0];
  };
  const at = await mkdtemp(join(tmpdir(), 'banyan-wasm-'));
  for (let round = 0; round < 4; ++round) {
    let text = '[targets]\ncount = 2\n';
    for (let k = 0; k < 90; ++k) {
      const value = any(k);
      if (Number.isFinite(value)) text += `[[events]]\ntime_s = 1\nkind = "set_loss"\nloss = ${value.toExponential()}\n`;
    }
    const said = new module.Live().load('wrong.toml', text, []);
    await writeFile(join(at, 'wrong.toml'), text);
    const native = await banyan('validate', join(at, 'wrong.toml')).catch((error) => error);
    const its = native.stderr.split('\n').filter((line) => line.includes('error: events['));
    assert.ok(said.length > 80);
    assert.deepEqual(said, its.map((line) => line.replace(at + '/', '')));
  }
  await rm(at, { recursive: true });
});

test('a recording made here is one that the program reads, and says the same', async () => {
  const live = open(rooms);
  live_through(live, 120);
  const at = await mkdtemp(join(tmpdir(), 'banyan-wasm-'));
  try {
    await writeFile(join(at, 'live.mcap'), live.recording());
    await writeFile(join(at, 'live.toml'), live.scenarioToml());
    await banyan('run', join(at, 'live.toml'), '--quiet', '--out', join(at, 'out'), ...until(120).flatMap((o) => ['--set', o]));
    const mine = await banyan('export', join(at, 'live.mcap'));
    const its = await banyan('export', join(at, 'out', 'run.mcap'));
    assert.ok(mine.stdout.length > 100000);
    assert.equal(mine.stdout, its.stdout);
  } finally {
    await rm(at, { recursive: true, force: true });
  }
});
