// SPDX-License-Identifier: MIT
// Interpolation, jumps between events, live controls, names, the page's state.
import { RobotSeries } from '../src/state/robot_series';
import { frameOf } from './scene_frames';
import { describe, expect, it } from 'vitest';
import { column, type RunEvent } from '../src/frame';
import { apart } from '../src/files';
import { fromBase64, nothing, readLink, toBase64, writeLink } from '../src/link';
import { outcomeOf, percent } from '../src/state/outcome';
import { eventsNear } from '../src/panels/transport';
import { experimentOf, type Known } from '../src/origin';
import { namesOf, runsOf } from '../src/runs';
import { PlaceCursor, type PlaceTask } from '../src/place_cursor';
import { kindOf, Warnings } from '../src/source/problem';
import { outdated } from '../src/panels/transport';
import { Controls } from '../src/state/controls';
import { Deeds } from '../src/state/deeds';
import { eventAfter } from '../src/state/events';
import { interpolate, normalized } from '../src/state/interpolate';
import { Pace } from '../src/state/pace';
import { initialState, type State, Store } from '../src/state/store';
import { frameAt, random } from './support';

describe('interpolation', () => {
  const between = (change: (a: ReturnType<typeof frameAt>, b: ReturnType<typeof frameAt>) => void, timeS = 0.05) => {
    const a = frameAt(0, 0.1, 2);
    const b = frameAt(1, 0.1, 2);
    change(a, b);
    return interpolate(a, b, timeS);
  };

  it('goes on a line', () => {
    const frame = between((a, b) => { column(a, 'x_m').set([1, 2]); column(b, 'x_m').set([1.2, 1.9]); b.targets.x[0] = 0.5; }, 0.025);
    expect(column(frame, 'x_m')[0]).toBeCloseTo(1.05);
    expect(column(frame, 'x_m')[1]).toBeCloseTo(1.975);
    expect(frame.targets.x[0]).toBeCloseTo(0.125);
    expect(frame.timeS).toBe(0.025);
  });
  it('turns the shorter way', () => {
    const frame = between((a, b) => { column(a, 'heading_rad').set([3, -3]); column(b, 'heading_rad').set([-3, 3]); });
    expect(Math.abs(column(frame, 'heading_rad')[0])).toBeCloseTo(Math.PI);
    expect(column(frame, 'heading_rad').every((v) => v > -Math.PI && v <= Math.PI)).toBe(true);
  });
  it('keeps all else from the earlier frame', () => {
    const frame = between((a, b) => { column(a, 'role').set([1, 2]); column(b, 'role').set([3, 0]); column(b, 'parent').set([1, 1]); });
    expect([...column(frame, 'role')]).toEqual([1, 2]);
    expect([...column(frame, 'parent')]).toEqual([0, 0]);
    expect(frame.tick).toBe(0);
  });
  it('does not smear who leaps', () => {
    const frame = between((_, b) => { column(b, 'x_m').set([40, 1]); });
    expect([...column(frame, 'x_m')]).toEqual([0, 1]);
  });
  it('outside is one of the frames, and never touches them', () => {
    const a = frameAt(0);
    const b = frameAt(1);
    expect(interpolate(a, b, -1)).toEqual(a);
    expect(interpolate(a, b, 7)).toEqual(b);
    expect(interpolate(a, null, 7)).toEqual(a);
    const into = interpolate(a, b, 0.05);
    const again = interpolate(a, b, 0.09, into);
    expect(again.data).toBe(into.data);
    expect(a).toEqual(frameAt(0));
    expect(b).toEqual(frameAt(1));
  });
  it('stands more robots or fewer in the next frame', () => {
    expect(interpolate(frameAt(0, 0.1, 3), frameAt(1, 0.1, 2), 0.05).robots).toBe(3);
    expect(interpolate(frameAt(0, 0.1, 1), frameAt(1, 0.1, 2), 0.05).robots).toBe(1);
  });
  it('normalizes any angle', () => {
    const next = random(3);
    for (let k = 0; k < 1000; ++k) {
      const angle = 40 * next() - 20;
      const inside = normalized(angle);
      expect(inside > -Math.PI && inside <= Math.PI).toBe(true);
      expect(Math.cos(inside)).toBeCloseTo(Math.cos(angle), 9);
    }
    expect(normalized(-Math.PI)).toBe(Math.PI);
  });
});

