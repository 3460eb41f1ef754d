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
import { momentsOf, otherEnd } from '../src/panels/why';
import { readOff } from '../src/panels/plots';
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
    for (const tree of [{ old_parent: [-1, 0] }, { phase: [0, 1] }, { depth: [0, 1] }, { label_cm: [-1, 0] }]) {
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
    expect(messageFacts({ tick: 3, fields: { role: 3, phase: 'init', id: 7 }, problem: '' }, false).map(({ value }) => value)).toEqual(['root', 'init', '7']);
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
    const [moment] = momentsOf([frame], () => setting, 0, 1);
    expect(moment.words).toBe('hidden by robot 2');
    expect(moment.distanceM).toBe(1.5);
    expect(momentsOf([frame], () => setting, 0, 3)[0].words).toBe('out of range (2 m)');
    expect(momentsOf([frame], () => setting, 0, 2)[0].words).toBe('in contact');
    expect(momentsOf([frame], () => setting, 0, 9)).toEqual([]);
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
