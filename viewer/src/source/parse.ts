// SPDX-License-Identifier: MIT
// Messages of a recording as values of the page (docs/file-formats.md), in the ranges that Banyan's own
// reader accepts (record/src/frame_json.cpp). What is out of them throws Malformed.
import { type Column, columns, type Frame, givenUp, type RunEvent, type Targets } from '../frame';
import { arrayAt, fail, type JsonObject, member, numberAt, numberIn, parseObject, textAt, wholeAt } from './json';

export const far = 1e12; // m: beyond, a position is damage
const longest = 9e9; // s
const mostTicks = 2 ** 53;
export const mostRobots = 65535; // the page keeps their ids in 16 bits (packed.ts)
const mostId = 65535;

interface Range {
  least: number;
  most: number;
  whole: boolean;
  /** Index of a robot; -1 for one that does not exist. */
  robot?: boolean;
}
const real = (least: number, most: number): Range => ({ least, most, whole: false });
const whole = (least: number, most: number): Range => ({ least, most, whole: true });
const robot: Range = { least: -1, most: mostId, whole: true, robot: true };

const ranges: Record<Column, Range> = {
  x_m: real(-far, far), y_m: real(-far, far), heading_rad: real(-7, 7),
  role: whole(0, 3), phase: whole(0, 4), need: whole(0, 2), spare_state: whole(0, 2),
  alive: whole(0, 1), connected: whole(0, 1), epoch: whole(0, 65535), label_m: real(-1, far),
  depth: whole(0, 65535), parent: robot, old_parent: robot, grant: robot, request: robot,
  want_m: real(0, far), target: whole(-1, mostId), raised: whole(0, 1), spent: real(0, 1),
};

export const noTargets: Targets = { x: new Float64Array(0), y: new Float64Array(0), worker: new Int32Array(0) };

/** Targets are a channel of their own; the frame gets them later. */
export function parseFrame(text: string): Frame {
  const object = parseObject(text);
  const robots = arrayAt(object, 'x_m').length;
  if (robots > mostRobots) fail('x_m', `has ${robots} robots; the page shows at most ${mostRobots}`);
  const data = new Float64Array(columns.length * robots);
  columns.forEach((name, c) => fill(data.subarray(c * robots, (c + 1) * robots), object, name));
  return {
    tick: wholeAt(object, 'tick', 0, mostTicks), timeS: numberAt(object, 'time_s', 0, longest), robots, data,
    targets: noTargets,
  };
}

// Left out where it is 0 for all robots.
const optional: readonly Column[] = ['raised', 'spent'];

function fill(out: Float64Array, object: JsonObject, name: Column): void {
  if (optional.includes(name) && member(object, name) === undefined) return;
  const values = arrayAt(object, name, out.length);
  const { least, most, whole: integer, robot: reference } = ranges[name];
  for (let i = 0; i < out.length; ++i) {
    const value = numberIn(values[i], name, least, most);
    if (integer && !Number.isInteger(value)) fail(name, 'holds a number that is not whole');
    out[i] = reference && value >= out.length ? -1 : value;
  }
}

const tickAtStart = /^\s*\{\s*"tick"\s*:\s*(\d{1,15})\s*,/;

/** The tick of a frame from its first few characters; null if it is not written there. */
export function peekTick(head: string): number | null {
  const found = tickAtStart.exec(head);
  return found === null ? null : Number(found[1]);
}

export function parseTargets(text: string): Targets {
  const object = parseObject(text);
  const x = arrayAt(object, 'x_m');
  if (x.length > mostRobots) fail('x_m', `has ${x.length} targets; the page shows at most ${mostRobots}`);
  const y = arrayAt(object, 'y_m', x.length);
  const worker = arrayAt(object, 'worker', x.length);
  const active = arrayAt(object, 'active', x.length);
  return {
    x: Float64Array.from(x, (v) => numberIn(v, 'x_m', -far, far)),
    y: Float64Array.from(y, (v) => numberIn(v, 'y_m', -far, far)),
    worker: Int32Array.from(worker, (v, k) => {
      const first = numberIn(v, 'worker', -1, mostId);
      return numberIn(active[k], 'active', 0, 1) !== 0 ? first : givenUp;
    }),
  };
}

export function parseEvent(text: string): RunEvent {
  const object = parseObject(text);
  return {
    tick: wholeAt(object, 'tick', 0, mostTicks), time_s: numberAt(object, 'time_s', 0, longest),
    kind: textAt(object, 'kind'), robot: wholeAt(object, 'robot', -1, 4294967294),
    target: wholeAt(object, 'target', -1, 4294967294), text: textAt(object, 'text'),
  };
}
