// SPDX-License-Identifier: MIT
// Dots as pixels: as much ink as their area, in their place and colour.
import { describe, expect, it } from 'vitest';
import { DotBitmap } from '../src/scene/dots';
import { random } from './support';

function drawn(add: (bitmap: DotBitmap) => void, width = 40, height = 30) {
  const bitmap = new DotBitmap();
  bitmap.clear(width, height, '#102030');
  add(bitmap);
  let ink = 0, x = 0, y = 0;
  bitmap.words.forEach((word, at) => {
    const alpha = (word >>> 24) / 255;
    ink += alpha;
    x += alpha * ((at % width) + 0.5);
    y += alpha * (Math.floor(at / width) + 0.5);
  });
  return { ink, x: x / ink, y: y / ink, words: bitmap.words };
}

describe('dots', () => {
  it('have their area, middle and colour wherever they are', () => {
    const next = random(5);
    for (let k = 0; k < 200; ++k) {
      const x = 5 + 30 * next(), y = 5 + 20 * next(), side = 1.5 + 4 * next();
      const dot = drawn((bitmap) => bitmap.add(x, y, side));
      expect(Math.abs(dot.ink - side * side)).toBeLessThan(0.15);
      expect(Math.hypot(dot.x - x, dot.y - y)).toBeLessThan(0.15);
      for (const word of dot.words) if (word !== 0) expect(word & 0xffffff).toBe(0x302010);
    }
  });

  it('are cut at the edges and lie over each other', () => {
    expect(drawn((bitmap) => bitmap.add(0, 0, 4)).ink).toBeCloseTo(4);
    expect(drawn((bitmap) => bitmap.add(40, 30, 4)).ink).toBeCloseTo(4);
    expect(drawn((bitmap) => { bitmap.add(-50, 10, 4); bitmap.add(10, 500, 4); }).ink).toBe(0);
    expect(drawn((bitmap) => { bitmap.add(10, 10, 4); bitmap.add(10, 10, 4); bitmap.add(11, 10, 4); }).ink).toBeCloseTo(20);
  });
});
