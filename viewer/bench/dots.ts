// SPDX-License-Identifier: MIT
// Runs in the browser for dots.mjs: draws 10,000 squares that move, in one of several ways.
import { DotBitmap, Dots } from '../src/scene/dots';
import { dice } from './swarm';

const count = 10_000, width = 1280, height = 720, sidePx = 2.88;
const roll = dice(1);
const places = Array.from({ length: count }, () => [280 + 720 * roll(), 720 * roll()] as const);
const xAt = (i: number, timeS: number) => places[i]![0] + Math.cos(timeS + i);

function newCanvas(): HTMLCanvasElement {
  return Object.assign(document.createElement('canvas'), { width, height });
}

const vertices = `#version 300 es
in vec2 at;
void main() { gl_Position = vec4(at.x / ${width / 2}.0 - 1.0, 1.0 - at.y / ${height / 2}.0, 0.0, 1.0); gl_PointSize = 3.0; }`;
const fragments = `#version 300 es
precision mediump float;
out vec4 color;
void main() { color = vec4(0.53, 0.53, 0.33, 1.0); }`;

/** Points in one call; `clear`: of red, green, blue and alpha. */
function webgl(canvas: HTMLCanvasElement, clear: number): (timeS: number) => void {
  const gl = canvas.getContext('webgl2', { antialias: false });
  if (gl === null) throw new Error('there is no WebGL 2');
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertices], [gl.FRAGMENT_SHADER, fragments]] as const) {
    const shader = gl.createShader(kind)!;
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  gl.useProgram(program);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  gl.clearColor(clear, clear, clear, clear);
  const at = new Float32Array(2 * count);
  return (timeS) => {
    for (let i = 0; i < count; ++i) {
      at[2 * i] = xAt(i, timeS);
      at[2 * i + 1] = places[i]![1];
    }
    gl.bufferData(gl.ARRAY_BUFFER, at, gl.STREAM_DRAW);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.drawArrays(gl.POINTS, 0, count);
  };
}

/** The same pixels in a worker, which owns the canvas: the page's thread only says where the dots are. */
function offscreen(canvas: HTMLCanvasElement): (timeS: number) => void {
  const code = [...document.scripts].at(-1)!.textContent ?? '';
  const worker = new Worker(URL.createObjectURL(new Blob([code])));
  const handed = canvas.transferControlToOffscreen();
  worker.postMessage(handed, [handed]);
  return (timeS) => {
    const at = new Float32Array(2 * count);
    for (let i = 0; i < count; ++i) {
      at[2 * i] = xAt(i, timeS);
      at[2 * i + 1] = places[i]![1];
    }
    worker.postMessage(at, [at.buffer]);
  };
}

function inWorker(): void {
  let pen: OffscreenCanvasRenderingContext2D | null = null;
  const bitmap = new DotBitmap();
  const image = new ImageData(width, height);
  const words = new Uint32Array(image.data.buffer);
  self.onmessage = ({ data }: MessageEvent<OffscreenCanvas | Float32Array>) => {
    if (data instanceof OffscreenCanvas) return void (pen = data.getContext('2d'));
    bitmap.clear(width, height, '#888855', words);
    for (let i = 0; i < count; ++i) bitmap.add(data[2 * i]!, data[2 * i + 1]!, sidePx);
    pen?.putImageData(image, 0, 0);
  };
}

function drawing(way: string, canvas: HTMLCanvasElement): (timeS: number) => void {
  if (way === 'WebGL alone') return webgl(canvas, 1);
  if (way === 'off-screen, in a worker') return offscreen(canvas);
  const pen = canvas.getContext('2d', { alpha: false })!;
  const clear = () => { pen.fillStyle = '#ffffff'; pen.fillRect(0, 0, width, height); };
  if (way === 'nothing') return clear;
  if (way === 'WebGL, in the picture') {
    const other = newCanvas();
    const points = webgl(other, 0);
    return (timeS) => { clear(); points(timeS); pen.drawImage(other, 0, 0); };
  }
  if (way === 'own pixels') {
    const dots = new Dots();
    return (timeS) => {
      clear();
      dots.begin(width, height, '#888855');
      for (let i = 0; i < count; ++i) dots.bitmap.add(xAt(i, timeS), places[i]![1], sidePx);
      dots.draw(pen, 0, 0, 1);
    };
  }
  return (timeS) => {
    clear();
    pen.fillStyle = '#888855';
    for (let i = 0; i < count; ++i) pen.fillRect(xAt(i, timeS) - sidePx / 2, places[i]![1] - sidePx / 2, sidePx, sidePx);
  };
}

/** Pictures per second. */
async function draw(way: string, pictures: number): Promise<number> {
  const canvas = newCanvas();
  document.body.replaceChildren(canvas);
  const picture = drawing(way, canvas);
  const begin = performance.now();
  for (let k = 0; k < pictures; ++k) picture(0.001 * (await new Promise<number>((resolve) => requestAnimationFrame(resolve))));
  return (1000 * pictures) / (performance.now() - begin);
}

if (typeof document === 'undefined') inWorker();
else Object.assign(window, { draw });
