// SPDX-License-Identifier: MIT
// The cells of a map, as the program writes them and as it looks past them.
import { describe, expect, it } from 'vitest';
import { Cells } from '../src/cells';
import type { Obstacle } from '../src/frame';
import { boundsOf } from '../src/scene/bounds';
import { clearance } from '../src/scene/picking';
import { blocks } from '../src/scene/sight';
import { parseSetting } from '../src/source/setting';
import { dice, frameOf, settingOf } from './scene_frames';

const room = '6#\n2*#4.#\n#..###\n6#';

function occupied(cells: Cells): string[] {
  return Array.from({ length: cells.rows }, (_, k) => Array.from({ length: cells.columns },
    (_, i) => (cells.reach(i, cells.rows - 1 - k) === 0 ? '#' : '.')).join(''));
}

describe('cells', () => {
  it('come from their text', () => {
    expect(occupied(Cells.parse(room)!)).toEqual(['######', '#....#', '#....#', '#..###', '######']);
    for (const wrong of ['', '##\n#', '#x', '0*#', '##3', '99999999*9.', '2*']) expect(Cells.parse(wrong), wrong).toBeNull();
  });

  it('are what their rectangles cover, once', () => {
    const cells = Cells.parse(room)!;
    const covered = Array.from({ length: cells.rows }, () => new Array<number>(cells.columns).fill(0));
    for (const b of cells.blocks()) for (let y = b.bottom; y < b.top; ++y) for (let x = b.left; x < b.right; ++x) ++covered[y]![x]!;
    expect(covered.reverse().map((row) => row.map((n) => (n === 1 ? '#' : n === 0 ? '.' : '?')).join(''))).toEqual(occupied(cells));
  });

  it('hide what the boxes of the same cells hide', () => {
    const roll = dice(4);
    let hidden = 0;
    for (let trial = 0; trial < 300; ++trial) {
      const text = Array.from({ length: 6 }, () => Array.from({ length: 8 }, () => (roll() < 0.12 ? '#' : '.')).join('')).join('\n');
      const cells = Cells.parse(text)!;
      const angle_rad = trial % 2 === 0 ? 0 : 0.6;
      const map: Obstacle = { map: true, origin_m: [1, -2], resolution_m: 0.5, angle_rad, cells };
      const c = Math.cos(angle_rad), s = Math.sin(angle_rad);
      const boxes: Obstacle[] = cells.blocks().map((b) => {
        const x = (b.left + b.right) / 4, y = (b.bottom + b.top) / 4;
        return { box: true, center_m: [1 + c * x - s * y, -2 + s * x + c * y],
          size_m: [(b.right - b.left) / 2, (b.top - b.bottom) / 2], angle_rad };
      });
      for (let k = 0; k < 30; ++k) {
        const [ax, ay, bx, by] = [roll() * 6, roll() * 6 - 2.5, roll() * 6, roll() * 6 - 2.5];
        const expected = boxes.some((box) => blocks(box, ax, ay, bx, by));
        expect(blocks(map, ax, ay, bx, by)).toBe(expected);
        expect(blocks(map, bx, by, ax, ay)).toBe(expected);
        hidden += expected ? 1 : 0;
      }
    }
    expect(hidden).toBeGreaterThan(1000);
  });

  it('let a line pass along an edge, but not within a wall or between two that touch', () => {
    const wall: Obstacle = { map: true, origin_m: [0, 0], resolution_m: 1, angle_rad: 0, cells: Cells.parse('....\n.##.\n.##.\n....')! };
    expect(blocks(wall, 0, 3, 4, 3)).toBe(false);
    expect(blocks(wall, 0, 2, 4, 2)).toBe(true);
    expect(blocks(wall, 2, 0, 2, 4)).toBe(true);
    const diagonal: Obstacle = { map: true, origin_m: [0, 0], resolution_m: 1, angle_rad: 0, cells: Cells.parse('.#\n#.')! };
    expect(blocks(diagonal, 0.5, 1.5, 1.5, 0.5)).toBe(true);
  });
});

describe('a map', () => {
  const text = JSON.stringify({
    ...settingOf(), obstacles: [{ map: true, origin_m: [1, 2], resolution_m: 0.5, angle_rad: 0, cells: room }],
  });

  it('is read from a setting, is part of what is shown, and is not picked', () => {
    const warnings: string[] = [];
    const setting = parseSetting(text, (warning) => warnings.push(warning));
    expect(setting.obstacles).toHaveLength(1);
    expect(boundsOf(setting, frameOf({}))).toEqual({ minX: 1, minY: 2, maxX: 4, maxY: 4.5 });
    expect(clearance(setting.obstacles[0]!, { x: 1.1, y: 2.1 })).toBe(Infinity);
    parseSetting(text.replace('6#', '7#'), (warning) => warnings.push(warning));
    expect(warnings.some((warning) => warning.includes('cells'))).toBe(true);
  });
});
