// SPDX-License-Identifier: MIT
// Runs in the browser for scene.mjs: draws one layout with one renderer for a while and counts.
import { layouts, madeUpFrame, moved, type Layout } from './swarm';
import { canvasRenderer, pixiRenderer, type Renderer } from './renderers';

export interface Count {
  about: string;
  links: number;
  /** Pictures that were shown per second, at most the display's 60. */
  fps: number;
  /** Median and 95th percentile of the time to draw one picture until its pixels are there. */
  medianMs: number;
  p95Ms: number;
}

function allLinks(layout: Layout): Int32Array {
  const f = madeUpFrame(layout.robots, layout.pitchM);
  const pairs: number[] = [];
  for (let i = 0; i < f.robots; ++i) {
    for (let j = i + 1; j < f.robots; ++j) {
      if (Math.hypot(f.data[i]! - f.data[j]!, f.data[f.robots + i]! - f.data[f.robots + j]!) < 2) pairs.push(i, j);
    }
  }
  return Int32Array.from(pairs);
}

const nextFrame = () => new Promise<number>((resolve) => requestAnimationFrame(resolve));

async function shownPerSecond(seconds: number, draw: (timeS: number) => void): Promise<number> {
  for (let k = 0; k < 5; ++k) draw((await nextFrame()) / 1000);
  const start = await nextFrame();
  let now = start;
  let shown = 0;
  while (now - start < 1000 * seconds) {
    draw(now / 1000);
    now = await nextFrame();
    ++shown;
  }
  return (1000 * shown) / (now - start);
}

async function times(draw: (timeS: number) => void, finish: () => void): Promise<number[]> {
  const ms: number[] = [];
  for (let k = 0; k < 40; ++k) {
    await nextFrame();
    const start = performance.now();
    draw(start / 1000);
    finish();
    ms.push(performance.now() - start);
  }
  return ms.sort((a, b) => a - b);
}

async function measure(name: 'canvas' | 'pixi' | 'scene', index: number, seconds: number): Promise<Count> {
  const layout = layouts[index]!;
  document.body.innerHTML = '<canvas width="1280" height="720" style="position:absolute;left:0;top:0"></canvas>';
  const canvas = document.querySelector('canvas')!;
  const still = madeUpFrame(layout.robots, layout.pitchM);
  const frame = { ...still, data: still.data.slice() };
  const renderer: Renderer = name === 'pixi' ? await pixiRenderer(canvas, (window as unknown as { PIXI: typeof import('pixi.js') }).PIXI) : canvasRenderer(canvas);
  const links = allLinks(layout);
  const reach = Math.abs(still.targets.y[1]!) + Math.abs(still.targets.x[0]!);
  const scale = 680 / Math.max(2, 2 * reach);
  const draw = (timeS: number) => { moved(still, timeS, frame); renderer.draw(frame, links, scale); };
  const fps = await shownPerSecond(seconds, draw);
  const ms = await times(draw, renderer.finish);
  return { about: renderer.about, links: links.length / 2, fps, medianMs: ms[20]!, p95Ms: ms[38]! };
}

Object.assign(window, { measure, layouts });
