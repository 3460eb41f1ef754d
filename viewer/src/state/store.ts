// SPDX-License-Identifier: MIT
// The page's state: one plain object, and who wants to know of what in it.

export type Theme = 'light' | 'dark' | 'auto';
/** One source, or two side by side with one clock. */
export type Stages = 1 | 2;
export type View = 'fit' | 'free' | 'follow';

export interface State {
  stages: Stages;
  /** The one that answers to clicks, panels and live controls: 0 or 1. */
  activeStage: number;
  view: View;
  selected: number | null; // robots by index
  hovered: number | null;
  followed: number | null;
  links: boolean;
  blockedLinks: boolean;
  oldTree: boolean;
  trails: boolean;
  labels: boolean;
  ids: boolean;
  theme: Theme;
  speed: number;
}

export const initialState: Readonly<State> = {
  stages: 1, activeStage: 0, view: 'fit', selected: null, hovered: null, followed: null, links: true,
  blockedLinks: false, oldTree: true, trails: true, labels: true, ids: false, theme: 'auto', speed: 1,
};

// What a visitor chose for good; the rest belongs to what is looked at just now.
const checks: { [Key in keyof State]?: (value: unknown) => boolean } = {
  links: isFlag, blockedLinks: isFlag, oldTree: isFlag, trails: isFlag, labels: isFlag, ids: isFlag,
  theme: (value) => value === 'light' || value === 'dark' || value === 'auto',
};
const storageKey = 'banyan.viewer';

function isFlag(value: unknown): boolean {
  return typeof value === 'boolean';
}

/** The part of localStorage that is used. */
export interface Storage {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

type Listener = (state: Readonly<State>, changed: ReadonlySet<keyof State>) => void;

export class Store {
  private current: State;
  private readonly listeners = new Map<Listener, ReadonlySet<keyof State> | null>();

  /** `storage`: null where there is none. */
  constructor(private readonly storage: Storage | null = browserStorage()) {
    this.current = { ...initialState, ...load(storage) };
  }

  get state(): Readonly<State> {
    return this.current;
  }

  /** Tells the listeners once, of all that really changed. */
  set(change: Partial<State>): void {
    const keys = (Object.keys(change) as (keyof State)[]).filter((key) => !Object.is(change[key], this.current[key]));
    if (keys.length === 0) return;
    this.current = { ...this.current, ...change };
    if (keys.some((key) => key in checks)) this.save();
    const changed = new Set(keys);
    for (const [listener, wanted] of [...this.listeners]) {
      if (wanted === null || keys.some((key) => wanted.has(key))) listener(this.current, changed);
    }
  }

  toggle(key: 'links' | 'blockedLinks' | 'oldTree' | 'trails' | 'labels' | 'ids'): void {
    this.set({ [key]: !this.current[key] });
  }

  /** Called after each change of one of `keys`, without them of anything. Returns how to end that. */
  subscribe(listener: Listener, keys?: readonly (keyof State)[]): () => void {
    this.listeners.set(listener, keys === undefined ? null : new Set(keys));
    return () => this.listeners.delete(listener);
  }

  private save(): void {
    const kept = Object.fromEntries(Object.keys(checks).map((key) => [key, this.current[key as keyof State]]));
    try {
      this.storage?.setItem(storageKey, JSON.stringify(kept));
    } catch {
      // Full or forbidden: then it is not remembered.
    }
  }
}

/** What was saved, as far as it still makes sense. */
function load(storage: Storage | null): Partial<State> {
  try {
    const saved: unknown = JSON.parse(storage?.getItem(storageKey) ?? '{}');
    if (typeof saved !== 'object' || saved === null) return {};
    const sound = Object.entries(saved).filter(([key, value]) => Object.hasOwn(checks, key) && checks[key as keyof State]?.(value));
    return Object.fromEntries(sound) as Partial<State>;
  } catch {
    return {};
  }
}

function browserStorage(): Storage | null {
  try {
    return typeof localStorage === 'undefined' ? null : localStorage;
  } catch {
    return null; // forbidden
  }
}
