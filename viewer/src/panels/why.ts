// SPDX-License-Identifier: MIT
// Why an edge broke: the ticks before, how far apart its ends were and what stood between them, and side by side what
// both believed and what they had said last.
import { button, h } from '../dom';
import { column, type Frame, type RunEvent, type Setting } from '../frame';
import { Radio } from '../scene/links';
import type { MessageFields } from '../source/protocol';
import { facts, messageFacts } from './inspector';

/** What it asks of a run. */
export interface Witness {
  /** All frames between two times. */
  frames(fromS: number, toS: number): Promise<Frame[]>;
  message(robot: number, tick: number): Promise<MessageFields | null>;
  settingAt(timeS: number): Setting | null;
  tickS: number;
  live: boolean;
}

const ticksBefore = 10;

/** The other end of the edge that is broken at this frame; -1: the frame knows none. */
export function otherEnd(frame: Frame, setting: Setting, robot: number): number {
  const radio = new Radio(setting, frame);
  for (const name of ['parent', 'old_parent'] as const) {
    const other = column(frame, name)[robot];
    if (other >= 0 && other < frame.robots && radio.link(robot, other) !== 'open') return other;
  }
  return column(frame, 'parent')[robot] ?? -1;
}

export interface Moment { timeS: number; distanceM: number; words: string }

/** How an edge was at each of these frames. */
export function momentsOf(frames: readonly Frame[], settingAt: (timeS: number) => Setting | null, a: number, b: number): Moment[] {
  return frames.flatMap((frame) => {
    const setting = settingAt(frame.timeS);
    if (setting === null || Math.max(a, b) >= frame.robots) return [];
    const x = column(frame, 'x_m'), y = column(frame, 'y_m');
    const radio = new Radio(setting, frame);
    const link = radio.link(a, b);
    const words = link === 'blocked' ? `hidden by ${radio.blocker(a, b)}` : link === 'out of range' ? `out of range (${setting.range_m} m)` : link === 'dead' ? 'an end is dead' : 'in contact';
    return [{ timeS: frame.timeS, distanceM: Math.hypot(x[a] - x[b], y[a] - y[b]), words }];
  });
}

export class Why {
  readonly element: HTMLDialogElement = h('dialog', { class: 'why', 'aria-label': 'Why did it break' });
  private readonly content = h('div');

  constructor(private readonly show: (timeS: number, robot: number) => void) {
    this.element.append(this.content, button('Close', 'Close', () => this.element.close(), { class: 'primary' }));
    this.element.addEventListener('click', (event) => { if (event.target === this.element) this.element.close(); });
  }

  /** Rejects if the run cannot say. */
  async open(event: RunEvent, witness: Witness): Promise<void> {
    const { tickS } = witness;
    const frames = (await witness.frames(Math.max(0, event.time_s - ticksBefore * tickS), event.time_s))
      .filter((frame) => frame.timeS <= event.time_s + tickS / 2 && frame.timeS >= event.time_s - (ticksBefore + 0.5) * tickS);
    const last = frames.at(-1);
    const setting = witness.settingAt(event.time_s);
    if (last === undefined || setting === null) throw new Error('The frames of that moment are not there.');
    const ends = [event.robot, otherEnd(last, setting, event.robot)].filter((end) => end >= 0);
    const before = frames.at(-2) ?? last;
    const said = await Promise.all(ends.map(async (end) => ({ tick: before.tick, fields: await witness.message(end, before.tick), problem: '' })));
    this.content.replaceChildren(
      h('h2', {}, `Why did it break? ${event.text}`),
      ...(ends.length === 2 ? [this.moments(momentsOf(frames, (t) => witness.settingAt(t), ends[0], ends[1]), ends[0])] : []),
      h('div', { class: 'ends' }, ...ends.map((end, k) => h('section', {},
        h('h3', {}, `Robot ${end} at ${before.timeS.toFixed(1)} s, just before`),
        rows(facts(before, end)), h('h3', {}, 'Its last message'), rows(messageFacts(said[k], witness.live))))),
    );
    this.element.showModal();
  }

  private moments(moments: Moment[], robot: number): HTMLElement {
    return h('table', { class: 'facts moments' },
      h('thead', {}, h('tr', {}, ...['Time', 'Apart', 'The two'].map((name) => h('th', { scope: 'col' }, name)))),
      h('tbody', {}, ...moments.map(({ timeS, distanceM, words }) => h('tr', {},
        h('td', {}, h('button', { type: 'button', class: 'link', onclick: () => { this.element.close(); this.show(timeS, robot); } }, `${timeS.toFixed(1)} s`)),
        h('td', {}, `${distanceM.toFixed(3)} m`), h('td', {}, words)))));
  }
}

function rows(all: { name: string; value: string }[]): HTMLElement {
  return h('table', { class: 'facts' }, h('tbody', {}, ...all.map(({ name, value }) => h('tr', {}, h('th', { scope: 'row' }, name.replaceAll('_', ' ')), h('td', {}, value)))));
}
