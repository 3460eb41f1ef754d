// SPDX-License-Identifier: MIT
// A value that notifies its listeners when it changes.

export type Listener<T> = (value: T) => void;
export type Unsubscribe = () => void;

export class Observable<T> {
  private readonly listeners = new Set<Listener<T>>();
  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }
  /** Tells the listeners also if it is the same object, changed. */
  set(value: T): void {
    this.current = value;
    for (const listener of [...this.listeners]) listener(value);
  }
  /** Called at every change from now on. */
  subscribe(listener: Listener<T>): Unsubscribe {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }
}
