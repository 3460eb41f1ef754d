// SPDX-License-Identifier: MIT
// Interpolation, jumps between events, live controls, names, the page's state.
import { describe, expect, it } from 'vitest';
import { column, type RunEvent } from '../src/frame';
import { apart, nameIn } from '../src/files';
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
    expect(['', '#', '#rooms', '#two%20rooms', '#100%'].map(nameIn)).toEqual(['', '', 'rooms', 'two rooms', '100%']);
  });
  it('of files of runs side by side differ', () => {
    expect(apart(['a.b.toml'], ['convoy'])).toEqual(['a.b.toml']);
    expect(apart(['a.toml', 'a.toml'], ['outwards', 'convoy'])).toEqual(['a-outwards.toml', 'a-convoy.toml']);
    expect(apart(['a.mcap', 'a.mcap'], ['convoy', 'convoy'])).toEqual(['a-convoy-1.mcap', 'a-convoy-2.mcap']);
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
