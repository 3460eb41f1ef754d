// SPDX-License-Identifier: MIT
// What is selected and followed, in all runs alike, and the way from one to the next by keys.
import type { OpenRuns } from './open_runs';
import type { Notice } from './panels/notice';
import { sameItem, type Item } from './scene/view';
import type { Store } from './state/store';

export interface SelectingPage {
  /** The panel of a robot comes to the front. */
  showRobot(): void;
  /** A plot may be of it. */
  selected(): void;
}

export class Selecting {
  constructor(private readonly page: SelectingPage, private readonly runs: OpenRuns, private readonly store: Store, private readonly notice: Notice) {}

  get item(): Item | null { return this.store.state.selection; }

  /** `reveal`: its panel comes to the front. */
  select(item: Item | null, reveal = true): void {
    const { robots } = this;
    if (item?.kind === 'robot' && item.index >= robots) return this.notice.bad(`There is no robot ${item.index}: they are numbered from 0 to ${robots - 1}.`);
    this.store.set({ selection: item, followed: item?.kind === 'robot' && item.index === this.store.state.followed ? item.index : null });
    if (item?.kind === 'robot' && reveal) this.page.showRobot();
    this.page.selected();
  }

  next(direction: 1 | -1): void {
    const { robots, item } = this;
    if (robots === 0) return;
    const now = item?.kind === 'robot' ? item.index : direction > 0 ? -1 : 0;
    this.select({ kind: 'robot', index: (now + direction + robots) % robots });
  }

  /** Targets and obstacles. */
  nextThing(direction: 1 | -1): void {
    const stage = this.runs.live[0] ?? this.runs.stages[0];
    const things: Item[] = (['target', 'obstacle'] as const).flatMap((kind) =>
      Array.from({ length: kind === 'target' ? stage?.shown?.targets.x.length ?? 0 : stage?.obstacles ?? 0 }, (_, index) => ({ kind, index })));
    if (things.length === 0) return;
    const now = things.findIndex((thing) => sameItem(thing, this.item));
    this.select(things[((now < 0 && direction < 0 ? 0 : now) + direction + things.length) % things.length]);
  }

  follow(robot: number | null): void { this.store.set({ followed: robot }); }

  toggleFollow(): void {
    const { item } = this;
    if (item?.kind === 'robot') this.follow(this.store.state.followed === item.index ? null : item.index);
  }

  /** The largest number of robots of a run. Before the first picture nobody knows. */
  private get robots(): number { return Math.max(0, ...this.runs.stages.map((stage) => stage.shown?.robots ?? stage.source.header.value?.robots ?? 0)); }
}
