// SPDX-License-Identifier: MIT
// The setting of a run from its JSON. What is missing or damaged in it gets Banyan's default: a picture
// with the wrong radius is better than none, if it says so.
import { Cells } from '../cells';
import type { Obstacle, Point, Setting } from '../frame';
import { arrayAt, fail, isObject, type Json, type JsonObject, Malformed, member, numberAt, numberIn, parseObject } from './json';
import { far } from './parse';

export function defaultSetting(): Setting {
  return {
    name: '', algorithm: '', reading: '', seed: 0, tick_s: 0.1, radius_m: 0.07, range_m: 2, line_of_sight: false,
    sight_leak: 0, dead_bodies: true, target_tolerance_m: 0.2, time_limit_s: 0, obstacles: [],
  };
}

const mostObstacles = 100000;

// Numbers that must be in a range; a tick below a microsecond would make every clock stand still.
const numbers = {
  seed: [0, 2 ** 64], tick_s: [1e-6, 3600], radius_m: [0, far], range_m: [0, far], sight_leak: [0, 1],
  target_tolerance_m: [0, far], time_limit_s: [0, far],
} as const;
const texts = ['name', 'algorithm', 'reading'] as const;

/** `warn` is told what was replaced. Throws Malformed if it is no JSON object at all. */
export function parseSetting(text: string, warn: (text: string) => void): Setting {
  const object = parseObject(text);
  const setting = defaultSetting();
  const attempt = (take: () => void) => {
    try {
      take();
    } catch (error) {
      if (!(error instanceof Malformed)) throw error;
      warn(`the setting's ${error.message}; a default is assumed`);
    }
  };
  for (const name of Object.keys(numbers) as (keyof typeof numbers)[]) {
    attempt(() => { setting[name] = numberAt(object, name, numbers[name][0], numbers[name][1]); });
  }
  for (const name of texts) {
    attempt(() => {
      const value = member(object, name);
      if (typeof value !== 'string') fail(name, 'is not a text');
      setting[name] = value;
    });
  }
  attempt(() => { setting.line_of_sight = flagOf(object, 'line_of_sight'); });
  attempt(() => { setting.dead_bodies = flagOf(object, 'dead_bodies'); });
  attempt(() => { setting.obstacles = arrayAt(object, 'obstacles').slice(0, mostObstacles).map(parseObstacle); });
  return setting;
}

function flagOf(object: JsonObject, name: string): boolean {
  const value = member(object, name);
  if (typeof value !== 'boolean') fail(name, 'is not true or false');
  return value;
}

function parseObstacle(value: Json): Obstacle {
  if (!isObject(value)) fail('obstacles', 'holds something that is no object');
  if (member(value, 'disc') !== undefined) {
    return { disc: true, center_m: pointAt(value, 'center_m'), radius_m: numberAt(value, 'radius_m', 0, far) };
  }
  if (member(value, 'box') !== undefined) {
    return {
      box: true, center_m: pointAt(value, 'center_m'), size_m: pointAt(value, 'size_m'),
      angle_rad: numberAt(value, 'angle_rad', -far, far),
    };
  }
  if (member(value, 'wall') !== undefined) {
    return { wall: true, from_m: pointAt(value, 'from_m'), to_m: pointAt(value, 'to_m') };
  }
  if (member(value, 'map') !== undefined) {
    const text = member(value, 'cells');
    const cells = typeof text === 'string' ? Cells.parse(text) : null;
    if (!cells) fail('obstacles', 'holds a map whose cells are none');
    return {
      map: true, origin_m: pointAt(value, 'origin_m'), resolution_m: numberAt(value, 'resolution_m', 1e-9, far),
      angle_rad: numberAt(value, 'angle_rad', -far, far), cells,
    };
  }
  return fail('obstacles', 'holds something unknown');
}

function pointAt(object: JsonObject, name: string): Point {
  const values = arrayAt(object, name, 2);
  return [numberIn(values[0], name, -far, far), numberIn(values[1], name, -far, far)];
}
