// SPDX-License-Identifier: MIT
// The selected robot in each run that is shown: of one run its inspector, of several one for each, below what they
// differ in.
import { h, setText } from '../dom';
import type { Frame } from '../frame';
import { RobotWatch } from '../robot_watch';
import type { Stage } from '../stage';
import { beside } from './beside';
import { facts, Inspector, type InspectorActions } from './inspector';

export interface InspectedRun {
  name: string; // what it differs in from the others
  stage: Stage;
}

class One {
  private readonly line = h('i', { class: 'run-line', 'aria-hidden': 'true' });
  private readonly name = h('span');
  readonly inspector: Inspector;
  readonly watch: RobotWatch;
  readonly details: HTMLDetailsElement;

  constructor(k: number, actions: InspectorActions, opened: () => void) {
    this.inspector = new Inspector(actions);
    this.watch = new RobotWatch(this.inspector);
    this.line.dataset.run = String(k + 1);
    this.details = h('details', { class: 'run-inspector', ontoggle: opened }, h('summary', {}, this.line, this.name));
  }

  call(name: string): void { setText(this.name, name); }
}

export class Inspectors {
  readonly element = h('div', { class: 'inspectors' });
  private readonly inAll = h('div', { class: 'in-all', tabindex: 0, role: 'region', 'aria-label': 'In all runs', hidden: true });
  private readonly each: One[] = [];
  private laidOut = ''; // for how many runs
  private open = -1; // the one that was opened last for the visitor

  /** `opened`: one is to be filled. */
  constructor(private readonly actions: InspectorActions, private readonly opened: () => void) {}

  /** `chosen`: the run in which the robot was clicked. */
  update(runs: readonly InspectedRun[], robot: number | null, followed: number | null, chosen: number): void {
    this.layOut(runs.length, robot !== null);
    this.showDifferences(runs, robot);
    if (robot === null) return;
    if (chosen !== this.open) this.openOnly(chosen);
    runs.forEach(({ name, stage }, k) => {
      const one = this.each[k];
      one.call(name);
      const seen = runs.length === 1 || one.details.open;
      if (seen) one.watch.show(stage, robot, followed, stage.live);
    });
  }

  private openOnly(chosen: number): void {
    this.open = chosen;
    this.each.forEach(({ details }, k) => { details.open = k === chosen; });
  }

  /** Of nobody there is one hint, however many runs there are. */
  private layOut(count: number, anybody: boolean): void {
    const wanted = anybody ? String(count) : 'hint';
    if (wanted === this.laidOut) return;
    this.laidOut = wanted;
    this.open = -1;
    while (this.each.length < Math.max(1, count)) this.each.push(new One(this.each.length, this.actions, this.opened));
    const shown = this.each.slice(0, Math.max(1, count));
    if (!anybody) for (const { watch } of shown) watch.show(null, null, null, false);
    if (!anybody || count < 2) return this.element.replaceChildren(this.inAll, shown[0].inspector.element);
    for (const { details, inspector } of shown) details.append(inspector.element);
    this.element.replaceChildren(this.inAll, ...shown.map(({ details }) => details));
  }

  /** The robot of this number in each run. */
  private showDifferences(runs: readonly InspectedRun[], robot: number | null): void {
    const frames = runs.flatMap(({ name, stage: { recordedFrame } }) => (recordedFrame === null ? [] : [{ name, frame: recordedFrame }]));
    const there = frames.filter(({ frame }) => robot !== null && robot < frame.robots);
    const table = robot === null || there.length < 2 ? null : differences(there, robot);
    const key = table?.textContent ?? '';
    if (this.inAll.dataset.key === key) return;
    this.inAll.dataset.key = key;
    this.inAll.hidden = table === null; // no place for Tab to stop
    this.inAll.replaceChildren(...(table === null ? [] : [h('h3', {}, 'In all runs'), table]));
  }
}

function differences(runs: readonly { name: string; frame: Frame }[], robot: number): HTMLTableElement {
  return beside(runs.map(({ name }) => name), runs.map(({ frame }) => facts(frame, robot)));
}