describe('jumps', () => {
  const event = (time_s: number, kind: string): RunEvent => ({ tick: Math.round(10 * time_s), time_s, kind, robot: 0, target: -1, text: kind });
  const events = [event(0.5, 'phase'), event(1, 'recruited'), event(1, 'inserted'), event(2, 'phase'), event(3, 'death'), event(9, 'complete')];

  it('stop at what is notable, once for each moment', () => {
    expect(eventAfter(events, 0, 1)?.time_s).toBe(1);
    expect(eventAfter(events, 1, 1)?.time_s).toBe(3);
    expect(eventAfter(events, 1 - 1e-9, 1)?.time_s).toBe(3);
    expect(eventAfter(events, 9, 1)).toBeNull();
    expect(eventAfter(events, 9, -1)?.time_s).toBe(3);
    expect(eventAfter(events, 2.5, -1)?.time_s).toBe(1);
    expect(eventAfter(events, 1, -1)).toBeNull();
    expect(eventAfter([], 1, 1)).toBeNull();
  });
});

describe('work that is wanted too often', () => {
  it('is done at once, then at most so often, and not forgotten', () => {
    const pace = new Pace(250);
    expect(pace.due(0)).toBe(false);
    const done: number[] = [];
    for (let ms = 0; ms < 1000; ms += 10) {
      pace.want();
      if (pace.due(ms)) done.push(ms);
    }
    expect(done).toEqual([0, 250, 500, 750]);
    expect(pace.due(999)).toBe(false);
    expect(pace.due(1000)).toBe(true);
    expect(pace.due(2000)).toBe(false);
  });
});

describe('marks on the timeline', () => {
  const drawn = { width: 800, height: 20, startS: 0, endS: 100 };
  it('are drawn anew when they are off by what can be seen', () => {
    expect(outdated(null, drawn, true)).toBe(true);
    expect(outdated(drawn, { ...drawn, width: 801 }, true)).toBe(true);
    expect(outdated(drawn, { ...drawn, endS: 100.4 }, true)).toBe(false);
    expect(outdated(drawn, { ...drawn, endS: 101 }, true)).toBe(true);
    expect(outdated(drawn, { ...drawn, endS: 50 }, true)).toBe(true);
  });
  it('are exact where the clock stands still', () => {
    expect(outdated(drawn, drawn, false)).toBe(false);
    expect(outdated(drawn, { ...drawn, endS: 100.1 }, false)).toBe(true);
  });
});

