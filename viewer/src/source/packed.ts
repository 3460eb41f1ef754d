// SPDX-License-Identifier: MIT
// A frame in a quarter of its room, to be kept by the thousand: metres and angles in single precision (a
// hundredth of a millimetre at 100 m), small numbers in bytes, counts and robots in 16 bits.
import { type Column, columns, type Frame, type Targets } from '../frame';

type Kind = 'real' | 'small' | 'count' | 'index'; // index: -1 is stored as 0, 0 as 1, ...

const kinds: Record<Column, Kind> = {
  x_m: 'real', y_m: 'real', heading_rad: 'real', want_m: 'real', label_m: 'real', spent: 'real',
  role: 'small', phase: 'small', need: 'small', spare_state: 'small', alive: 'small', connected: 'small',
  raised: 'small',
  epoch: 'count', depth: 'count',
  parent: 'index', old_parent: 'index', grant: 'index', request: 'index', target: 'index',
};

export interface Packed {
  tick: number;
  timeS: number;
  robots: number;
  columns: (Float32Array | Uint8Array | Uint16Array)[];
  targets: Targets;
  bytes: number;
}

function packColumn(kind: Kind, from: Float64Array): Float32Array | Uint8Array | Uint16Array {
  if (kind === 'real') return Float32Array.from(from);
  if (kind === 'small') return Uint8Array.from(from);
  return kind === 'count' ? Uint16Array.from(from) : Uint16Array.from(from, (value) => value + 1);
}

/** Copies from `frame`, whose arrays may be views into memory that changes. */
export function pack(frame: Frame, targets: Targets): Packed {
  const { tick, timeS, robots, data } = frame;
  const packed = columns.map((name, c) => packColumn(kinds[name], data.subarray(c * robots, (c + 1) * robots)));
  const bytes = packed.reduce((sum, values) => sum + values.byteLength + 100, 200);
  return { tick, timeS, robots, columns: packed, targets, bytes };
}

export function unpack({ tick, timeS, robots, columns: packed, targets }: Packed): Frame {
  const data = new Float64Array(columns.length * robots);
  columns.forEach((name, c) => {
    data.set(packed[c], c * robots);
    if (kinds[name] === 'index') for (let i = c * robots; i < (c + 1) * robots; ++i) --data[i];
  });
  const copy = { x: targets.x.slice(), y: targets.y.slice(), worker: targets.worker.slice() };
  return { tick, timeS, robots, data, targets: copy };
}
