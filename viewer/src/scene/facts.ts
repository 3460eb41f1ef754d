// SPDX-License-Identifier: MIT
// What follows from a recorded tick and does not change until the next one: links, whether edges are whole, how much
// of the tree is below each robot. Computed once a tick, the expensive parts only when needed.
import { column, type Frame, type Setting } from '../frame';
import { Radio, type Link, type Links } from './links';

export class Facts {
  readonly role: Float64Array;
  readonly alive: Float64Array;
  readonly parent: Float64Array;
  readonly oldParent: Float64Array;
  private radioMade: Radio | null = null;
  private linksMade: Links | null = null;
  private sizesMade: Int32Array | null = null;
  private edgesMade: Edge[] | null = null;
  private brokenMade: Edge[] | null = null;

  constructor(readonly frame: Frame, readonly setting: Setting) {
    this.role = column(frame, 'role');
    this.alive = column(frame, 'alive');
    this.parent = column(frame, 'parent');
    this.oldParent = column(frame, 'old_parent');
  }

  get radio(): Radio { return (this.radioMade ??= new Radio(this.setting, this.frame)); }
  get links(): Links { return (this.linksMade ??= this.radio.links()); }
  get edges(): Edge[] {
    return (this.edgesMade ??= [...this.edgesTo(this.parent, false), ...this.edgesTo(this.oldParent, true)]);
  }
  /** Edges that do not hold; one that is in both trees only once. */
  get broken(): Edge[] {
    const twice = (e: Edge) => e.old && this.parent[e.from] === e.to;
    return (this.brokenMade ??= this.edges.filter((e) => e.link !== 'open' && !twice(e)));
  }
  /** Robots that have this one on their way to the root, itself included. */
  get subtreeSizes(): Int32Array { return (this.sizesMade ??= subtreeSizes(this)); }

  /** Is there an edge from i to its parent? Spares have none, whatever their `parent` is. */
  hasEdge(i: number, to: Float64Array): boolean {
    const j = to[i]!;
    return this.alive[i] === 1 && this.role[i] !== 0 && j >= 0 && j < this.frame.robots && j !== i;
  }

  /** The robots from i to the root along parents, i first; ends early at a robot without a parent. */
  pathToRoot(i: number): number[] {
    const path: number[] = [];
    const been = new Set<number>();
    for (let at = i; at >= 0 && at < this.frame.robots && !been.has(at); at = this.parent[at]!) {
      path.push(at);
      been.add(at);
      if (this.role[at] === 3) break;
    }
    return path;
  }

  private edgesTo(to: Float64Array, old: boolean): Edge[] {
    const edges: Edge[] = [];
    for (let i = 0; i < this.frame.robots; ++i) {
      if (this.hasEdge(i, to)) edges.push({ from: i, to: to[i]!, old, link: this.radio.link(i, to[i]!) });
    }
    return edges;
  }
}

export interface Edge { from: number; to: number; old: boolean; link: Link }

function subtreeSizes(facts: Facts): Int32Array {
  const n = facts.frame.robots;
  const sizes = new Int32Array(n).fill(1);
  const waiting = new Int32Array(n); // children that are not yet counted
  for (let i = 0; i < n; ++i) if (facts.hasEdge(i, facts.parent)) ++waiting[facts.parent[i]!]!;
  const ready: number[] = [];
  for (let i = 0; i < n; ++i) if (waiting[i] === 0) ready.push(i);
  // From the leaves inwards. Robots in a loop of parents are never ready and keep 1.
  for (let i = ready.pop(); i !== undefined; i = ready.pop()) {
    if (!facts.hasEdge(i, facts.parent)) continue;
    const parent = facts.parent[i]!;
    sizes[parent]! += sizes[i]!;
    if (--waiting[parent]! === 0) ready.push(parent);
  }
  return sizes;
}

/** Keeps the facts of the tick that was asked for last. */
export class FactsCache {
  private last: Facts | null = null;

  of(frame: Frame, recorded: Frame | undefined, setting: Setting): Facts {
    const last = this.last;
    const same = last !== null && last.setting === setting && last.frame.robots === frame.robots &&
      (recorded ? last.frame === recorded : last.frame.tick === frame.tick);
    // Without a recorded frame the caller may write into the one it gave, so the facts keep a copy.
    if (!same) this.last = new Facts(recorded ?? { ...frame, data: frame.data.slice() }, setting);
    return this.last!;
  }
}
