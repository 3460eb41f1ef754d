// SPDX-License-Identifier: MIT
// The page's state: one plain object, and its listeners.

import { defaultSwitches, type Item, type Switches } from '../scene/view';

export type ThemeChoice = 'light' | 'dark' | 'auto';

export interface State {
  selection: Item | null;
  followed: number | null; // robot
  switches: Switches;
  theme: ThemeChoice;
  toured: boolean; // the tour has been seen or left
}

export const initialState: Readonly<State> = { selection: null, followed: null, switches: defaultSwitches, theme: 'auto', toured: false };

// The visitor's lasting choices; the rest belongs to the run being shown.
const kept = ['switches', 'theme', 'toured'] as const;
const storageKey = 'banyan.viewer';

/** The part of localStorage that is used. */
export interface Storage {
  getItem(key: string): string | null;
  setItem(key: string, value: string): void;
}

type Listener = (state: Readonly<State>) => void;

export class Store {
  private current: State;
  private readonly listeners = new Set<Listener>();

  /** `storage`: null where there is none. */
  constructor(private readonly storage: Storage | null = browserStorage()) {
    this.current = { ...initialState, ...load(storage) };
  }

  get state(): Readonly<State> {
    return this.current;
  }

  /** Tells the listeners once, if anything really changed. */
  set(change: Partial<State>): void {
    const keys = (Object.keys(change) as (keyof State)[]).filter((key) => !Object.is(change[key], this.current[key]));
    if (keys.length === 0) return;
    this.current = { ...this.current, ...change };
    if (kept.some((key) => keys.includes(key))) this.save();
    for (const listener of [...this.listeners]) listener(this.current);
  }

  toggle(name: keyof Switches): void {
    const { switches } = this.current;
    this.set({ switches: { ...switches, [name]: !switches[name] } });
  }

  /** Called after each change. Returns how to end that. */
  subscribe(listener: Listener): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private save(): void {
    const { switches, theme, toured } = this.current;
    try {
      this.storage?.setItem(storageKey, JSON.stringify({ switches, theme, toured }));
    } catch {
      // Full or forbidden: then it is not remembered.
    }
  }
}

/** What was saved, as far as it still makes sense. */
function load(storage: Storage | null): Partial<State> {
  try {
    const saved = JSON.parse(storage?.getItem(storageKey) ?? '{}') as Record<string, unknown> | null;
    const theme = (['light', 'dark', 'auto'] as const).find((name) => name === saved?.theme) ?? initialState.theme;
    const given = (saved?.switches ?? {}) as Record<string, unknown>;
    const sound = Object.keys(defaultSwitches).filter((name) => typeof given[name] === 'boolean');
    return { theme, toured: saved?.toured === true, switches: { ...defaultSwitches, ...Object.fromEntries(sound.map((name) => [name, given[name]])) } };
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
