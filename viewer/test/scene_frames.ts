// SPDX-License-Identifier: MIT
// Frames for the tests of src/scene/: only what a test names is set, the rest is a living spare at rest.
import { columns, type Column, type Frame, type Setting } from '../src/frame';

export function frameOf(values: Partial<Record<Column, readonly number[]>>, tick = 0): Frame {
  const robots = values.x_m?.length ?? 0;
  const data = new Float64Array(columns.length * robots);
  const nobody: readonly Column[] = ['parent', 'old_parent', 'grant', 'request', 'target', 'label_m'];
  columns.forEach((name, c) => {
    const given = values[name];
    for (let i = 0; i < robots; ++i) data[c * robots + i] = given ? given[i]! : name === 'alive' ? 1 : nobody.includes(name) ? -1 : 0;
  });
  return { tick, timeS: tick / 10, robots, data, targets: { x: new Float64Array(), y: new Float64Array(), worker: new Int32Array() } };
}

export function settingOf(more: Partial<Setting> = {}): Setting {
  return {
    name: 'test', algorithm: 'convoy', reading: '', seed: 1, tick_s: 0.1, radius_m: 0.07, range_m: 2, line_of_sight: true,
    target_tolerance_m: 0.2, time_limit_s: 100, obstacles: [], ...more,
  };
}

export { dice } from '../bench/swarm';