describe('what the live controls show', () => {
  const known = { loss: 0, lineOfSight: true };

  it('is what was asked for until that is seen, and what is known from then on', () => {
    const controls = new Controls();
    expect(controls.at(5, true, known)).toEqual(known);
    controls.ask([{ kind: 'set_line_of_sight', line_of_sight: false }], 50, 0.1);
    controls.ask([{ kind: 'set_loss', loss: 0.3 }], 50, 0.1);
    expect(controls.at(5, true, known)).toEqual({ loss: 0.3, lineOfSight: false });
    expect(controls.at(5.1, false, known)).toEqual({ loss: 0.3, lineOfSight: false });
    expect(controls.at(5.1, true, known)).toEqual(known);
    expect(controls.at(5, true, known)).toEqual(known);
  });
  it('is nothing of what could not be, or was undone by going back', () => {
    const controls = new Controls();
    controls.ask([{ kind: 'set_loss', loss: 0.3 }], 50, 0.1);
    controls.forget();
    expect(controls.at(5, true, known)).toEqual(known);
    controls.ask([{ kind: 'set_loss', loss: 0.3 }], 50, 0.1);
    expect(controls.at(4, true, known)).toEqual(known);
    controls.ask([{ kind: 'set_loss', loss: 0.3 }], 50, 0.1);
    controls.ask([{ kind: 'die', robot: 0 }], 40, 0.1);
    expect(controls.at(4, true, known)).toEqual(known);
  });
  it('is the loss of that moment', () => {
    const events = [
      { kind: 'set_loss', time_s: 8, loss: 0.8 }, { kind: 'set_loss', time_s: 4, loss: 0.4 }, { kind: 'set_loss', time_s: 4, loss: 0.5 },
      { kind: 'set_loss', when: 'complete', time_s: 1, loss: 0.9 }, { kind: 'die', time_s: 5 },
    ];
    const loss = new Deeds(JSON.stringify({ radio: { loss: 0.1 }, events }));
    expect([0, 3.9, 4, 7.9, 8, 99].map((timeS) => loss.lossAt(timeS))).toEqual([0.1, 0.1, 0.5, 0.5, 0.8, 0.8]);
    for (const config of ['', '{', '{}', '{"radio":{}}']) expect(new Deeds(config).lossAt(1)).toBe(0);
  });
});

describe('names', () => {
  it('of scenarios come from an address, whatever it is', () => {
    expect(['', '#', '#rooms', '#two%20rooms', '#100%'].map((hash) => readLink(hash)?.experiment.scenario ?? '')).toEqual(['', '', 'rooms', 'two rooms', '100%']);
  });
  it('of files of runs side by side differ', () => {
    expect(apart(['a.b.toml'], ['convoy'])).toEqual(['a.b.toml']);
    expect(apart(['a.toml', 'a.toml'], ['outwards', 'convoy'])).toEqual(['a-outwards.toml', 'a-convoy.toml']);
    expect(apart(['a.mcap', 'a.mcap'], ['convoy', 'convoy'])).toEqual(['a-convoy-1.mcap', 'a-convoy-2.mcap']);
  });
});

describe('a link', () => {
  const act = (tick: number, json: string) => ({ tick, json });
  it('is read as it was written', () => {
    const experiment = {
      ...nothing, scenario: 'rooms', algorithms: ['outwards', ''], seeds: [3, 4], sets: ['radio.loss=0.3', 'name="ä & b"'],
      acts: [[act(50, '{"kind":"die","robot":4}')], [act(50, '{"kind":"die","robot":4}'), act(60, '{"kind":"set_loss","loss":0.5}')]],
      timeS: 12.3, view: { xM: 1.5, yM: -2, scale: 40 }, robot: 7,
    };
    const read = readLink(writeLink(experiment));
    expect(read?.problems).toEqual([]);
    expect(read?.experiment).toEqual(experiment);
  });
  it('has other runs beside it, each a link of its own', () => {
    const other = writeLink({ ...nothing, scenario: 'rooms', sets: ['a="b & c"'], acts: [[act(5, '{"kind":"die","robot":4}')]], beside: [] });
    const read = readLink(writeLink({ ...nothing, recording: './x.mcap', beside: [other], timeS: 3 }));
    expect(read?.problems).toEqual([]);
    expect(readLink(read!.experiment.beside[0])?.experiment).toEqual(readLink(other)?.experiment);
    expect(read?.experiment).toMatchObject({ recording: './x.mcap', timeS: 3 });
  });
  it('is the shortest that says all of the runs that are shown', () => {
    const live = (algorithm: string, seed: number | null, scenario = 'rooms'): Known =>
      ({ origin: { kind: 'live', scenario, name: scenario, text: '', algorithm, seed, sets: [] }, acts: [] });
    const look = { timeS: null, view: null, robot: null };
    const linkOf = (...runs: Known[]) => { const e = experimentOf(runs, [], look); return e === null ? null : writeLink(e); };
    expect(linkOf(live('', null))).toBe('#scenario=rooms');
    expect(linkOf(live('a', 1), live('b', 1), live('a', 2), live('b', 2))).toBe('#scenario=rooms&algorithm=a&algorithm=b&seed=1&seed=2');
    expect(linkOf(live('a', 1), live('b', 2))).toBe('#scenario=rooms&algorithm=a&seed=1&beside=scenario=rooms%26algorithm=b%26seed=2');
    expect(linkOf(live('', null, 'one'), { origin: { kind: 'recording', address: './x.mcap' }, acts: [] })).toBe('#scenario=one&beside=recording=./x.mcap');
    expect(linkOf(live('', null), { origin: { kind: 'recording', address: '' }, acts: [] })).toBeNull(); // nobody else has that file
  });
  it('carries a text of any letters', () => {
    const text = 'name = "größer ☃"\n';
    expect(readLink(writeLink({ ...nothing, name: 'a.toml', text }))?.experiment).toEqual({ ...nothing, name: 'a.toml', text });
    for (const bytes of [[], [0], [255, 254], [1, 2, 3, 4]]) expect([...fromBase64(toBase64(Uint8Array.from(bytes)))!]).toEqual(bytes);
    expect(fromBase64('a*b')).toBeNull();
  });
  it.each([
    '#scenario=rooms&seed=x', '#scenario=rooms&t=-1', '#scenario=rooms&view=1,2', '#scenario=rooms&do=5', '#text=%2A',
    '#recording=https://example.org/a.mcap', '#scenario=rooms&robot=1.5',
  ])('%s tells what is wrong in it', (hash) => expect(readLink(hash)?.problems).toHaveLength(1));
});

