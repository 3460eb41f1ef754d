// SPDX-License-Identifier: MIT
// Rings of charge, by what a pen that writes SVG is made to draw.
import { describe, expect, it } from 'vitest';
import { Facts } from '../src/scene/facts';
import { drawCharge } from '../src/scene/layers/charge';
import { Shot } from '../src/scene/shot';
import { SvgPen } from '../src/scene/svg_pen';
import { themes } from '../src/scene/themes';
import { defaultSwitches } from '../src/scene/view';
import { frameOf, settingOf } from './scene_frames';

function drawn(spent: readonly number[], more: Record<string, readonly number[]> = {}): string {
  const frame = frameOf({ x_m: spent.map((_, i) => i - 1), y_m: spent.map(() => 0), spent, ...more });
  const setting = settingOf({ radius_m: 0.1 });
  const pen = new SvgPen();
  const shot = new Shot();
  shot.take(pen as unknown as CanvasRenderingContext2D, 1, {
    frame, setting, trails: [], selection: null, hovered: null, switches: defaultSwitches, theme: themes.light,
    camera: { xM: 0, yM: 0, scale: 100, widthPx: 800, heightPx: 600 },
  }, new Facts(frame, setting));
  drawCharge(shot);
  return pen.content;
}

/** The share of a circle that an arc is, from its ends about the robot's place. */
function shares(svg: string, color: string): number[] {
  const path = svg.split('\n').find((line) => line.startsWith('<path') && line.includes(`stroke="${color}"`)) ?? '';
  return [...path.matchAll(/M(\S+) (\S+?)A(\S+) \S+ 0 (\d) 1 (\S+) (\S+?)(?=M|")/g)].map(([, x, y, r, large, toX, toY]) => {
    const [dx, dy] = [Number(toX) - Number(x), Number(toY) - Number(y) - Number(r)]; // the middle is below the beginning
    const turn = (Math.atan2(dx, -dy) / (2 * Math.PI) + 1) % 1;
    expect(turn > 0.5, 'the long way round').toBe(large === '1');
    return turn;
  });
}

describe('rings of charge', () => {
  it('are not there without batteries', () => {
    expect(drawn([0, 0, 0])).toBe('');
  });

  it('are as long as the charge, of another colour where it is little', () => {
    const svg = drawn([0.25, 0.6, 0.9]);
    const [enough, low] = [shares(svg, themes.light.heading), shares(svg, themes.light.roles[3])];
    expect(enough.length).toBe(2);
    expect(enough[0]).toBeCloseTo(0.75, 2);
    expect(enough[1]).toBeCloseTo(0.4, 2);
    expect(low.length).toBe(1);
    expect(low[0]).toBeCloseTo(0.1, 2);
    expect(svg.match(/<circle/g)?.length).toBe(3); // all of the ring, faintly
  });

  it('are whole where a robot is full, and not round the dead', () => {
    const svg = drawn([0, 0.5, 0.5], { alive: [1, 1, 0] });
    expect(svg.match(/<circle/g)?.length).toBe(3);
    expect(shares(svg, themes.light.heading).length).toBe(1);
  });
});
