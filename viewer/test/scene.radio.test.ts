// SPDX-License-Identifier: MIT
// How many radio links are drawn, of how many that are in sight: what the caption says.
import { describe, expect, it } from 'vitest';
import { Facts } from '../src/scene/facts';
import { drawRadio } from '../src/scene/layers/radio';
import { Shot } from '../src/scene/shot';
import { light } from '../src/scene/themes';
import { defaultSwitches } from '../src/scene/view';
import { frameOf, settingOf } from './scene_frames';

// Ten robots on a line, 1 m apart; each hears the next one only.
const places = Array.from({ length: 10 }, (_, k) => k);
const frame = frameOf({ x_m: places, y_m: places.map(() => 0) });
const setting = settingOf({ range_m: 1.5 });

const pen = new Proxy({}, { get: () => () => {}, set: () => true }) as CanvasRenderingContext2D;

/** Of a window so many metres wide around the middle of the line, with all numbers of links allowed. */
function count(widthM: number, linkBudget = Infinity) {
  const shot = new Shot();
  const camera = { xM: 4.5, yM: 0, scale: 100, widthPx: 100 * widthM, heightPx: 100 };
  const view = {
    frame, setting, camera, trails: [], selection: null, hovered: null, theme: light, switches: { ...defaultSwitches, links: true },
  };
  shot.take(pen, 1, view, new Facts(frame, setting));
  shot.linkBudget = linkBudget;
  return drawRadio(shot);
}

describe('radio links', () => {
  it('are all drawn while there are few', () => expect(count(20)).toEqual({ drawn: 9, all: 9, about: false }));
  it('that are out of sight are not missing', () => expect(count(2)).toEqual({ drawn: 3, all: 3, about: false }));
  it('are fewer than those in sight when the longest are left out', () => {
    const { drawn, all } = count(20, 4);
    expect(all).toBe(9);
    expect(drawn).toBeLessThan(9);
  });

  // A hexagonal lattice of 3,600 with some that are dead.
  const many = 3600;
  const lattice = frameOf({
    x_m: Array.from({ length: many }, (_, k) => (k % 60) + ((Math.floor(k / 60) & 1) / 2) + 0.02 * Math.sin(k)),
    y_m: Array.from({ length: many }, (_, k) => 0.87 * Math.floor(k / 60) + 0.02 * Math.cos(7 * k)),
    alive: Array.from({ length: many }, (_, k) => (k % 97 === 0 ? 0 : 1)),
  });
  const radio = new Facts(lattice, settingOf({ range_m: 4, line_of_sight: false })).radio;
  const all = radio.links().open;
  const pairsOf = (links: Int32Array) => new Set(Array.from({ length: links.length / 2 }, (_, k) => [links[2 * k], links[2 * k + 1]].sort((a, b) => a! - b!).join()));
  const lengthOf = (i: number, j: number) => Math.hypot(lattice.data[i]! - lattice.data[j]!, lattice.data[many + i]! - lattice.data[many + j]!);

  it('of a crowd are those of all that are short enough and in sight', () => {
    const seen = Uint8Array.from({ length: many }, (_, k) => (k % 60 < 30 ? 1 : 0));
    const wanted = [...pairsOf(all)].filter((pair) => {
      const [i, j] = pair.split(',').map(Number) as [number, number];
      return lengthOf(i, j) <= 1.5 && (seen[i] === 1 || seen[j] === 1);
    });
    expect(pairsOf(radio.linksWithin(1.5, seen).open)).toEqual(new Set(wanted));
  });
  it('of a crowd are counted within a tenth, and the length fits the number asked for', () => {
    const seen = new Uint8Array(many).fill(1);
    const { lengthM, pairs } = radio.lengthFor(12000, seen);
    expect(Math.abs(pairs / (all.length / 2) - 1)).toBeLessThan(0.1);
    const found = radio.linksWithin(lengthM, seen).open.length / 2;
    expect(found).toBeLessThan(14000);
    expect(found).toBeGreaterThan(6000);
    expect(radio.lengthFor(1e9, seen).lengthM).toBe(4);
  });
});