describe('the end of a run', () => {
  const result = { complete: 'true', completion_time_s: '11.7', time_s: '11.7', ticks: '117', robots: '18', committed: '8', broken_ticks: '0', split_ticks: '0', deaths: '0' };
  it('is told in the words of banyan run', () => {
    expect(outcomeOf(result)).toEqual({ endS: 11.7, good: true, headline: 'Complete after 11.7 s', details: ['8 of 18 robots used', 'no edge ever broken'] });
    const missed = outcomeOf({ ...result, complete: 'false', completion_time_s: '', time_s: '150', time_limit_s: '150', held_ratio: '0.667', broken_ticks: '3', ticks: '1500', deaths: '2' });
    expect(missed).toEqual({ endS: 150, good: false, headline: 'Not complete within 150.0 s', details: ['67 % of the targets held', '8 of 18 robots used', 'some edge broken 0.2 % of the time', '2 died'] });
    expect(outcomeOf({ ...result, complete: 'false', survivors: '0' })?.headline).toContain('all robots have died');
    expect(outcomeOf({})).toBeNull();
  });
  it('rounds no share to nothing or to all', () => expect([0, 0.0004, 0.012, 0.5, 0.9996, 1].map(percent)).toEqual(['0 %', 'less than 0.1 %', '1.2 %', '50 %', '99.9 %', '100 %']));
});

describe('what was done to the radio', () => {
  it('is among the events, and holds from then on', () => {
    const deeds = new Deeds(JSON.stringify({ tick_s: 0.1, events: [{ kind: 'blackout', time_s: 3, duration_s: 1 }, { kind: 'set_loss', time_s: 2, loss: 0.3 }] }));
    expect(deeds.events.map(({ tick, kind }) => [tick, kind])).toEqual([[20, 'set_loss'], [30, 'blackout']]);
    expect([2.9, 3, 3.9, 4].map((timeS) => deeds.isBlackoutAt(timeS))).toEqual([false, true, true, false]);
  });
});

