// SPDX-License-Identifier: MIT
// How an event looks on the timeline and in the list: a colour of the page's and how tall its mark is.
// Told apart by height, too, since not every visitor can tell the colours apart.

export interface Mark {
  color: string; // a CSS variable
  height: number; // share of the timeline's
  sign: string;
}

const marks: Record<string, Mark> = {
  death: { color: '--bad', height: 1, sign: '✕' },
  split: { color: '--bad', height: 1, sign: '⚡' },
  edges_broken: { color: '--bad', height: 0.7, sign: '⌁' },
  join: { color: '--good', height: 1, sign: '⊞' },
  joined: { color: '--good', height: 0.7, sign: '◯' },
  edges_whole: { color: '--good', height: 0.4, sign: '○' },
  root: { color: '--root', height: 1, sign: '◆' },
  inserted: { color: '--connector', height: 0.7, sign: '↳' },
  worker: { color: '--worker', height: 0.7, sign: '⇄' },
  recruited: { color: '--connector', height: 0.5, sign: '+' },
  released: { color: '--quiet', height: 0.3, sign: '−' },
  arrival: { color: '--worker', height: 0.7, sign: '⚑' },
  complete: { color: '--worker', height: 1, sign: '★' },
  target_added: { color: '--target', height: 1, sign: '⊕' },
  target_removed: { color: '--target', height: 1, sign: '⊖' },
  set_loss: { color: '--quiet', height: 0.8, sign: '≋' },
  blackout: { color: '--bad', height: 1, sign: '◼' },
  target_moved: { color: '--target', height: 0.6, sign: '⊙' },
  obstacle_moved: { color: '--quiet', height: 0.6, sign: '▣' },
  obstacle_added: { color: '--quiet', height: 0.6, sign: '▣' },
  obstacle_removed: { color: '--quiet', height: 0.6, sign: '▢' },
  line_of_sight: { color: '--quiet', height: 0.6, sign: '◐' },
  interrupted: { color: '--quiet', height: 1, sign: '■' },
};

/** null: too frequent and too small to be marked (phases). */
export function eventMark(kind: string): Mark | null {
  return marks[kind] ?? null;
}
