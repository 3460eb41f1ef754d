// SPDX-License-Identifier: MIT
// What one robot broadcast, from a /banyan/messages message: arrays by field, a number per robot. What the
// frame of the same tick has already is not repeated there, so it is taken from that.
import { type Column, column, type Frame } from '../frame';
import { parseObject } from './json';
import type { MessageFields } from './protocol';

// The columns of a frame that are fields of the message (docs/protocol.md, section 1). A message's own `grant` comes
// first: without a parent it is the robot's hold.
const shared: Column[] = ['role', 'phase', 'need', 'epoch', 'label_m', 'depth', 'parent', 'old_parent', 'grant', 'request'];

/** Null if it is not about that robot. Throws Malformed. */
export function messageOf(text: string, robot: number, frame: Frame | null): MessageFields | null {
  const object = parseObject(text);
  const fields: MessageFields = {};
  let found = false;
  for (const [name, values] of Object.entries(object)) {
    const value = Array.isArray(values) ? values[robot] : undefined;
    if (typeof value !== 'number' && typeof value !== 'string' && typeof value !== 'boolean') continue;
    Object.defineProperty(fields, name, { value, enumerable: true, writable: true, configurable: true });
    found = true;
  }
  if (!found) return null;
  const same = frame !== null && frame.tick === object.tick && robot < frame.robots ? frame : null;
  const known: MessageFields = { id: robot };
  if (same !== null) for (const name of shared) known[name] = column(same, name)[robot];
  return { ...known, ...fields };
}
