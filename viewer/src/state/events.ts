// SPDX-License-Identifier: MIT
// Which events are worth a jump, and the jumping.
import type { RunEvent } from '../frame';

/** What [ and ] stop at. `recruited` is what older recordings call an insertion too. */
export const notableKinds: ReadonlySet<string> = new Set([
  'inserted', 'recruited', 'root', 'edges_broken', 'death', 'split', 'complete',
]);

const sameMoment = 1e-3; // s: shorter than any tick

export function isNotable(event: RunEvent): boolean {
  return notableKinds.has(event.kind);
}

/** The nearest moment after (1) or before (-1) `timeS` with a notable event; null: there is none. `events`
 *  in order of time; several at one moment are one stop. */
export function jumpTime(events: readonly RunEvent[], timeS: number, direction: 1 | -1): number | null {
  return eventAfter(events, timeS, direction)?.time_s ?? null;
}

/** The same, as the event. */
export function eventAfter(events: readonly RunEvent[], timeS: number, direction: 1 | -1): RunEvent | null {
  const split = firstLaterThan(events, timeS + direction * sameMoment);
  for (let i = direction > 0 ? split : split - 1; i >= 0 && i < events.length; i += direction) {
    if (isNotable(events[i])) return events[i];
  }
  return null;
}

/** The last notable events at or before `timeS`, latest first. */
export function eventsUntil(events: readonly RunEvent[], timeS: number, most: number): RunEvent[] {
  const found: RunEvent[] = [];
  for (let i = firstLaterThan(events, timeS + sameMoment) - 1; i >= 0 && found.length < most; --i) {
    if (isNotable(events[i])) found.push(events[i]);
  }
  return found;
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