describe('runs side by side', () => {
  it('are every algorithm with every seed, at most four', () => {
    expect(runsOf({ algorithms: ['a', ''], seeds: [1, 2], overrides: ['x=1'] }).map(({ overrides }) => overrides)).toEqual([
      ['x=1', 'seed=1', 'mission.algorithm=a'], ['x=1', 'seed=1'], ['x=1', 'seed=2', 'mission.algorithm=a'], ['x=1', 'seed=2'],
    ]);
    expect(runsOf({ algorithms: ['a', 'b'], seeds: [1, 2, 3], overrides: [] })).toHaveLength(4);
  });
  it('are called by what they differ in', () => {
    const run = (algorithm: string, seed: number) => ({ name: 'n', seed, settings: [{ timeS: 0, setting: { algorithm } }] }) as never;
    expect(namesOf([run('a', 1), run('b', 1)])).toEqual(['a', 'b']);
    expect(namesOf([run('a', 1), run('a', 2)])).toEqual(['seed 1', 'seed 2']);
    expect(namesOf([run('a', 1), run('a', 1)])).toEqual(['a 1', 'a 2']);
  });
});

describe('a place chosen by keys', () => {
  const cursorOf = (task: PlaceTask) => {
    const taken: unknown[] = [];
    const cursor = new PlaceCursor({ begin: () => ({ x: 1, y: 2 }), metresPerPx: () => 0.125, show: () => {}, take: (t, at, corner) => taken.push([t.kind, at, corner]) });
    cursor.start(task);
    return { cursor, taken };
  };
  it('begins in the middle, moves, and is taken', () => {
    const { cursor, taken } = cursorOf({ kind: 'add_target' });
    expect(cursor.key('Enter', false)).toBe(false); // no arrow yet: Enter is for the page
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp']) expect(cursor.key(key, false)).toBe(true);
    cursor.key('Enter', false);
    expect(taken).toEqual([['add_target', { x: 2, y: 3 }, null]]);
    expect(cursor.key('ArrowLeft', false)).toBe(false);
  });
  it('takes two corners for an area', () => {
    const { cursor, taken } = cursorOf({ kind: 'kill_area' });
    for (const key of ['ArrowRight', 'Enter', 'ArrowRight', 'Enter']) cursor.key(key, true);
    expect(taken).toEqual([['kill_area', { x: 7, y: 2 }, { x: 1, y: 2 }]]);
  });
});

describe('warnings of one kind', () => {
  it('are one, with how many there are', () => {
    const warnings = new Warnings();
    for (let k = 0; k < 116; ++k) warnings.add(`frame ${k}`, 'frames');
    warnings.add('frame 3', 'frames');
    warnings.add('another');
    expect(warnings.list()).toEqual(['frame 0 (and 115 more like it)', 'another']);
    expect(kindOf(warnings.list()[0])).toBe('frame 0');
  });
});

describe('the timeline', () => {
  it('tells the marks near the pointer, the nearest first', () => {
    const at = (time_s: number, kind = 'death') => ({ time_s, kind, text: '', tick: 0, robot: -1, target: -1 }) as RunEvent;
    const near = eventsNear([at(10), at(10.3), at(50), at(10.1, 'phase')], { startS: 0, endS: 100 }, 7 + 10.2 * 9.86, 1000);
    expect(near.map(({ time_s }) => time_s)).toEqual([10.3, 10]);
  });
});

describe('the store', () => {
  const memory = (text: string | null = null) => ({ text, getItem() { return this.text; }, setItem(_: string, value: string) { this.text = value; } });

  it('tells once, if anything changed', () => {
    const store = new Store(null);
    const told: number[] = [];
    const stop = store.subscribe((state) => told.push(state.followed ?? -1));
    store.set({ followed: 3, theme: 'dark' });
    store.set({ followed: 3 });
    store.set({ followed: null });
    stop();
    store.toggle('links');
    expect(told).toEqual([3, -1]);
    expect(store.state.switches.links).toBe(!initialState.switches.links);
  });
  it('remembers what was chosen for good', () => {
    const storage = memory();
    const store = new Store(storage);
    store.set({ theme: 'dark', selection: { kind: 'robot', index: 7 } });
    store.toggle('ids');
    expect(new Store(storage).state).toEqual({ ...initialState, theme: 'dark', switches: { ...initialState.switches, ids: true } });
  });
  it.each(['nonsense', 'null', '[]', '{"theme":"pink","switches":{"ids":1,"more":true},"selection":4,"__proto__":{"ids":true}}'])('survives %s', (text) => {
    expect(new Store(memory(text)).state).toEqual(initialState);
  });
  it('lives without storage that works', () => {
    const broken = { getItem: () => { throw new Error('forbidden'); }, setItem: () => { throw new Error('full'); } };
    const store = new Store(broken);
    store.set({ theme: 'light' } satisfies Partial<State>);
    expect(store.state.theme).toBe('light');
  });
});

