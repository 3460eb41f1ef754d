// SPDX-License-Identifier: MIT
import { describe, expect, it } from 'vitest';
import { Horizon } from '../src/state/horizon';

const series = { time_s: Float64Array.of(0, 1, 2, 3), committed: Float64Array.of(4, 5, 6, 7) };
const events = [0.5, 1.5, 2.5].map((time_s) => ({ tick: 0, time_s, kind: 'root', robot: 0, target: -1, text: '' }));

describe('the horizon', () => {
  it('of a recording is beyond everything', () => {
    const horizon = new Horizon();
    horizon.open(false);
    expect(horizon.see(2)).toBe(false);
    expect(horizon.rows(series)).toBe(series);
    expect(horizon.events(events)).toEqual(events);
  });
  it('of a live run is what was shown, also after going back to look', () => {
    const horizon = new Horizon();
    horizon.open(true);
    expect([...horizon.rows(series).committed]).toEqual([4]);
    expect(horizon.see(2)).toBe(true);
    horizon.see(1);
    expect([...horizon.rows(series).committed]).toEqual([4, 5, 6]);
    expect(horizon.events(events)).toHaveLength(2);
  });
  it('asks for new plots only twice a second of the run', () => {
    const horizon = new Horizon();
    horizon.open(true);
    const asked = Array.from({ length: 40 }, (_, k) => (k + 1) / 20).filter((timeS) => {
      const due = horizon.see(timeS);
      if (due) horizon.tell();
      return due;
    });
    expect(asked).toEqual([0.5, 1, 1.5, 2]);
  });
  it('knows whether plots and lists are behind', () => {
    const horizon = new Horizon();
    horizon.open(true);
    expect(horizon.behind).toBe(false);
    expect(horizon.see(0.1)).toBe(false);
    expect(horizon.behind).toBe(true);
    horizon.tell();
    expect(horizon.behind).toBe(false);
  });
  it('comes back when somebody interferes', () => {
    const horizon = new Horizon();
    horizon.open(true);
    horizon.see(3);
    horizon.tell();
    horizon.cut(1);
    expect([...horizon.rows(series).time_s]).toEqual([0, 1]);
    expect(horizon.see(1.5)).toBe(true);
  });
});
