// SPDX-License-Identifier: MIT
// Swarms to measure drawing with: made up here, the same on every machine, so that the benchmark needs no file.
import { columns, type Frame, type Setting } from '../src/frame';

/** A generator of numbers in [0, 1), Mulberry32: the pictures must not differ from run to run. */
export function dice(seed: number): () => number {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/** The `robots` points of a hexagonal lattice that are nearest to the origin, each a little off. */
function lattice(robots: number, pitchM: number): [number, number][] {
  const roll = dice(1);
  const reach = Math.ceil(Math.sqrt(robots)) + 2;
  const points: [number, number][] = [];
  for (let row = -reach; row <= reach; ++row) {
    for (let k = -reach; k <= reach; ++k) points.push([(k + (row & 1) / 2) * pitchM, row * pitchM * Math.sqrt(0.75)]);
  }
  points.sort((a, b) => Math.hypot(...a) - Math.hypot(...b));
  return points.slice(0, robots).map(([x, y]) => [x + 0.1 * pitchM * (roll() - 0.5), y + 0.1 * pitchM * (roll() - 0.5)]);
}

/** A tree of a fifth of the robots, the rest spares: everybody's parent is nearer to the root by one ring. */
export function madeUpFrame(robots: number, pitchM: number, tick = 0): Frame {
  const points = lattice(robots, pitchM);
  const roll = dice(2);
  const data = new Float64Array(columns.length * robots).fill(-1);
  const set = (name: (typeof columns)[number], i: number, value: number) => { data[columns.indexOf(name) * robots + i] = value; };
  const inTree = points.map((_, i) => i === 0 || roll() < 0.2);
  points.forEach(([x, y], i) => {
    const outermost = i > 0.9 * robots;
    let parent = -1;
    if (i > 0 && inTree[i]) {
      let best = Infinity;
      for (let j = 0; j < i; ++j) {
        const d = Math.hypot(x - points[j]![0], y - points[j]![1]);
        if (inTree[j] && d < best && Math.hypot(...points[j]!) < Math.hypot(x, y) - pitchM / 2) { best = d; parent = j; }
      }
      if (parent < 0) parent = 0;
    }
    const role = i === 0 ? 3 : inTree[i] ? (outermost ? 2 : 1) : 0;
    set('x_m', i, x); set('y_m', i, y); set('heading_rad', i, 6.28 * roll());
    set('role', i, role); set('phase', i, 3); set('need', i, 0); set('spare_state', i, 0);
    set('alive', i, roll() < 0.02 && i > 0 ? 0 : 1); set('connected', i, 1); set('epoch', i, 1);
    set('label_m', i, Math.hypot(x, y)); set('depth', i, 1); set('parent', i, parent); set('want_m', i, 0);
  });
  const far = points[robots - 1]!;
  return { tick, timeS: tick / 10, robots, data, targets: { x: Float64Array.of(1.2 * far[0], -far[1]), y: Float64Array.of(1.2 * far[1], far[0]), worker: Int32Array.of(-1, -1) } };
}

/** The same frame later: everybody has moved a little on a circle of its own. Writes into `into`. */
export function moved(from: Frame, seconds: number, into: Frame): void {
  const n = from.robots;
  into.data.set(from.data);
  for (let i = 0; i < n; ++i) {
    into.data[i] = from.data[i]! + 0.03 * Math.cos(seconds * 3 + i);
    into.data[n + i] = from.data[n + i]! + 0.03 * Math.sin(seconds * 3 + i);
  }
  into.timeS = seconds;
  into.tick = Math.floor(10 * seconds);
}

export function madeUpSetting(lineOfSight: boolean): Setting {
  return {
    name: 'made up', algorithm: 'convoy', reading: '', seed: 1, tick_s: 0.1, radius_m: 0.0704, range_m: 2, line_of_sight: lineOfSight,
    target_tolerance_m: 0.2, time_limit_s: 100, obstacles: [],
  };
}

export interface Layout { name: string; robots: number; pitchM: number; goalFps: number }
export const layouts: Layout[] = [
  { name: '94 robots, all hear all', robots: 94, pitchM: 0.16, goalFps: 60 },
  { name: '1,000 robots, 6-7 neighbours', robots: 1000, pitchM: 1.45, goalFps: 30 },
  { name: '1,000 robots, 20 neighbours', robots: 1000, pitchM: 0.8, goalFps: 30 },
  { name: '1,000 robots, start lattice', robots: 1000, pitchM: 0.32, goalFps: 30 },
];
