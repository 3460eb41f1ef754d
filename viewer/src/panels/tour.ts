// SPDX-License-Identifier: MIT
// The first half minute: what is to be seen, shown by pointing at it, and what can be done, tried at once. Can be left
// at every step; whoever has seen or left it is not asked again.
import { button, h, setText } from '../dom';

export type Part = 'root' | 'worker' | 'connector' | 'spare' | 'target';

export interface TourActions {
  /** Marks one of these in the picture; null: none. */
  point(part: Part | null): void;
  killRelay(): void;
  compare(): void;
  /** Where it was seen or left is remembered. */
  over(): void;
}

interface Step {
  text: string;
  part?: Part;
  act?: { label: string; title: string; run(actions: TourActions): void };
}

const steps: Step[] = [
  { text: 'The goal: some robots have to stand on the targets, far apart, and all robots must stay one radio network. Nobody knows the map; each robot hears only those nearby.', part: 'target' },
  { text: 'A worker (blue, white dot) drives to its target and tows the others behind it.', part: 'worker' },
  { text: 'The root (ringed) is where the tree begins. It moves on when another place is better.', part: 'root' },
  { text: 'A connector (green) keeps the tree together: each edge must stay shorter than the radio reaches.', part: 'connector' },
  { text: 'A spare (yellow) waits until an edge gets long, and is inserted there.', part: 'spare' },
  { text: 'Break something: kill a connector and watch the tree heal. Undo takes it back.', act: { label: 'Kill a connector', title: 'One that others hang on', run: (actions) => actions.killRelay() } },
  { text: 'Now drag a target somewhere else: its worker follows, the tree after it.', part: 'target' },
  { text: 'And compare: the paper’s algorithm outwards beside convoy, same start, same seed.', act: { label: 'Compare', title: 'Both side by side', run: (actions) => actions.compare() } },
];

export class Tour {
  readonly element = h('aside', { class: 'tour', 'aria-label': 'Tour', hidden: true });
  private readonly text = h('p', { 'aria-live': 'polite' });
  private readonly count = h('span', { class: 'hint' });
  private readonly act = h('button', { type: 'button', onclick: () => steps[this.step].act?.run(this.actions) });
  private readonly next = button('Next', 'The next step', () => this.go(this.step + 1), { class: 'primary' });
  private step = 0;

  constructor(private readonly actions: TourActions) {
    this.element.append(this.text, h('div', { class: 'buttons' }, this.act, this.next, button('Skip', 'Leave the tour', () => this.stop()), this.count));
  }

  start(): void {
    this.element.hidden = false;
    this.go(0);
  }

  stop(): void {
    if (this.element.hidden) return;
    this.element.hidden = true;
    this.actions.point(null);
    this.actions.over();
  }

  private go(step: number): void {
    if (step >= steps.length) return this.stop();
    this.step = step;
    const { text, part, act } = steps[step];
    setText(this.text, text);
    setText(this.count, `${step + 1} of ${steps.length}`);
    this.act.hidden = act === undefined;
    setText(this.act, act?.label ?? '');
    this.act.title = act?.title ?? '';
    setText(this.next, step === steps.length - 1 ? 'Done' : 'Next');
    this.actions.point(part ?? null);
  }
}
