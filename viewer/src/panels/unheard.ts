// SPDX-License-Identifier: MIT
// What one robot said and another did not hear, around the moment at which the edge between them broke: from the frames,
// the radio's setting and what was done to it. A packet that got lost by chance is in no recording, so that is only said to
// be possible.
import { column, type Frame, type Setting } from '../frame';
import { Radio } from '../scene/links';
import type { MessageFields } from '../source/protocol';
import type { Deeds } from '../state/deeds';

export interface Moment {
  tick: number;
  timeS: number;
  distanceM: number;
  words: string;
  /** Whether what they say then reaches the other end. */
  heard: 'yes' | 'no' | 'perhaps';
}

const percent = (share: number) => `${Math.round(1000 * share) / 10} %`;

/** How the way between two robots was at each of these frames. */
export function momentsOf(
  frames: readonly Frame[], settingAt: (timeS: number) => Setting | null, a: number, b: number,
  deeds: Pick<Deeds, 'lossAt' | 'isBlackoutAt'>,
): Moment[] {
  return frames.flatMap((frame) => {
    const { tick, timeS } = frame;
    const setting = settingAt(timeS);
    if (setting === null || Math.max(a, b) >= frame.robots) return [];
    const x = column(frame, 'x_m'), y = column(frame, 'y_m');
    const radio = new Radio(setting, frame);
    const link = radio.link(a, b);
    const loss = deeds.lossAt(timeS);
    const [words, heard] = ((): [string, Moment['heard']] => {
      if (link === 'blocked') return [`occluded by ${radio.blocker(a, b)}`, 'no'];
      if (link === 'out of range') return [`out of range (${setting.range_m} m)`, 'no'];
      if (link === 'dead') return ['an end is dead', 'no'];
      if (deeds.isBlackoutAt(timeS)) return ['in contact, but blackout', 'no'];
      return loss > 0 ? [`in contact, ${percent(loss)} loss`, 'perhaps'] : ['in contact', 'yes'];
    })();
    return [{ tick, timeS, distanceM: Math.hypot(x[a] - x[b], y[a] - y[b]), words, heard }];
  });
}

/** The silence that begins with the break: the last moment at which the other end may have heard, the last one at which
 *  it did not, and how many there are; null: it heard all the time. */
export interface Silence {
  before: Moment | null;
  last: Moment;
  count: number;
  /** It has heard again after that. */
  over: boolean;
}

export function silenceOf(moments: readonly Moment[], breakS: number, tickS: number): Silence | null {
  const begins = moments.findIndex(({ timeS, heard }) => heard === 'no' && timeS >= breakS - 1.5 * tickS);
  if (begins < 0) return null;
  const ends = moments.findIndex(({ heard }, k) => k > begins && heard !== 'no');
  const count = (ends < 0 ? moments.length : ends) - begins;
  return { before: moments[begins - 1] ?? null, last: moments[begins + count - 1], count, over: ends >= 0 };
}

export interface Unsaid { name: string; heard: string; said: string }

/** In what the message that was said last and not heard differs from the last one that could be. */
export function difference(heard: MessageFields, said: MessageFields, word: (name: string, value: MessageFields[string]) => string): Unsaid[] {
  return Object.keys(said).filter((name) => said[name] !== heard[name]).map((name) => ({
    name, said: word(name, said[name]), heard: heard[name] === undefined ? '–' : word(name, heard[name]),
  }));
}
