// SPDX-License-Identifier: MIT
// What panels say, without a page: the words of the inspector and the notice, and where a list stands.
import { describe, expect, it } from 'vitest';
import type { RunEvent } from '../src/frame';
import { lastAt } from '../src/panels/events_list';
import { algorithms } from '../src/algorithms';
import { terms, termsOf } from '../src/glossary';
import { csvOf } from '../src/panels/keep';
import { written } from '../src/panels/run_facts';
import { facts, messageFacts } from '../src/panels/inspector';
import { shortened } from '../src/panels/notice';
import { difference, momentsOf, silenceOf } from '../src/panels/unheard';
import { otherEnd } from '../src/panels/why';
import { Deeds } from '../src/state/deeds';
import { readOff } from '../src/panels/curves';
import { frameOf, settingOf } from './scene_frames';

describe('the panel of a live run', () => {
  it('offers the algorithms that the simulation knows', () => {
    for (const name of ['convoy', 'outwards', 'inwards', 'link-consensus', 'mst']) expect(algorithms).toContain(name);
  });
});

describe('the inspector', () => {
  it('counts the living as children, and no spares', () => {
    const frame = frameOf({ x_m: [0, 1, 2, 3], role: [3, 1, 1, 0], parent: [-1, 0, 0, 0], alive: [1, 1, 0, 1] });
    expect(facts(frame, 0).find(({ name }) => name === 'children')?.value).toBe('1');
  });
  it('shows of a report only what the algorithm has', () => {
    const names = (columns: Parameters<typeof frameOf>[0]) => facts(frameOf(columns, 1), 0).map(({ name }) => name);
    const nothing = names({ x_m: [0, 1] });
    expect(nothing).toEqual(['position', 'heading', 'alive']);
    expect(names({ x_m: [0, 1], role: [0, 3] })).toEqual(['position', 'heading', 'role', 'target', 'alive', 'connected']);
    expect(names({ x_m: [0, 1], target: [-1, 2] })).toEqual(['position', 'heading', 'target', 'alive']);
    // Algorithms of others have links and perhaps a tree, but nothing of the paper's way to one.
    expect(names({ x_m: [0, 1], role: [0, 3], parent: [-1, 0], want_m: [0, 2] })).toEqual(
      ['position', 'heading', 'role', 'parent', 'children', 'want', 'target', 'alive', 'connected']);
    expect(names({ x_m: [0, 1], parent: [-1, 0], epoch: [3, 3] })).toEqual(['position', 'heading', 'epoch', 'parent', 'children', 'alive']);
    for (const tree of [{ old_parent: [-1, 0] }, { phase: [0, 1] }, { depth: [0, 1] }, { label_m: [-1, 0] }]) {
      const rows = names({ x_m: [0, 1], ...tree });
      expect(rows, JSON.stringify(tree)).toContain('parent');
      expect(rows).not.toContain('role');
      expect(rows.length).toBe(nothing.length + 12);
    }
  });
  it('shows the tree before the first tick, too, when nobody has taken part in it yet', () => {
    const rows = facts(frameOf({ x_m: [0, 1], role: [0, 3] }), 0);
    expect(rows.find(({ name }) => name === 'phase')?.value).toBe('init');
  });
  it('says why there is no message', () => {
    const words = (live: boolean, problem = '') => messageFacts({ tick: 3, fields: null, problem }, live)[0].value;
    expect(words(true)).toBe('not kept for this moment');
    expect(words(false)).toBe('this recording has none for this moment');
    expect(words(true, 'the worker is gone')).toBe('the worker is gone');
  });
  it('has a message in words', () => {
    expect(messageFacts({ tick: 3, fields: { role: 3, phase: 'init', id: 7, seqno: 1234567, pull_x: 0.30000001192 }, problem: '' }, false).map(({ value }) => value))
      .toEqual(['root', 'init', '7', '1234567', '0.3']);
  });
});

describe('a value of a plot', () => {
  it('is not 0 unless it is', () => {
    const shown = [0, 0.5, 0.00123, 0.00012, 3.4e-7, 1.2e-11, null].map((v) => readOff({ digits: 4, tiny: true }, v));
    expect(shown).toEqual(['0.0000', '0.5000', '0.0012', '0.00012', '3.4·10⁻⁷', '1.2·10⁻¹¹', '–']);
    expect(readOff({ digits: 0 }, 3)).toBe('3');
    expect(readOff({ digits: 2 }, 0.001)).toBe('0.00'); // of metres that is near enough
  });
});

describe('what is kept', () => {
  it('is a table as the program writes it', () => {
    expect(csvOf({ tick: Float64Array.of(0, 1), fiedler: Float64Array.of(NaN, 0.25) })).toBe('tick,fiedler\n0,\n1,0.25\n');
    expect(csvOf({})).toBe('\n');
  });
});

