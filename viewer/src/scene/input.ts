// SPDX-License-Identifier: MIT
// From pointers to intentions: mouse, pen and touch. Knows nothing of the run; what is under the pointer and what an
// intention leads to is the page's. Positions are CSS pixels from the element's upper left corner.
import type { Spot } from './camera';
import type { Item } from './view';

export interface Intentions {
  /** What is at this place? `touch`: a finger, which is broad. */
  itemAt(atPx: Spot, touch: boolean): Item | null;
  /** What does a drag from this place take along? Not always what a click picks: a target lies under its worker. */
  gripAt(atPx: Spot, touch: boolean): Item | null;

  pan(dxPx: number, dyPx: number): void;
  /** `factor` > 1: nearer. */
  zoom(factor: number, atPx: Spot): void;
  /** null: the pointer is over the ground or has left. Only mouse and pen hover. */
  hover(item: Item | null, atPx: Spot | null): void;
  /** Clicked or tapped without moving; null: the ground. */
  pick(item: Item | null, atPx: Spot): void;
  dragStart(item: Item, atPx: Spot): void;
  dragMove(item: Item, atPx: Spot): void;
  /** `dropped` false: it was called off (Escape, a second finger) and nothing should happen. */
  dragEnd(item: Item, atPx: Spot, dropped: boolean): void;
  /** A rectangle is being drawn, corner to corner; with shift, or in mode 'area'. */
  areaMove(fromPx: Spot, toPx: Spot): void;
  areaEnd(fromPx: Spot, toPx: Spot, taken: boolean): void;
  /** Double click on the ground, or a click in mode 'add'. */
  add(atPx: Spot): void;
}

/** 'look': pan, pick, drag. 'area': a drag draws a rectangle, without shift too (touch has none). 'add': a click
 *  or tap adds a target. 'disc': a drag draws from a middle to an edge, and a click or tap is one that has no length. */
export type Mode = 'look' | 'area' | 'add' | 'disc';

type Gesture =
  | { kind: 'none' }
  | { kind: 'pressed'; fromPx: Spot; item: Item | null; area: boolean; touch: boolean }
  | { kind: 'pan'; lastPx: Spot }
  | { kind: 'drag'; item: Item }
  | { kind: 'area'; fromPx: Spot }
  | { kind: 'pinch'; middlePx: Spot; apartPx: number }
  /** Until all fingers are up: what is left of a pinch neither pans nor picks. */
  | { kind: 'over' };

const clickPx = 4; // a pointer that moved less has clicked
const tapPx = 10;
const doubleMs = 350;
const wheelStep = 0.0016; // per pixel of the wheel: a notch of 100 is 17 %
const pinchWheelStep = 0.01; // a touchpad's pinch comes as a wheel with ctrl, in small steps
const lineHeightPx = 16;
const inLines = 1, inPages = 2; // WheelEvent.deltaMode

export class Input {
  mode: Mode = 'look';
  private gesture: Gesture = { kind: 'none' };
  private readonly pointers = new Map<number, Spot>();
  private lastClick = { atPx: { x: 0, y: 0 }, timeMs: -Infinity };
  private readonly stop = new AbortController();

  constructor(private readonly element: HTMLElement, private readonly to: Intentions) {
    element.style.touchAction = 'none'; // or the browser scrolls the page instead
    const options = { signal: this.stop.signal };
    element.addEventListener('pointerdown', (e) => this.down(e), options);
    element.addEventListener('pointermove', (e) => this.move(e), options);
    element.addEventListener('pointerup', (e) => this.up(e), options);
    element.addEventListener('pointercancel', (e) => this.lost(e), options);
    element.addEventListener('pointerleave', () => {
      if (this.pointers.size === 0) this.to.hover(null, null);
    }, options);
    element.addEventListener('wheel', (e) => this.wheel(e), { ...options, passive: false });
    element.addEventListener('contextmenu', (e) => { if (this.gesture.kind !== 'none') e.preventDefault(); }, options);
  }

  dispose(): void {
    this.cancel();
    this.stop.abort();
  }

  /** Cancels what is under way; for Escape. Whether anything was. */
  cancel(): boolean {
    const busy = this.gesture.kind !== 'none' && this.gesture.kind !== 'over';
    this.end(this.lastPx(), false);
    this.gesture = this.pointers.size > 0 ? { kind: 'over' } : { kind: 'none' };
    return busy;
  }

