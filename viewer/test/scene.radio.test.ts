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
  it('are all drawn while there are few', () => expect(count(20)).toEqual({ drawn: 9, all: 9 }));
  it('that are out of sight are not missing', () => expect(count(2)).toEqual({ drawn: 3, all: 3 }));
  it('are fewer than those in sight when the longest are left out', () => {
    const { drawn, all } = count(20, 4);
    expect(all).toBe(9);
    expect(drawn).toBeLessThan(9);
  });
});
