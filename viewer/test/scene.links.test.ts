// SPDX-License-Identifier: MIT
// Links and lines of sight: by hand, against every pair looked at, and against what the program draws
// (bench/links_fixture.mjs).
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { column, type Frame, type Obstacle, type Setting } from '../src/frame';
import { Facts, FactsCache } from '../src/scene/facts';
import { Radio } from '../src/scene/links';
import { blocks, discBlocks, unitVector } from '../src/scene/sight';
import { dice, frameOf, settingOf } from './scene_frames';

const pairs = (data: Int32Array) => Array.from({ length: data.length / 2 }, (_, k) => `${data[2 * k]}-${data[2 * k + 1]}`).sort();

/** Every pair and every third, without a grid. */
function byBruteForce(setting: Setting, frame: Frame): { open: string[]; blocked: string[] } {
  const x = column(frame, 'x_m'), y = column(frame, 'y_m'), alive = column(frame, 'alive'), raised = column(frame, 'raised');
  const found = { open: [] as string[], blocked: [] as string[] };
  for (let i = 0; i < frame.robots; ++i) {
    for (let j = i + 1; j < frame.robots; ++j) {
      if (!alive[i] || !alive[j] || !(Math.sqrt((x[j]! - x[i]!) ** 2 + (y[j]! - y[i]!) ** 2) < setting.range_m)) continue;
      const others = Array.from({ length: frame.robots }, (_, k) => k).filter((k) => k !== i && k !== j);
      const stands = (o: Obstacle) => blocks(o, x[i]!, y[i]!, x[j]!, y[j]!);
      const squared = (a: number, b: number) => (x[a]! - x[b]!) ** 2 + (y[a]! - y[b]!) ** 2;
      const isUnder = (k: number) => !raised[squared(k, i) < squared(k, j) ? i : j];
      const hidden = setting.line_of_sight && (setting.obstacles.some(stands) ||
        others.some((k) => isUnder(k) && stands({ disc: true, center_m: [x[k]!, y[k]!], radius_m: setting.radius_m })));
      (hidden ? found.blocked : found.open).push(`${i}-${j}`);
    }
  }
  return { open: found.open.sort(), blocked: found.blocked.sort() };
}

const obstacles: Obstacle[] = [
  { disc: true, center_m: [0.5, 0.5], radius_m: 0.3 },
  { box: true, center_m: [-1, 0], size_m: [0.8, 0.2], angle_rad: 0.7 },
  { wall: true, from_m: [1, -2], to_m: [2, 0] },
];

function scattered(seed: number, robots: number, spreadM: number, leak = 0): Frame {
  const roll = dice(seed);
  const some = (f: () => number) => Array.from({ length: robots }, f);
  return frameOf({
    x_m: some(() => spreadM * (roll() - 0.5)), y_m: some(() => spreadM * (roll() - 0.5)), alive: some(() => (roll() < 0.1 ? 0 : 1)),
    raised: some(() => (roll() < leak ? 1 : 0)),
  });
}

describe('lines of sight', () => {
  const disc = obstacles[0]!;
  it('end at discs, and pass beside them', () => {
    expect(blocks(disc, 0, 0, 1, 1)).toBe(true);
    expect(blocks(disc, 0, 0.8, 1, 0.8)).toBe(false); // a tangent
    expect(blocks(disc, 2, 2, 1, 1)).toBe(false);
    expect(discBlocks(0, 0, 1, 0, 0, 0, 0)).toBe(true); // no length, inside
  });
  it('end at boxes, turned ones too', () => {
    const box: Obstacle = { box: true, center_m: [0, 0], size_m: [2, 1], angle_rad: Math.PI / 2 };
    expect(blocks(box, -1, 0.9, 1, 0.9)).toBe(true);
    expect(blocks(box, 0.8, -1, 0.8, 1)).toBe(false);
    expect(blocks(box, 0.1, 0.1, 0.1, 0.1)).toBe(true);
  });
  it('end at walls and at their ends, but run along them', () => {
    const wall: Obstacle = { wall: true, from_m: [0, 0], to_m: [0, 1] };
    expect(blocks(wall, -1, 0.5, 1, 0.5)).toBe(true);
    expect(blocks(wall, -1, 1, 1, 1)).toBe(true);
    expect(blocks(wall, -1, 1.001, 1, 1.001)).toBe(false);
    expect(blocks(wall, 0, -1, 0, 2)).toBe(false);
    expect(blocks(wall, 0, 0.5, 1, 0.5)).toBe(false); // begins on it
  });
  it('are the same from both ends', () => {
    const roll = dice(5);
    for (let k = 0; k < 2000; ++k) {
      const [ax, ay, bx, by] = [0, 0, 0, 0].map(() => 4 * roll() - 2) as [number, number, number, number];
      for (const o of obstacles) expect(blocks(o, ax, ay, bx, by)).toBe(blocks(o, bx, by, ax, ay));
    }
  });
  it('know sine and cosine', () => {
    for (const angle of [0, 0.3, 1.6, -2.9, 3.1, 6.2, -6.2, 100]) {
      const [c, s] = unitVector(angle);
      expect(c).toBeCloseTo(Math.cos(angle), 9);
      expect(s).toBeCloseTo(Math.sin(angle), 9);
    }
  });
});

