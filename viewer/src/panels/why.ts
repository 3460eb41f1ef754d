// SPDX-License-Identifier: MIT
// Why did it break: the seconds around an edge broke, what both ends believed and said just before, side by side, and what
// was said after that and not heard.
import { button, h } from '../dom';
import { column, type Frame, type RunEvent, type Setting } from '../frame';
import { Radio } from '../scene/links';
import type { MessageFields } from '../source/protocol';
import { Deeds } from '../state/deeds';
import { beside } from './beside';
import { facts, messageFacts, word, type Said } from './inspector';
import { difference, momentsOf, silenceOf, type Moment, type Silence } from './unheard';

/** What it asks of a run. */
export interface Witness {
  /** All frames between two times. */
  frames(fromS: number, toS: number): Promise<Frame[]>;
  message(robot: number, tick: number): Promise<MessageFields | null>;
  settingAt(timeS: number): Setting | null;
  /** The whole configuration, which lists what was done to the radio. */
  config: string;
  tickS: number;
  seenS: number; // up to where there is anything to ask for
  live: boolean;
}

const ticksBefore = 10;
const ticksAfter = 20; // of silence that is worth looking at

/** The other end of the edge that is broken at this frame; -1: the frame knows none. */
export function otherEnd(frame: Frame, setting: Setting, robot: number): number {
  const radio = new Radio(setting, frame);
  for (const name of ['parent', 'old_parent'] as const) {
    const other = column(frame, name)[robot];
    if (other >= 0 && other < frame.robots && radio.link(robot, other) !== 'open') return other;
  }
  return column(frame, 'parent')[robot] ?? -1;
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
    const [fromS, toS] = [event.time_s - (ticksBefore + 0.5) * tickS, Math.min(witness.seenS, event.time_s + ticksAfter * tickS) + tickS / 2];
    const frames = (await witness.frames(Math.max(0, fromS), Math.min(toS, witness.seenS))).filter(({ timeS }) => timeS >= fromS && timeS <= toS);
    const breaks = frames.filter(({ timeS }) => timeS <= event.time_s + tickS / 2).length - 1;
    const setting = witness.settingAt(event.time_s);
    if (breaks < 0 || setting === null) throw new Error('The frames of that moment are not there.');
    const ends = [event.robot, otherEnd(frames[breaks], setting, event.robot)].filter((end) => end >= 0);
    const before = frames[Math.max(0, breaks - 1)];
    const said = await Promise.all(ends.map((end) => this.ask(witness, end, before.tick)));
    const moments = ends.length < 2 ? [] : momentsOf(frames, (t) => witness.settingAt(t), ends[0], ends[1], new Deeds(witness.config));
    this.content.replaceChildren(
      h('h2', {}, `Why did it break? ${event.text}`),
      ...(moments.length > 0 ? [this.moments(moments, ends[0], event.time_s)] : []),
      h('h3', {}, `What they believed at ${before.timeS.toFixed(1)} s, just before`),
      beside(ends.map(robotName), ends.map((end) => facts(before, end))),
      h('h3', {}, 'What they said last then'),
      beside(ends.map(robotName), said.map((message) => messageFacts(message, witness.live))),
      ...(moments.length > 0 ? await this.unheard(ends, silenceOf(moments, event.time_s, tickS), witness) : []),
    );
    this.element.showModal();
    this.content.querySelector('.broke')?.scrollIntoView({ block: 'center' }); // in its table
    this.element.scrollTop = 0;
  }

  private async ask(witness: Witness, robot: number, tick: number): Promise<Said> {
    return { tick, fields: await witness.message(robot, tick), problem: '' };
  }

  private moments(moments: Moment[], robot: number, breakS: number): HTMLElement {
    const heard = { yes: 'yes', no: 'no', perhaps: 'unless lost' };
    return h('div', { class: 'scrolled', tabindex: 0, role: 'region', 'aria-label': 'Moment by moment' }, h('table', { class: 'facts moments' },
      h('thead', {}, h('tr', {}, ...['Time', 'Apart', 'The two', 'Heard'].map((name) => h('th', { scope: 'col' }, name)))),
      h('tbody', {}, ...moments.map((moment) => h('tr', { class: Math.abs(moment.timeS - breakS) < 1e-6 ? 'broke' : undefined },
        h('td', {}, h('button', { type: 'button', class: 'link', onclick: () => { this.element.close(); this.show(moment.timeS, robot); } }, `${moment.timeS.toFixed(1)} s`)),
        h('td', {}, `${moment.distanceM.toFixed(3)} m`), h('td', {}, moment.words), h('td', {}, heard[moment.heard]))))));
  }

  /** For both ends: what the other one does not know since. */
  private async unheard(ends: number[], silence: Silence | null, witness: Witness): Promise<HTMLElement[]> {
    const title = h('h3', {}, 'What was said and not heard');
    if (silence === null) return [title, h('p', {}, 'Nothing: they were in contact all the time.')];
    const { before, last, count, over } = silence;
    const until = over ? `They heard each other again after ${last.timeS.toFixed(1)} s.` : 'They have not heard each other again by then.';
    const parts = await Promise.all(ends.map(async (end, k) => {
      const [heard, said] = await Promise.all([before?.tick ?? -1, last.tick].map((tick) => (tick < 0 ? null : witness.message(end, tick))));
      return h('section', {}, h('h4', {}, `Robot ${end} to robot ${ends[1 - k]}`), missed(heard, said, before, last));
    }));
    return [title, h('p', {}, `${count} ${count === 1 ? 'message' : 'messages'} each way up to ${last.timeS.toFixed(1)} s. ${until}`), h('div', { class: 'ends' }, ...parts)];
  }
}

function missed(heard: MessageFields | null, said: MessageFields | null, before: Moment | null, last: Moment): HTMLElement {
  if (heard === null || said === null || before === null) return h('p', { class: 'hint' }, 'What it said then is not kept.');
  const rows = difference(heard, said, word);
  if (rows.length === 0) return h('p', {}, 'It said nothing new.');
  return h('table', { class: 'facts unheard' },
    h('thead', {}, h('tr', {}, ...['', `heard, ${before.timeS.toFixed(1)} s`, `not heard, ${last.timeS.toFixed(1)} s`].map((name) => h('th', { scope: 'col' }, name)))),
    h('tbody', {}, ...rows.map((row) => h('tr', {}, h('th', { scope: 'row' }, row.name.replaceAll('_', ' ')), h('td', {}, row.heard), h('td', {}, row.said)))));
}

const robotName = (robot: number) => `Robot ${robot}`;
