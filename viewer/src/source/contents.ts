// SPDX-License-Identifier: MIT
// What is known of a file before its messages are read.
import type { Channel } from './records';

/** A chunk, or messages that stand outside of any. */
export interface Stretch {
  offset: number; // bytes
  length: number;
  chunk: boolean;
  start: number; // ns
  end: number;
  /** What is in it; empty: unknown. */
  channels: Set<number>;
}

export interface Mcap {
  indexed: boolean;
  channels: Map<number, Channel>;
  metadata: Map<string, Map<string, string>>;
  stretches: Stretch[];
}

/** By start. */
export function inOrder(stretches: readonly Stretch[]): Stretch[] {
  return [...stretches].sort((a, b) => a.start - b.start || a.offset - b.offset);
}
