// SPDX-License-Identifier: MIT
// Which targets are held: a living worker that serves one is within the tolerance (docs/model.md, events).
import { column, givenUp, type Frame } from '../frame';

const worker = 2; // in the column `role`

/** One entry per target, 1: held. One pass over the robots. */
export function targetsHeld(frame: Frame, toleranceM: number): Uint8Array {
  const { targets, robots } = frame;
  const held = new Uint8Array(targets.x.length);
  const x = column(frame, 'x_m'), y = column(frame, 'y_m'), served = column(frame, 'target');
  const role = column(frame, 'role'), alive = column(frame, 'alive');
  for (let i = 0; i < robots; ++i) {
    const k = served[i]!;
    if (role[i] !== worker || alive[i] === 0 || k < 0 || k >= held.length) continue;
    if (Math.hypot(x[i]! - targets.x[k]!, y[i]! - targets.y[k]!) < toleranceM) held[k] = 1;
  }
  return held;
}

/** Of those that are not given up. */
export function heldTargets(frame: Frame, toleranceM: number): { held: number; wanted: number } {
  const held = targetsHeld(frame, toleranceM);
  const isWanted = (k: number) => frame.targets.worker[k] !== givenUp;
  const wanted = [...held.keys()].filter(isWanted);
  return { held: wanted.filter((k) => held[k] === 1).length, wanted: wanted.length };
}
