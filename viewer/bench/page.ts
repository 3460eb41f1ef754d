// SPDX-License-Identifier: MIT
// Runs in the browser for scene.mjs: draws one layout with one renderer for a while and counts.
import { layouts, madeUpFrame, moved, type Layout } from './swarm';
import { canvasRenderer, pixiRenderer, type Renderer } from './renderers';
import { boundsOf } from '../src/scene/bounds';
import { fitted, panned } from '../src/scene/camera';
import { Scene } from '../src/scene/picture';
import { themes } from '../src/scene/themes';
import { defaultSwitches } from '../src/scene/view';
import type { Frame } from '../src/frame';
import { madeUpSetting } from './swarm';

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

/** What draws a frame at a time, until the pixels are there. */
interface Drawing { about: string; links: number; draw(timeS: number): void; finish(): void }

async function plainDrawing(name: 'canvas' | 'pixi' | 'jagged', layout: Layout, still: Frame): Promise<Drawing> {
  document.body.innerHTML = '<canvas width="1280" height="720" style="position:absolute;left:0;top:0"></canvas>';
  const canvas = document.querySelector('canvas')!;
  const renderer: Renderer = name === 'canvas' ? canvasRenderer(canvas)
    : await pixiRenderer(canvas, (window as unknown as { PIXI: typeof import('pixi.js') }).PIXI, name === 'pixi');
  const links = allLinks(layout);
  const frame = { ...still, data: still.data.slice() };
  const reach = Math.abs(still.targets.y[1]!) + Math.abs(still.targets.x[0]!);
  const draw = (timeS: number) => { moved(still, timeS, frame); renderer.draw(frame, links, 680 / Math.max(2, 2 * reach)); };
  return { about: renderer.about, links: links.length / 2, draw, finish: renderer.finish };
}

/** The page's scene as a recording is played: ten ticks a second, each with links and edges anew; trails of ten points,
 *  a selection, ids up to 500 robots. `panning`: the camera moves with every picture. */
function sceneDrawing(still: Frame, lineOfSight: boolean, panning: boolean): Drawing {
  document.body.innerHTML = '<div style="position:fixed;inset:0"></div>';
  const scene = new Scene(document.querySelector('div')!, themes.light);
  const frame = { ...still, data: still.data.slice() };
  const setting = madeUpSetting(lineOfSight);
  const fit = fitted(boundsOf(setting, still), scene.widthPx, scene.heightPx);
  const trails = Array.from({ length: 10 }, (_, k) => { const f = { ...still, data: still.data.slice() }; moved(still, -0.5 * (10 - k), f); return f; });
  const switches = { ...defaultSwitches, blocked: lineOfSight, ids: still.robots < 500 };
  const selection = { kind: 'robot' as const, index: still.robots - 1 };
  const pen = scene.canvas.getContext('2d')!;
  const draw = (timeS: number) => {
    moved(still, timeS, frame);
    scene.draw({ frame, setting, trails, selection, hovered: null, switches, camera: panning ? panned(fit, 5 * Math.sin(timeS), 0) : fit, theme: themes.light });
  };
  draw(0);
  const { drawn, all } = scene.radioLinks;
  return { about: `${drawn} of the links drawn${lineOfSight ? ', line of sight' : ''}`, links: all, draw, finish: () => void pen.getImageData(0, 0, 1, 1) };
}

async function measure(name: 'canvas' | 'pixi' | 'jagged' | 'scene' | 'panning' | 'sight', index: number, seconds: number): Promise<Count> {
  const layout = layouts[index]!;
  const still = madeUpFrame(layout.robots, layout.pitchM);
  const drawing = name === 'canvas' || name === 'pixi' || name === 'jagged' ? await plainDrawing(name, layout, still) : sceneDrawing(still, name === 'sight', name === 'panning');
  const fps = await shownPerSecond(seconds, drawing.draw);
  const ms = await times(drawing.draw, drawing.finish);
  return { about: drawing.about, links: drawing.links, fps, medianMs: ms[20]!, p95Ms: ms[38]! };
}

Object.assign(window, { measure, layouts });
