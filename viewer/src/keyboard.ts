// SPDX-License-Identifier: MIT
// Every key of the page, once. Keys belong to the page unless something is being typed or chosen.

export interface KeyActions {
  toggle(): void;
  step(ticks: number): void;
  toStart(): void;
  toEnd(): void;
  jump(direction: 1 | -1): void;
  speed(direction: 1 | -1): void;
  pan(dx: number, dy: number): void; // share of the picture
  zoom(factor: number): void;
  fit(): void;
  selectNumber(robot: number): void;
  selectNext(direction: 1 | -1): void;
  follow(): void;
  kill(): void;
  switchOn(name: 'links' | 'blocked' | 'oldTree' | 'trails' | 'ids'): void;
  tool(name: 'add_target' | 'add_obstacle' | 'kill_area'): void;
  grab(): void; // the selected target or obstacle, to be moved by keys
  /** Targets and obstacles. */
  selectNextThing(direction: 1 | -1): void;
  undo(): void;
  redo(): void;
  loop(): void;
  /** Whether the key moves or takes the place that is being chosen. */
  place(key: string, shift: boolean): boolean;
  theme(): void;
  release(): void; // Escape
  help(): void;
}

const zoomStep = 1.25;
const panStep = 0.12;
const movesSlider = /^(Arrow|Home|End|Page)/;

/** Whether the key is meant for a control and not for the page. */
function isTyping(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement && target.type === 'range') return !isTimeline(target) && movesSlider.test(key);
  if (target instanceof HTMLInputElement) return target.type !== 'checkbox';
  return target.isContentEditable || target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

/** Space and Enter press the control that has the focus. `clicked`: it got the focus by the pointer; then the next
 *  space is not meant for it. */
function presses(target: EventTarget | null, key: string, clicked: boolean): boolean {
  if (key !== ' ' && key !== 'Enter' || !(target instanceof HTMLElement)) return false;
  if (key === ' ' && clicked && target.closest('button') !== null) return false;
  return target.closest('button, summary, a, input[type=checkbox]') !== null;
}

export class Keyboard {
  private digits = '';
  private clicked = false; // what has the focus has it from the pointer
  private taken = ''; // the key that is held down, if the page has taken it

  constructor(private readonly actions: KeyActions) {
    document.addEventListener('keydown', (event) => this.onKey(event));
    // Some browsers press a button only when space is let go.
    document.addEventListener('keyup', (event) => { if (event.key === ' ' && this.taken === ' ') event.preventDefault(); });
    document.addEventListener('focusin', ({ target }) => { this.clicked = target instanceof HTMLElement && !target.matches(':focus-visible'); });
    document.addEventListener('pointerdown', () => { this.digits = ''; });
  }

  private onKey(event: KeyboardEvent): void {
    this.taken = '';
    const { undo, redo } = this.actions;
    const again = event.ctrlKey || event.metaKey ? { z: event.shiftKey ? redo : undo, y: redo }[event.key.toLowerCase()] : undefined;
    if (again !== undefined && !isTyping(event.target, event.key)) {
      event.preventDefault();
      return again();
    }
    if (event.ctrlKey || event.metaKey || event.defaultPrevented && !isTimeline(event.target)) return;
    if (document.querySelector('dialog[open]') !== null) return;
    if (event.key === 'Escape' && event.target instanceof HTMLElement) event.target.blur();
    if (event.key !== 'Escape' && isTyping(event.target, event.key)) return;
    if (!event.altKey && this.actions.place(event.key, event.shiftKey)) return event.preventDefault();
    if (presses(event.target, event.key, this.clicked) && this.digits === '') return;
    const action = this.digit(event.key) ?? this.find(event);
    if (action === null) return;
    event.preventDefault();
    this.taken = event.key;
    action();
  }

  /** A number and Enter select a robot. A 0 alone shows all of the picture, and may be the start of a number, too. */
  private digit(key: string): (() => void) | null {
    if (/^[0-9]$/.test(key)) {
      const first = this.digits === '';
      this.digits = (this.digits + key).slice(-6);
      return first && key === '0' ? this.actions.fit : () => {};
    }
    const digits = this.digits;
    this.digits = '';
    return key === 'Enter' && digits !== '' ? () => this.actions.selectNumber(Number(digits)) : null;
  }

  private find(event: KeyboardEvent): (() => void) | null {
    const a = this.actions;
    const ticks = event.shiftKey ? 10 : 1;
    const alt: Record<string, () => void> = {
      ArrowLeft: () => a.pan(-panStep, 0), ArrowRight: () => a.pan(panStep, 0),
      ArrowUp: () => a.pan(0, -panStep), ArrowDown: () => a.pan(0, panStep),
    };
    if (event.altKey) return alt[event.key] ?? null;
    const plain: Record<string, () => void> = {
      ' ': a.toggle, ArrowLeft: () => a.step(-ticks), ArrowRight: () => a.step(ticks), Home: a.toStart, End: a.toEnd,
      '[': () => a.jump(-1), ']': () => a.jump(1), '-': () => a.speed(-1), '+': () => a.speed(1), '=': () => a.speed(1),
      PageUp: () => a.zoom(zoomStep), PageDown: () => a.zoom(1 / zoomStep),
      n: () => (event.shiftKey ? a.selectNextThing(1) : a.selectNext(1)),
      p: () => (event.shiftKey ? a.selectNextThing(-1) : a.selectNext(-1)),
      f: a.follow, g: a.grab, u: a.undo, y: a.redo, a: a.loop, Delete: a.kill,
      l: () => a.switchOn('links'), b: () => a.switchOn('blocked'), o: () => a.switchOn('oldTree'),
      r: () => a.switchOn('trails'), i: () => a.switchOn('ids'),
      t: () => a.tool('add_target'), x: () => a.tool('add_obstacle'), k: () => a.tool('kill_area'), m: a.theme, Escape: a.release, '?': a.help,
    };
    return plain[event.key.length === 1 ? event.key.toLowerCase() : event.key] ?? null;
  }
}

function isTimeline(target: EventTarget | null): boolean {
  return target instanceof HTMLInputElement && target.closest('.timeline') !== null;
}