describe('links', () => {
  for (const [seed, robots, spreadM, sight, leak] of [
    [1, 60, 4, true, 0], [2, 150, 9, true, 0], [3, 60, 1, true, 0], [4, 80, 6, false, 0.5], [5, 40, 300, true, 0],
    [6, 150, 4, true, 0.2], [7, 60, 2, true, 0.7],
  ] as const) {
    it(`of ${robots} robots over ${spreadM} m are those of all pairs, ${leak} of the antennas raised`, () => {
      const frame = scattered(seed, robots, spreadM, leak);
      const setting = settingOf({ line_of_sight: sight, obstacles });
      const radio = new Radio(setting, frame);
      const { open, blocked } = radio.links();
      expect({ open: pairs(open), blocked: pairs(blocked) }).toEqual(byBruteForce(setting, frame));
      for (const i of [0, 7, robots - 1]) {
        const mine = pairs(open).map((p) => p.split('-').map(Number)).filter((p) => p.includes(i)).map(([a, b]) => (a === i ? b : a)!);
        if (column(frame, 'alive')[i]) expect(radio.neighbours(i)).toEqual(mine.sort((a, b) => a - b));
      }
    });
  }

  it('need less than the range, not as much', () => {
    const radio = new Radio(settingOf({ range_m: 2 }), frameOf({ x_m: [0, 2, 1.999], y_m: [0, 0, 3] }));
    expect(radio.link(0, 1)).toBe('out of range');
    expect(new Radio(settingOf(), frameOf({ x_m: [0, 1.9999], y_m: [0, 0] })).link(0, 1)).toBe('open');
  });

  it('go over a body near a raised antenna, but not over obstacles', () => {
    const x_m = [0, 0.3, 1, 5];
    const over = (raised: number[], obstacles: Obstacle[] = []) =>
      new Radio(settingOf({ obstacles }), frameOf({ x_m, y_m: [0, 0, 0, 0], raised })).link(0, 2);
    expect(over([0, 1, 0, 1])).toBe('blocked');
    expect(over([1, 0, 0, 0])).toBe('open');
    expect(over([0, 0, 1, 0])).toBe('blocked'); // the body is nearer to the other end
    expect(over([1, 0, 1, 0], [{ disc: true, center_m: [0.6, 0], radius_m: 0.05 }])).toBe('blocked');
  });

  it('are cut by bodies, also of the dead', () => {
    const frame = frameOf({ x_m: [0, 0.8, 1.6], y_m: [0, 0.05, 0], alive: [1, 0, 1] });
    expect(new Radio(settingOf(), frame).link(0, 2)).toBe('blocked');
    expect(new Radio(settingOf(), frame).link(0, 1)).toBe('dead');
    expect(new Radio(settingOf({ line_of_sight: false }), frame).link(0, 2)).toBe('open');
  });

  it('survive positions that cannot be', () => {
    const frame = frameOf({ x_m: [0, NaN, 1, 1e300, 9e5, -9e5], y_m: [0, 0, 0, 0, 9e5, 1] });
    expect(pairs(new Radio(settingOf(), frame).links().open)).toEqual(['0-2']);
    expect(new Radio(settingOf(), frameOf({})).links().open.length).toBe(0);
  });

  interface Drawn { name: string; open: number; blocked: number; setting: Setting; x_m: number[]; y_m: number[]; alive: number[] }
  const drawn = JSON.parse(readFileSync(new URL('scene.links.json', import.meta.url), 'utf8')) as Drawn[];
  for (const { name, open, blocked, setting, ...frame } of drawn) {
    it(`are as many as the program draws: ${name}`, () => {
      const links = new Radio(setting, frameOf(frame)).links();
      expect([links.open.length / 2, links.blocked.length / 2]).toEqual([open, blocked]);
    });
  }
});

describe('facts of a tick', () => {
  // 0 root; 1 and 2 hang on it, 3 on 1 (too far), 4 a spare with a parent, 5 and 6 a loop, 7 on a dead one (8).
  const frame = frameOf({
    x_m: [0, 1, -1, 4, 0, 9, 9.5, 20, 21], y_m: [0, 0, 0, 0, 1, 9, 9, 0, 0], role: [3, 1, 2, 2, 0, 1, 1, 1, 1],
    parent: [-1, 0, 0, 1, 0, 6, 5, 8, -1], old_parent: [-1, -1, 0, -1, -1, -1, -1, -1, -1], alive: [1, 1, 1, 1, 1, 1, 1, 1, 0],
  });
  const facts = new Facts(frame, settingOf());

  it('tell edges and why they are broken', () => {
    expect(facts.edges.map((e) => [e.from, e.to, e.old, e.link])).toEqual([
      [1, 0, false, 'open'], [2, 0, false, 'open'], [3, 1, false, 'out of range'], [5, 6, false, 'open'], [6, 5, false, 'open'],
      [7, 8, false, 'dead'], [2, 0, true, 'open'],
    ]);
    expect(facts.broken.map((e) => e.from)).toEqual([3, 7]);
  });
  it('tell how much hangs on a robot, without being caught in a loop', () => {
    expect([...facts.subtreeSizes]).toEqual([4, 2, 1, 1, 1, 1, 1, 1, 2]);
  });
  it('tell the way to the root', () => {
    expect(facts.pathToRoot(3)).toEqual([3, 1, 0]);
    expect(facts.pathToRoot(5)).toEqual([5, 6]);
    expect(facts.pathToRoot(8)).toEqual([8]);
  });
  it('are found once a tick, and anew for another frame or setting', () => {
    const cache = new FactsCache();
    const setting = settingOf();
    const first = cache.of(frame, frame, setting);
    expect(cache.of({ ...frame }, frame, setting)).toBe(first);
    expect(cache.of(frame, { ...frame }, setting)).not.toBe(first);
    expect(cache.of(frame, frame, { ...setting })).not.toBe(first);
    const byTick = cache.of({ ...frame, tick: 5 }, undefined, setting);
    expect(cache.of({ ...frame, tick: 5 }, undefined, setting)).toBe(byTick);
    expect(cache.of({ ...frame, tick: 6 }, undefined, setting)).not.toBe(byTick);
  });
});
