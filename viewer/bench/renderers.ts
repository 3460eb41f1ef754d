// SPDX-License-Identifier: MIT
// The two ways to draw that were compared: the same plain picture (links, tree edges, robots with headings), all of
// it new at every frame, once with Canvas 2D and once with PixiJS 8, in whose terms it is drawn as cheaply as it can
// be: links as one line list, robots as sprites of one texture.
import type { Frame } from '../src/frame';
import { column } from '../src/frame';

export interface Renderer {
  draw(frame: Frame, links: Int32Array, scale: number): void;
  /** Waits until the pixels are there; without it only the recording of commands would be timed. */
  finish(): void;
  about: string;
}

const roleColors = ['#f0e442', '#009e73', '#0072b2', '#d55e00'];
const radiusPx = 4;

export function canvasRenderer(canvas: HTMLCanvasElement): Renderer {
  const pen = canvas.getContext('2d', { alpha: false })!;
  const { width, height } = canvas;
  return {
    about: 'Canvas 2D',
    finish: () => void pen.getImageData(0, 0, 1, 1),
    draw(frame, links, scale) {
      const x = column(frame, 'x_m'), y = column(frame, 'y_m'), role = column(frame, 'role'), parent = column(frame, 'parent');
      const heading = column(frame, 'heading_rad');
      const px = (i: number) => width / 2 + x[i]! * scale, py = (i: number) => height / 2 - y[i]! * scale;
      pen.fillStyle = '#ffffff';
      pen.fillRect(0, 0, width, height);
      pen.strokeStyle = '#d8d8d8'; pen.lineWidth = 1; pen.beginPath();
      for (let k = 0; k < links.length; k += 2) { pen.moveTo(px(links[k]!), py(links[k]!)); pen.lineTo(px(links[k + 1]!), py(links[k + 1]!)); }
      pen.stroke();
      pen.strokeStyle = '#1a1a1a'; pen.lineWidth = 2.5; pen.beginPath();
      for (let i = 0; i < frame.robots; ++i) if (parent[i]! >= 0) { pen.moveTo(px(i), py(i)); pen.lineTo(px(parent[i]!), py(parent[i]!)); }
      for (let i = 0; i < frame.robots; ++i) { pen.moveTo(px(i), py(i)); pen.lineTo(px(i) + 7 * Math.cos(heading[i]!), py(i) - 7 * Math.sin(heading[i]!)); }
      pen.stroke();
      for (let r = 0; r < 4; ++r) {
        pen.fillStyle = roleColors[r]!; pen.lineWidth = 1; pen.beginPath();
        for (let i = 0; i < frame.robots; ++i) if (role[i] === r) { pen.moveTo(px(i) + radiusPx, py(i)); pen.arc(px(i), py(i), radiusPx, 0, 2 * Math.PI); }
        pen.fill(); pen.stroke();
      }
    },
  };
}

/** `pixi`: the module, so that the benchmark runs without it when only the scene is measured. */
export async function pixiRenderer(canvas: HTMLCanvasElement, pixi: typeof import('pixi.js'), antialias: boolean): Promise<Renderer> {
  const renderer = await pixi.autoDetectRenderer({ canvas, width: canvas.width, height: canvas.height, background: '#ffffff', antialias, preference: 'webgl' });
  const gl = (renderer as unknown as { gl?: WebGL2RenderingContext }).gl;
  const stage = new pixi.Container();
  let positions = new Float32Array(0);
  let geometry: import('pixi.js').MeshGeometry | undefined;
  const tree = new pixi.Graphics();
  stage.addChild(tree);
  const dot = renderer.generateTexture({ target: new pixi.Graphics().circle(0, 0, radiusPx).fill('#ffffff').stroke({ width: 1, color: '#1a1a1a' }), resolution: 2, antialias: true });
  const sprites: import('pixi.js').Sprite[] = [];
  const { width, height } = canvas;
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  return {
    about: gl ? `PixiJS on ${gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER)}` : `PixiJS, ${renderer.name}`,
    finish: () => gl?.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)),
    draw(frame, links, scale) {
      const x = column(frame, 'x_m'), y = column(frame, 'y_m'), role = column(frame, 'role'), parent = column(frame, 'parent');
      const heading = column(frame, 'heading_rad');
      const px = (i: number) => width / 2 + x[i]! * scale, py = (i: number) => height / 2 - y[i]! * scale;
      if (positions.length !== 2 * links.length) {
        positions = new Float32Array(2 * links.length);
        geometry = new pixi.MeshGeometry({ positions, uvs: new Float32Array(2 * links.length), indices: Uint32Array.from(links, (_, k) => k), topology: 'line-list' });
        const mesh = new pixi.Mesh({ geometry, texture: pixi.Texture.WHITE });
        mesh.tint = '#d8d8d8';
        stage.addChildAt(mesh, 0);
      }
      for (let k = 0; k < links.length; ++k) { positions[2 * k] = px(links[k]!); positions[2 * k + 1] = py(links[k]!); }
      geometry!.getBuffer('aPosition').update();
      tree.clear();
      for (let i = 0; i < frame.robots; ++i) if (parent[i]! >= 0) tree.moveTo(px(i), py(i)).lineTo(px(parent[i]!), py(parent[i]!));
      for (let i = 0; i < frame.robots; ++i) tree.moveTo(px(i), py(i)).lineTo(px(i) + 7 * Math.cos(heading[i]!), py(i) - 7 * Math.sin(heading[i]!));
      tree.stroke({ width: 2.5, color: '#1a1a1a' });
      while (sprites.length < frame.robots) { const s = new pixi.Sprite(dot); s.anchor.set(0.5); sprites.push(s); stage.addChild(s); }
      for (let i = 0; i < frame.robots; ++i) { const s = sprites[i]!; s.position.set(px(i), py(i)); s.tint = roleColors[role[i]!]!; }
      renderer.render(stage);
    },
  };
}
