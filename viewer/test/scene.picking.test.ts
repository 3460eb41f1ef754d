// SPDX-License-Identifier: MIT
// What is under the pointer, how far a run reaches, and that what is written can be read.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { boundsOf } from '../src/scene/bounds';
import { toPx, type Camera } from '../src/scene/camera';
import { clearance, gripAt, itemAt, robotsIn, touchReachPx } from '../src/scene/picking';
import { contrast, dark, light } from '../src/scene/themes';
import { frameOf, settingOf } from './scene_frames';

const camera: Camera = { xM: 0, yM: 0, scale: 100, widthPx: 800, heightPx: 600 };
const frame = {
  ...frameOf({ x_m: [0, 0.2, 2], y_m: [0, 0, 1], alive: [1, 1, 0] }),
  targets: { x: Float64Array.of(1.5, 2), y: Float64Array.of(0, 1.1), worker: Int32Array.of(0, 1) },
};
const setting = settingOf({
  obstacles: [
    { disc: true, center_m: [-1, 0], radius_m: 0.5 },
    { box: true, center_m: [0, -1.5], size_m: [1, 0.2], angle_rad: Math.PI / 4 },
    { wall: true, from_m: [-2, 1], to_m: [0, 1] },
  ],
});
const at = (x: number, y: number, reach?: number) => itemAt(frame, setting, camera, toPx(camera, { x, y }), reach);

describe('picking', () => {
  it('takes the nearest robot', () => {
    expect(at(0.05, 0.02)).toEqual({ kind: 'robot', index: 0 });
    expect(at(0.14, 0)).toEqual({ kind: 'robot', index: 1 });
  });
  it('prefers a robot, dead ones too, to the target it stands on', () => {
    expect(at(2, 1.03)).toEqual({ kind: 'robot', index: 2 });
    expect(at(2, 1.25)).toEqual({ kind: 'target', index: 1 });
  });
  it('grips a target under the robot that stands on it, and no robot', () => {
    const grip = (x: number, y: number) => gripAt(frame, setting, camera, toPx(camera, { x, y }));
    expect(grip(2, 1.03)).toEqual({ kind: 'target', index: 1 });
    expect(grip(0.05, 0.02)).toBeNull();
    expect(grip(-1.3, 0.2)).toEqual({ kind: 'obstacle', index: 0 });
  });
  it('finds obstacles, and walls beside their line', () => {
    expect(at(-1.3, 0.2)).toEqual({ kind: 'obstacle', index: 0 });
    expect(at(0.3, -1.2)).toEqual({ kind: 'obstacle', index: 1 });
    expect(at(0.3, -1.75)).toBeNull();
    expect(at(-1, 1.05)).toEqual({ kind: 'obstacle', index: 2 });
  });
  it('gives a finger more room', () => {
    expect(at(0, 0.2)).toBeNull();
    expect(at(0, 0.2, touchReachPx)).toEqual({ kind: 'robot', index: 0 });
  });
  it('keeps small robots within reach from afar', () => {
    const far = { ...camera, scale: 2 };
    expect(itemAt(frame, setting, far, { x: 400 - 8, y: 300 })).toEqual({ kind: 'robot', index: 0 });
  });
  it('measures to the surface', () => {
    expect(clearance(setting.obstacles[0]!, { x: -1, y: 0 })).toBeCloseTo(-0.5, 12);
    expect(clearance(setting.obstacles[2]!, { x: 1, y: 1 })).toBeCloseTo(1, 12);
    expect(clearance({ box: true, center_m: [0, 0], size_m: [2, 2], angle_rad: 0 }, { x: 2, y: 2 })).toBeCloseTo(Math.SQRT2, 12);
  });
  it('finds the living in a rectangle', () => {
    expect(robotsIn(frame, { minX: -1, minY: -1, maxX: 5, maxY: 5 })).toEqual([0, 1]);
  });
});

describe('bounds', () => {
  it('hold robots, targets and obstacles', () => {
    const b = boundsOf(setting, frame);
    expect(b.minX).toBe(-2);
    expect(b.maxX).toBeCloseTo(2.2, 9);
    expect(b.maxY).toBeCloseTo(1.3, 9);
    expect(b.minY).toBeCloseTo(-1.5 - 0.6 * Math.SQRT2 / 1, 0);
  });
  it('are as wide as the radio reaches, whatever that is', () => {
    for (const range_m of [0.1, 2, 1000])
      expect(boundsOf(settingOf({ range_m, radius_m: 0 }), frameOf({ x_m: [0], y_m: [0] })))
        .toEqual({ minX: -range_m / 2, minY: -range_m / 2, maxX: range_m / 2, maxY: range_m / 2 });
  });
  it('are never empty, and leave out what cannot be', () => {
    expect(boundsOf(settingOf(), frameOf({}))).toEqual({ minX: -1, minY: -1, maxX: 1, maxY: 1 });
    expect(boundsOf(settingOf({ radius_m: 0 }), frameOf({ x_m: [1, NaN, 1e9], y_m: [1, 1, 1] }))).toEqual({ minX: 0, minY: 0, maxX: 2, maxY: 2 });
  });
});

describe('themes', () => {
  for (const theme of [light, dark]) {
    it(`${theme.name}: text reaches WCAG AA, marks 3:1`, () => {
      for (const text of [theme.text, theme.quietText, theme.targetText]) expect(contrast(text, theme.background)).toBeGreaterThanOrEqual(4.5);
      const [spare, ...others] = theme.roles;
      for (const mark of [...others, theme.dead, theme.tree, theme.broken, theme.accent, theme.dot]) {
        expect(contrast(mark, theme.background), mark).toBeGreaterThanOrEqual(3);
      }
      // Yellow on white lives from its outline.
      expect(Math.max(contrast(spare, theme.background), contrast(theme.outline, theme.background))).toBeGreaterThanOrEqual(3);
    });
    it(`${theme.name}: roles are those of record/palette.hpp`, () => expect(theme.roles).toEqual(['#f0e442', '#009e73', '#0072b2', '#d55e00']));
    // What `banyan draw` and `banyan film` use, member by member: names are those of the C++ struct.
    it(`${theme.name}: is the theme of the program's pictures`, () => {
      const palette = readFileSync(new URL('../../record/include/banyan/record/palette.hpp', import.meta.url), 'utf8');
      const colour = (name: string) => new RegExp(`\\bColor ${name}\\{.*"(#[0-9a-f]{6})"`).exec(palette)?.[1];
      const members = new RegExp(`Theme ${theme.name}\\{([^}]*)\\}`).exec(palette)?.[1] ?? '';
      const of = (name: string) => {
        const value = new RegExp(`\\.${name} = ([^,}]+)`).exec(members)?.[1]?.trim() ?? '';
        return value.startsWith('"') ? value.slice(1, -1) : colour(value.replace('.hex', ''));
      };
      const { background, text, quietText, outline, dead, target, targetText, tree, oldTree, broken, link, blocked, obstacle, spareTrail } = theme;
      expect([background, text, quietText, outline, dead, target, targetText, tree, oldTree, broken, link, blocked, obstacle, spareTrail]).toEqual(
        ['paper', 'ink', 'faint_ink', 'outline', 'dead', 'target', 'target_ink', 'tree', 'old_tree', 'broken', 'link', 'blocked', 'obstacle', 'spare_trail'].map(of));
    });
  }
  it('know black from white', () => expect(contrast('#000000', '#ffffff')).toBeCloseTo(21, 9));
});
