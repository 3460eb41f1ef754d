// SPDX-License-Identifier: MIT
// A place in the picture chosen by keys: arrows move a cross, Enter takes the place. For all that is otherwise done
// with a pointer: adding targets and obstacles, moving them, drawing the area in which robots die.
import type { Spot } from './scene/camera';
import type { Item } from './scene/view';

export type PlaceTask = { kind: 'add_target' | 'add_obstacle' | 'kill_area' } | { kind: 'move'; item: Item };

/** Those that take two places: the corners of an area, middle and edge of an obstacle. */
const takesTwo = ({ kind }: PlaceTask) => kind === 'kill_area' || kind === 'add_obstacle';

export interface PlaceActions {
  /** Where the cross begins, m; null: nothing is shown. */
  begin(task: PlaceTask): Spot | null;
  metresPerPx(): number;
  /** `corner`: the first of two places. null: no cross. */
  show(at: Spot | null, task: PlaceTask, corner: Spot | null): void;
  take(task: PlaceTask, at: Spot, corner: Spot | null): void;
}

const stepPx = 8;
const longStepPx = 48; // with Shift

export class PlaceCursor {
  private task: PlaceTask | null = null;
  private at: Spot | null = null; // null: no arrow has been pressed yet
  private corner: Spot | null = null;

  constructor(private readonly actions: PlaceActions) {}

  start(task: PlaceTask): void {
    this.stop();
    this.task = task;
    if (task.kind === 'move') this.showAt(this.actions.begin(task)); // nobody grabs a thing without wanting to see it
  }

  stop(): void {
    if (this.task !== null && this.at !== null) this.actions.show(null, this.task, null);
    this.task = this.at = this.corner = null;
  }

  /** Whether the key was meant for the cross. */
  key(key: string, shift: boolean): boolean {
    const { task } = this;
    if (task === null) return false;
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[key];
    if (step !== undefined) {
      const far = (shift ? longStepPx : stepPx) * this.actions.metresPerPx();
      const from = this.at ?? this.actions.begin(task);
      if (from !== null) this.showAt(this.at === null ? from : { x: from.x + far * step[0], y: from.y + far * step[1] });
      return true;
    }
    if (key !== 'Enter' || this.at === null) return false;
    this.enter(task, this.at);
    return true;
  }

  private enter(task: PlaceTask, at: Spot): void {
    if (takesTwo(task) && this.corner === null) {
      this.corner = at;
      return this.showAt(at);
    }
    const { corner } = this;
    this.stop();
    this.actions.take(task, at, corner);
  }

  private showAt(at: Spot | null): void {
    this.at = at;
    if (this.task !== null) this.actions.show(at, this.task, this.corner);
  }
}