describe('the numbers of a robot over time', () => {
  /** Robot i has depth i + tick; a source hands out at most `most` frames at a time. */
  const source = (most = Infinity) => {
    const asked: [number, number][] = [];
    return {
      asked, tickS: 0.1, depthOf: (robot: number, tick: number) => robot + tick,
      /** Robot i says 10 i + tick at every other tick, and a role by its name. */
      async messages(robot: number, fromS: number, toS: number) {
        const ticks = Array.from({ length: 100 }, (_, tick) => tick).filter((tick) => tick % 2 === 0 && tick * 0.1 >= fromS - 1e-6 && tick * 0.1 <= toS + 1e-6);
        return ticks.map((tick) => ({ timeS: tick * 0.1, fields: { news: 10 * robot + tick, role: 'worker', words: 'none' } }));
      },
      async frames(fromS: number, toS: number) {
        asked.push([fromS, toS]);
        const first = Math.max(0, Math.ceil(fromS / 0.1 - 1e-6) - 1); // and the one before
        const ticks = Array.from({ length: Math.floor(toS / 0.1 + 1e-6) - first + 1 }, (_, k) => first + k).slice(0, most);
        return ticks.map((tick) => ({ ...frameOf({ x_m: [0, 1], depth: [this.depthOf(0, tick), this.depthOf(1, tick)], parent: [-1, 0] }, tick), timeS: tick * 0.1 }));
      },
    };
  };
  const gathered = async (series: RobotSeries, robot: number, toS: number) => { while (await series.gather(robot, toS)); return series.value; };

  it('come piece by piece, each once, and none for what is not', async () => {
    const from = source(4);
    const series = new RobotSeries(from);
    const { time_s: times, depth, parent } = await gathered(series, 1, 1);
    expect([...times].map((t) => Math.round(10 * t))).toEqual([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    expect([...depth]).toEqual([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11]);
    expect([...parent]).toEqual(Array(11).fill(0));
    expect([...(await gathered(series, 0, 0.2)).parent]).toEqual([NaN, NaN, NaN]); // another robot, and none is its parent
    const before = from.asked.length;
    await gathered(series, 0, 0.2);
    expect(from.asked.length).toBe(before);
  });

  it('have beside them what it said, if that is wanted', async () => {
    const series = new RobotSeries(source(4));
    expect(Object.keys(await gathered(series, 1, 0.5))).not.toContain('says news');
    while (await series.gather(1, 0.5, true));
    expect([...series.value['says news']]).toEqual([10, NaN, 12, NaN, 14, NaN]);
    expect([...series.value['says role']]).toEqual([2, NaN, 2, NaN, 2, NaN]);
    series.cut(0.2);
    expect([...series.value['says news']]).toEqual([10, NaN, 12]);
    series.know({ news: 3, need: 'await', words: 'none', on: true });
    expect(series.fields).toEqual(['news', 'need', 'on']); // what is no number cannot be plotted
  });

  it('are forgotten where the run was changed, also while they are on their way', async () => {
    const from = source();
    const series = new RobotSeries(from);
    await gathered(series, 1, 1);
    from.depthOf = () => 77;
    series.cut(0.5);
    expect([...(await gathered(series, 1, 0.7)).depth]).toEqual([1, 2, 3, 4, 5, 6, 77, 77]);
    const late = series.gather(1, 1);
    series.cut(0.2);
    expect(await late).toBe(false);
    expect(series.value.time_s).toHaveLength(3);
  });
});