  private at(event: MouseEvent): Spot {
    const box = this.element.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private lastPx(): Spot {
    for (const at of this.pointers.values()) return at;
    return { x: 0, y: 0 };
  }

  private down(event: PointerEvent): void {
    if (event.pointerType === 'mouse' && event.button === 2) return;
    const atPx = this.at(event);
    this.pointers.set(event.pointerId, atPx);
    capture(this.element, event.pointerId);
    if (this.pointers.size === 2) {
      this.end(atPx, false);
      this.gesture = { kind: 'pinch', ...this.pinch() };
      return;
    }
    if (this.pointers.size > 2) return;
    const touch = event.pointerType === 'touch';
    const pans = event.pointerType === 'mouse' && event.button === 1;
    this.gesture = pans ? { kind: 'pan', lastPx: atPx } : {
      kind: 'pressed', fromPx: atPx, item: this.to.itemAt(atPx, touch),
      area: event.shiftKey || this.mode === 'area' || this.mode === 'disc', touch,
    };
  }

  private move(event: PointerEvent): void {
    const atPx = this.at(event);
    if (!this.pointers.has(event.pointerId)) {
      if (event.pointerType !== 'touch') this.to.hover(this.to.itemAt(atPx, false), atPx);
      return;
    }
    this.pointers.set(event.pointerId, atPx);
    const { gesture } = this;
    if (gesture.kind === 'pressed') this.begin(gesture, atPx);
    else if (gesture.kind === 'pan') this.panTo(gesture, atPx);
    else if (gesture.kind === 'drag') this.to.dragMove(gesture.item, atPx);
    else if (gesture.kind === 'area') this.to.areaMove(gesture.fromPx, atPx);
    else if (gesture.kind === 'pinch') this.pinchOn(gesture);
  }

  /** A press that moves far enough becomes a drag, an area or a pan. */
  private begin(press: Extract<Gesture, { kind: 'pressed' }>, atPx: Spot): void {
    if (far(press.fromPx, atPx) < (press.touch ? tapPx : clickPx)) return;
    if (press.area) {
      this.gesture = { kind: 'area', fromPx: press.fromPx };
      this.to.areaMove(press.fromPx, atPx);
      return;
    }
    const item = this.to.gripAt(press.fromPx, press.touch);
    if (item) {
      this.gesture = { kind: 'drag', item };
      this.to.dragStart(item, press.fromPx);
      this.to.dragMove(item, atPx);
    } else {
      const gesture = { kind: 'pan' as const, lastPx: press.fromPx };
      this.gesture = gesture;
      this.panTo(gesture, atPx);
    }
  }

  private panTo(gesture: { lastPx: Spot }, atPx: Spot): void {
    this.to.pan(atPx.x - gesture.lastPx.x, atPx.y - gesture.lastPx.y);
    gesture.lastPx = atPx;
  }

  private pinch(): { middlePx: Spot; apartPx: number } {
    const [a, b] = [...this.pointers.values()] as [Spot, Spot];
    return { middlePx: { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 }, apartPx: Math.max(1, far(a, b)) };
  }

  private pinchOn(gesture: Extract<Gesture, { kind: 'pinch' }>): void {
    const now = this.pinch();
    this.to.pan(now.middlePx.x - gesture.middlePx.x, now.middlePx.y - gesture.middlePx.y);
    this.to.zoom(now.apartPx / gesture.apartPx, now.middlePx);
    this.gesture = { kind: 'pinch', ...now };
  }

  private up(event: PointerEvent): void {
    if (!this.pointers.delete(event.pointerId)) return;
    const atPx = this.at(event);
    const { gesture } = this;
    if (gesture.kind === 'pressed') this.click(gesture, event.timeStamp);
    else this.end(atPx, true);
    this.gesture = this.pointers.size > 0 ? { kind: 'over' } : { kind: 'none' };
  }

  private lost(event: PointerEvent): void {
    if (!this.pointers.has(event.pointerId)) return;
    this.end(this.pointers.get(event.pointerId)!, false);
    this.pointers.delete(event.pointerId);
    this.gesture = this.pointers.size > 0 ? { kind: 'over' } : { kind: 'none' };
  }

  private click(press: Extract<Gesture, { kind: 'pressed' }>, timeMs: number): void {
    const atPx = press.fromPx;
    if (this.mode === 'disc') return this.to.areaEnd(atPx, atPx, true);
    const twice = timeMs - this.lastClick.timeMs < doubleMs && far(atPx, this.lastClick.atPx) < 2 * tapPx;
    if (this.mode === 'add' || (twice && !press.item)) {
      this.lastClick = { atPx, timeMs: -Infinity }; // a third click starts a new one
      this.to.add(atPx);
      return;
    }
    this.lastClick = { atPx, timeMs };
    this.to.pick(press.item, atPx);
  }

  /** Ends a drag or an area. */
  private end(atPx: Spot, done: boolean): void {
    const { gesture } = this;
    if (gesture.kind === 'drag') this.to.dragEnd(gesture.item, atPx, done);
    else if (gesture.kind === 'area') this.to.areaEnd(gesture.fromPx, atPx, done);
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault(); // or the page scrolls, or the browser zooms
    const unit = event.deltaMode === inLines ? lineHeightPx
      : event.deltaMode === inPages ? this.element.clientHeight : 1;
    const deltaPx = Math.max(-300, Math.min(300, event.deltaY * unit));
    this.to.zoom(Math.exp(-deltaPx * (event.ctrlKey ? pinchWheelStep : wheelStep)), this.at(event));
  }
}

const far = (a: Spot, b: Spot) => Math.hypot(a.x - b.x, a.y - b.y);

/** So that a drag goes on outside of the element. A pointer that is gone already cannot be captured. */
function capture(element: HTMLElement, pointer: number): void {
  try {
    element.setPointerCapture(pointer);
  } catch {
    // it will be reported as lost
  }
}