describe('the glossary', () => {
  it('is that of the documents', () => {
    expect(termsOf('| term | meaning |\n|---|---|\n| **old parent** | *paper* ("old tree"): the [parent](a.md) | `old_parent` |\n')).toEqual([{ name: 'old parent', meaning: 'paper ("old tree"): the parent' }]);
    expect(terms.length).toBeGreaterThan(40);
    for (const name of ['root', 'worker', 'connector', 'spare']) expect(terms.map((term) => term.name)).toContain(name);
  });
});

describe('a result in the panel Run', () => {
  it('has as many digits as can be read, and a unit', () => {
    expect([['11.7000', 's'], ['8', ''], ['951.7949', 'bytes/s'], ['0.0123', '%'], ['', 's'], ['convoy', '']].map(([value, unit]) => written(value, unit)))
      .toEqual(['11.70 s', '8', '951.8 bytes/s', '1.2 %', '', 'convoy']);
  });
});

describe('why an edge broke', () => {
  const setting = settingOf({ range_m: 2, line_of_sight: true, radius_m: 0.1 });
  const frame = frameOf({ x_m: [0, 1.5, 0.7, 5], y_m: [0, 0, 0.05, 0], parent: [-1, 0, 0, 0], old_parent: [-1, -1, -1, 1] });
  it('is said of each tick: apart, and what stands between', () => {
    const at = (other: number, deeds = new Deeds('')) => momentsOf([frame], () => setting, 0, other, deeds);
    expect(at(1)[0]).toMatchObject({ words: 'occluded by robot 2', distanceM: 1.5, heard: 'no' });
    expect(at(3)[0]).toMatchObject({ words: 'out of range (2 m)', heard: 'no' });
    expect(at(2)[0]).toMatchObject({ words: 'in contact', heard: 'yes' });
    expect(at(9)).toEqual([]);
    const lossy = new Deeds('{"radio":{"loss":0.25},"events":[]}');
    expect(at(2, lossy)[0]).toMatchObject({ words: 'in contact, 25 % loss', heard: 'perhaps' });
    const dark = new Deeds('{"events":[{"kind":"blackout","time_s":0,"duration_s":3}]}');
    expect(at(2, dark)[0]).toMatchObject({ words: 'in contact, but blackout', heard: 'no' });
  });
  it('is followed by a silence, which has a begin, perhaps an end, and words that were not heard', () => {
    const moments = (heard: string) => [...heard].map((sign, tick) => (
      { tick, timeS: tick / 10, distanceM: 1, words: '', heard: sign === '+' ? 'yes' as const : sign === '?' ? 'perhaps' as const : 'no' as const }));
    const silence = (heard: string, breakS: number) => {
      const found = silenceOf(moments(heard), breakS, 0.1);
      return found && [found.before?.tick, found.last.tick, found.count, found.over];
    };
    expect(silence('+++---++', 0.3)).toEqual([2, 5, 3, true]);
    expect(silence('+-?---', 0.3)).toEqual([2, 5, 3, false]); // one that is over before the break is not meant
    expect(silence('----', 0)).toEqual([undefined, 3, 4, false]);
    expect(silence('+++??', 0.3)).toBeNull();
    const heard = { id: 4, role: 1, depth: 2 };
    expect(difference(heard, { id: 4, role: 0, depth: 3, fresh: true }, (name, value) => `${name} ${value}`)).toEqual([
      { name: 'role', heard: 'role 1', said: 'role 0' }, { name: 'depth', heard: 'depth 2', said: 'depth 3' }, { name: 'fresh', heard: '–', said: 'fresh true' }]);
  });
  it('is about the edge that does not hold', () => {
    expect(otherEnd(frame, setting, 1)).toBe(0);
    expect(otherEnd(frameOf({ x_m: [0, 1, 9], parent: [-1, 0, 0], old_parent: [-1, 2, -1] }), setting, 1)).toBe(2);
  });
});

describe('many warnings', () => {
  it('are the first three and how many more there are', () => {
    expect(shortened(['a', 'b', 'c', 'd', 'e'])).toEqual(['a', 'b', 'c', '… and 2 more: see Run']);
    expect(shortened(['a', 'b', 'c'])).toEqual(['a', 'b', 'c']);
  });
});

describe('the list of events', () => {
  const events = [1, 2, 2, 4].map((time_s) => ({ time_s }) as RunEvent);
  it.each([[0, -1], [1, 0], [2, 2], [3.9, 2], [9, 3]])('stands at %s s at the right one', (timeS, index) => expect(lastAt(events, timeS)).toBe(index));
});
