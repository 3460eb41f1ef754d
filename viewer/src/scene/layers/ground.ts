// SPDX-License-Identifier: MIT
// The ground: a faint metric grid, and the scale bar.
import { niceLength, noInsets, seen, toPxX, toPxY } from '../camera';
import type { Shot } from '../shot';

const cellPx = 130; // a cell is at most as wide
const barPx = 140;
const barInsetPx = 18;

export function drawGround({ pen, view, theme }: Shot): void {
  const { camera } = view;
  pen.fillStyle = theme.background;
  pen.fillRect(0, 0, camera.widthPx, camera.heightPx);
  const step = niceLength(cellPx / camera.scale);
  const world = seen(camera);
  // Whole pixels: a line between two pixels would be wide and grey.
  const crisp = (px: number) => Math.round(px) + 0.5;
  pen.beginPath();
  for (let k = Math.ceil(world.minX / step); k * step <= world.maxX; ++k) {
    const x = crisp(toPxX(camera, k * step));
    pen.moveTo(x, 0);
    pen.lineTo(x, camera.heightPx);
  }
  for (let k = Math.ceil(world.minY / step); k * step <= world.maxY; ++k) {
    const y = crisp(toPxY(camera, k * step));
    pen.moveTo(0, y);
    pen.lineTo(camera.widthPx, y);
  }
  pen.strokeStyle = theme.grid;
  pen.lineWidth = 1;
  pen.stroke();
}

function inWords(lengthM: number): string {
  if (lengthM >= 1000) return `${lengthM / 1000} km`;
  if (lengthM >= 1) return `${lengthM} m`;
  return lengthM >= 0.01 ? `${Math.round(lengthM * 100)} cm` : `${Math.round(lengthM * 1000)} mm`;
}

/** Lower left corner, above everything. */
export function drawScaleBar({ pen, view, theme, labels, ratio }: Shot): void {
  const insets = view.insets ?? noInsets;
  const lengthM = niceLength(barPx / view.camera.scale);
  const left = insets.left + barInsetPx + 0.5;
  const right = Math.round(left + lengthM * view.camera.scale) + 0.5;
  const y = Math.round(view.camera.heightPx - insets.bottom - barInsetPx) + 0.5;
  const sprite = labels.get(inWords(lengthM), 'scale', theme, ratio);
  pen.beginPath();
  pen.moveTo(left, y - 5); pen.lineTo(left, y); pen.lineTo(right, y); pen.lineTo(right, y - 5);
  pen.lineJoin = 'miter';
  pen.strokeStyle = theme.background;
  pen.lineWidth = 4;
  pen.stroke();
  pen.strokeStyle = theme.quietText;
  pen.lineWidth = 1.25;
  pen.stroke();
  labels.put(pen, sprite, (left + right - sprite.widthPx) / 2, y - 2 - sprite.heightPx, ratio);
}
