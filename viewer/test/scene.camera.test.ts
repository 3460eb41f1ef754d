// SPDX-License-Identifier: MIT
// The camera: what is where, and what stays where it is.
import { describe, expect, it } from 'vitest';
import * as c from '../src/scene/camera';

const camera: c.Camera = { xM: 3, yM: -2, scale: 50, widthPx: 800, heightPx: 600 };
const near = (a: c.Spot, b: c.Spot) => { expect(a.x).toBeCloseTo(b.x, 9); expect(a.y).toBeCloseTo(b.y, 9); };

describe('camera', () => {
  it('has its point in the middle, and y upwards', () => {
    near(c.toPx(camera, { x: 3, y: -2 }), { x: 400, y: 300 });
    near(c.toPx(camera, { x: 4, y: -1 }), { x: 450, y: 250 });
  });

  it('finds back from pixels', () => near(c.toWorld(camera, c.toPx(camera, { x: -7.25, y: 0.125 })), { x: -7.25, y: 0.125 }));

  it('keeps what is under the pointer there when it zooms', () => {
    const pointer = { x: 123, y: 456 };
    const under = c.toWorld(camera, pointer);
    for (const factor of [0.2, 0.999, 3]) near(c.toWorld(c.zoomedAt(camera, factor, pointer), pointer), under);
  });

  it('neither comes nor goes too far, and then does not drift', () => {
    const pointer = { x: 10, y: 10 };
    const close = c.zoomedAt(camera, 1e9, pointer);
    expect(close.scale).toBe(c.largestScale);
    near(c.toWorld(c.zoomedAt(close, 2, pointer), pointer), c.toWorld(camera, pointer));
    expect(c.zoomedAt(camera, 1e-9, pointer).scale).toBe(c.smallestScale);
  });

  it('pans with the pointer', () => {
    const under = c.toWorld(camera, { x: 100, y: 100 });
    near(c.toWorld(c.panned(camera, 30, -20), { x: 130, y: 80 }), under);
  });

  it('fits bounds between margins and panels', () => {
    const bounds = { minX: -9, minY: -3, maxX: 11, maxY: 4 };
    const insets = { top: 50, right: 200, bottom: 120, left: 0 };
    const fit = c.fitted(bounds, 1280, 720, 20, insets);
    const low = c.toPx(fit, { x: -9, y: -3 });
    const high = c.toPx(fit, { x: 11, y: 4 });
    expect(low.x).toBeCloseTo(20, 6);
    expect(high.x).toBeCloseTo(1280 - 200 - 20, 6);
    expect((low.y + high.y) / 2).toBeCloseTo((50 + 720 - 120) / 2, 6);
    expect(high.y).toBeGreaterThanOrEqual(70);
  });

  it('fits a single point and a window without room', () => {
    expect(c.fitted({ minX: 1, minY: 1, maxX: 1, maxY: 1 }, 400, 400).scale).toBe(c.largestScale);
    expect(c.fitted({ minX: 0, minY: 0, maxX: 5, maxY: 5 }, 10, 10).scale).toBeGreaterThan(0);
  });

  it('follows, at once or by and by', () => {
    near(c.toPx(c.following(camera, { x: 8, y: 8 }), { x: 8, y: 8 }), { x: 400, y: 300 });
    expect(c.followShare(0.12)).toBeCloseTo(0.5, 12);
    // Two short frames bring it as far as one long one.
    const twice = 1 - (1 - c.followShare(0.05)) ** 2;
    expect(twice).toBeCloseTo(c.followShare(0.1), 12);
  });

  it('keeps its middle when the window changes', () => {
    near(c.toPx(c.resized(camera, 400, 1000), { x: 3, y: -2 }), { x: 200, y: 500 });
  });

  it('sees what its corners see', () => {
    const s = c.seen(camera);
    near({ x: s.minX, y: s.maxY }, c.toWorld(camera, { x: 0, y: 0 }));
    near({ x: s.maxX, y: s.minY }, c.toWorld(camera, { x: 800, y: 600 }));
  });

  it('knows round lengths', () => {
    expect([0.999, 1, 1.99, 2, 4.99, 5, 9.9, 10, 1000, 0.03].map(c.niceLength).map((v) => Number(v.toPrecision(6))))
      .toEqual([0.5, 1, 1, 2, 2, 5, 5, 10, 1000, 0.02]);
  });
});
