// SPDX-License-Identifier: MIT
// How far a run reaches: what a camera has to fit.
import { column, type Frame, type Obstacle, type Setting } from '../frame';
import type { Bounds } from './camera';
import { inMetres } from './sight';

const mostM = 1e6; // beyond, a position is damage and would hide the rest

export function empty(): Bounds {
  return { minX: Infinity, minY: Infinity, maxX: -Infinity, maxY: -Infinity };
}

export function add(bounds: Bounds, x: number, y: number, aroundM = 0): void {
  if (!(Math.abs(x) < mostM && Math.abs(y) < mostM)) return;
  bounds.minX = Math.min(bounds.minX, x - aroundM);
  bounds.minY = Math.min(bounds.minY, y - aroundM);
  bounds.maxX = Math.max(bounds.maxX, x + aroundM);
  bounds.maxY = Math.max(bounds.maxY, y + aroundM);
}

function addObstacle(bounds: Bounds, obstacle: Obstacle): void {
  if ('wall' in obstacle) {
    add(bounds, ...obstacle.from_m);
    add(bounds, ...obstacle.to_m);
  } else if ('map' in obstacle) {
    const { columns, rows } = obstacle.cells;
    for (const [i, j] of [[0, 0], [columns, 0], [0, rows], [columns, rows]]) add(bounds, ...inMetres(obstacle, i!, j!));
  } else if ('disc' in obstacle) {
    add(bounds, ...obstacle.center_m, obstacle.radius_m);
  } else {
    const [x, y] = obstacle.center_m;
    const c = Math.abs(Math.cos(obstacle.angle_rad)), s = Math.abs(Math.sin(obstacle.angle_rad));
    const [w, h] = obstacle.size_m;
    add(bounds, x - (c * w + s * h) / 2, y - (s * w + c * h) / 2);
    add(bounds, x + (c * w + s * h) / 2, y + (s * w + c * h) / 2);
  }
}

/** Of robots, targets and obstacles, but at least as wide and high as the radio reaches. Give it the first frame
 *  and a late one to have room for what is to come. */
export function boundsOf(setting: Setting, ...frames: readonly Frame[]): Bounds {
  const bounds = empty();
  for (const frame of frames) {
    const x = column(frame, 'x_m'), y = column(frame, 'y_m');
    for (let i = 0; i < frame.robots; ++i) add(bounds, x[i]!, y[i]!, setting.radius_m);
    const { targets } = frame;
    for (let k = 0; k < targets.x.length; ++k) add(bounds, targets.x[k]!, targets.y[k]!, setting.target_tolerance_m);
  }
  for (const obstacle of setting.obstacles) addObstacle(bounds, obstacle);
  const found = bounds.minX <= bounds.maxX ? bounds : { minX: 0, minY: 0, maxX: 0, maxY: 0 };
  const least = setting.range_m || 2;
  const growX = Math.max(0, least - (found.maxX - found.minX)) / 2;
  const growY = Math.max(0, least - (found.maxY - found.minY)) / 2;
  return { minX: found.minX - growX, minY: found.minY - growY, maxX: found.maxX + growX, maxY: found.maxY + growY };
}
