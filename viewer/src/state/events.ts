// SPDX-License-Identifier: MIT
// Which events are worth a jump, and the jumping.
import type { RunEvent } from '../frame';

/** What [ and ] stop at. */
export const notableKinds: ReadonlySet<string> = new Set([
  'inserted', 'recruited', 'root', 'edges_broken', 'death', 'join', 'split', 'complete',
  'set_loss', 'blackout', 'line_of_sight', 'target_added', 'target_removed', 'obstacle_added', 'obstacle_removed',
]);

const sameMoment = 1e-3; // s: shorter than any tick

function isNotable(event: RunEvent): boolean {
  return notableKinds.has(event.kind);
}

/** The nearest notable event after (1) or before (-1) `timeS`; null: there is none. `events` in order of time;
 *  several at one moment are one stop. */
export function eventAfter(events: readonly RunEvent[], timeS: number, direction: 1 | -1): RunEvent | null {
  const split = firstLaterThan(events, timeS + direction * sameMoment);
  for (let i = direction > 0 ? split : split - 1; i >= 0 && i < events.length; i += direction) {
    if (isNotable(events[i])) return events[i];
  }
  return null;
}

function firstLaterThan(events: readonly RunEvent[], timeS: number): number {
  let low = 0;
  for (let high = events.length; low < high; ) {
    const middle = (low + high) >> 1;
    if (events[middle].time_s <= timeS) low = middle + 1;
    else high = middle;
  }
  return low;
}
