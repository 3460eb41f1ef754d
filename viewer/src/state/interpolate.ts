// SPDX-License-Identifier: MIT
// The world between two frames, for a smooth picture; what `between` in record/ is for films. Positions
// go on a line, headings the shorter way, everything else is as in the earlier frame.
import { columns, type Frame, type Targets } from '../frame';

// A robot that went further than this between two frames did not drive there, and is not interpolated.
const leap = 1; // m
const leapSpeed = 5; // m/s, faster than anything here drives

const xAt = columns.indexOf('x_m');
const yAt = columns.indexOf('y_m');
const headingAt = columns.indexOf('heading_rad');

/** In (-pi, pi]. */
export function normalized(angle: number): number {
  const turn = 2 * Math.PI;
  const inside = angle - turn * Math.floor((angle + Math.PI) / turn);
  return inside <= -Math.PI ? inside + turn : inside;
}

/** At `timeS` between the two; at or outside of their times, a copy of one. The memory of `into` is reused. */
export function interpolate(before: Frame, after: Frame | null, timeS: number, into?: Frame): Frame {
  const out = copyOf(before, into);
  if (after === null || !(after.timeS > before.timeS) || timeS <= before.timeS) return out;
  if (timeS >= after.timeS) return copyOf(after, out);
  const share = (timeS - before.timeS) / (after.timeS - before.timeS);
  const most = Math.max(leap, leapSpeed * (after.timeS - before.timeS));
  out.timeS = timeS;
  moveRobots(out, before, after, share, most);
  const common = Math.min(before.targets.x.length, after.targets.x.length);
  movePoints(out.targets.x, out.targets.y, after.targets.x, after.targets.y, common, share, most);
  return out;
}

function moveRobots(out: Frame, before: Frame, after: Frame, share: number, most: number): void {
  const common = Math.min(before.robots, after.robots);
  const values = (frame: Frame, c: number) => frame.data.subarray(c * frame.robots, (c + 1) * frame.robots);
  movePoints(values(out, xAt), values(out, yAt), values(after, xAt), values(after, yAt), common, share, most);
  const heading = values(out, headingAt);
  const next = values(after, headingAt);
  for (let i = 0; i < common; ++i) heading[i] = normalized(heading[i] + share * normalized(next[i] - heading[i]));
}

function movePoints(x: Float64Array, y: Float64Array, toX: Float64Array, toY: Float64Array, count: number,
                    share: number, most: number): void {
  for (let i = 0; i < count; ++i) {
    const dx = toX[i] - x[i];
    const dy = toY[i] - y[i];
    if (dx * dx + dy * dy > most * most) continue;
    x[i] += share * dx;
    y[i] += share * dy;
  }
}

function copyOf(frame: Frame, into?: Frame): Frame {
  const { tick, timeS, robots } = frame;
  return {
    tick, timeS, robots, data: copied(frame.data, into?.data),
    targets: copiedTargets(frame.targets, into?.targets),
  };
}

function copied(from: Float64Array, into?: Float64Array): Float64Array {
  if (into === undefined || into.length !== from.length) return from.slice();
  into.set(from);
  return into;
}

function copiedTargets(from: Targets, into?: Targets): Targets {
  return { x: copied(from.x, into?.x), y: copied(from.y, into?.y), worker: from.worker };
}
