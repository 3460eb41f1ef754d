// SPDX-License-Identifier: MIT
// Discs, boxes, walls and maps.
import type { Obstacle } from '../../frame';
import { toPxX, toPxY, type Camera } from '../camera';
import { inMetres } from '../sight';
import type { Shot } from '../shot';

export const wallPx = 5;

/** Adds an obstacle to the pen's path; `dx`, `dy` move it, m. */
export function traceObstacle(
  pen: CanvasRenderingContext2D, obstacle: Obstacle, camera: Camera, dx = 0, dy = 0,
): void {
  const x = (m: number) => toPxX(camera, m + dx);
  const y = (m: number) => toPxY(camera, m + dy);
  if ('wall' in obstacle) {
    pen.moveTo(x(obstacle.from_m[0]), y(obstacle.from_m[1]));
    pen.lineTo(x(obstacle.to_m[0]), y(obstacle.to_m[1]));
    return;
  }
  if ('map' in obstacle) {
    for (const block of obstacle.cells.blocks()) {
      const corners = [[block.left, block.bottom], [block.right, block.bottom], [block.right, block.top], [block.left, block.top]];
      corners.forEach(([i, j], k) => {
        const [mx, my] = inMetres(obstacle, i!, j!);
        if (k === 0) pen.moveTo(x(mx), y(my));
        else pen.lineTo(x(mx), y(my));
      });
      pen.closePath();
    }
    return;
  }
  const [cx, cy] = obstacle.center_m;
  if ('disc' in obstacle) {
    const radius = obstacle.radius_m * camera.scale;
    pen.moveTo(x(cx) + radius, y(cy));
    pen.arc(x(cx), y(cy), radius, 0, 2 * Math.PI);
    return;
  }
  const [hx, hy] = [obstacle.size_m[0] / 2, obstacle.size_m[1] / 2];
  const c = Math.cos(obstacle.angle_rad), s = Math.sin(obstacle.angle_rad);
  pen.moveTo(x(cx + c * hx - s * hy), y(cy + s * hx + c * hy));
  pen.lineTo(x(cx - c * hx - s * hy), y(cy - s * hx + c * hy));
  pen.lineTo(x(cx - c * hx + s * hy), y(cy - s * hx - c * hy));
  pen.lineTo(x(cx + c * hx + s * hy), y(cy + s * hx - c * hy));
  pen.closePath();
}

export function drawObstacles({ pen, view, theme }: Shot): void {
  const { obstacles } = view.setting;
  if (obstacles.length === 0) return;
  // Without an edge, which would show where its rectangles meet.
  pen.beginPath();
  for (const obstacle of obstacles) if ('map' in obstacle) traceObstacle(pen, obstacle, view.camera);
  pen.fillStyle = theme.obstacle;
  pen.fill();
  pen.beginPath();
  for (const obstacle of obstacles) if (!('wall' in obstacle || 'map' in obstacle)) traceObstacle(pen, obstacle, view.camera);
  pen.fillStyle = theme.obstacle;
  pen.fill();
  pen.strokeStyle = theme.obstacleEdge;
  pen.lineWidth = 1;
  pen.stroke();
  pen.beginPath();
  for (const obstacle of obstacles) if ('wall' in obstacle) traceObstacle(pen, obstacle, view.camera);
  pen.lineCap = 'round';
  pen.strokeStyle = theme.obstacleEdge;
  pen.lineWidth = wallPx;
  pen.stroke();
  pen.strokeStyle = theme.obstacle;
  pen.lineWidth = wallPx - 2;
  pen.stroke();
}
