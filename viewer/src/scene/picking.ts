// SPDX-License-Identifier: MIT
// What is under the pointer. For a click, robots go before targets, these before obstacles: a visitor aims at the smaller
// thing. A drag takes targets and obstacles only, so there a robot is in nobody's way.
import { column, type Frame, type Obstacle, type Setting } from '../frame';
import { toPxX, toPxY, toWorld, type Bounds, type Camera, type Spot } from './camera';
import type { Item } from './view';

/** How far beside a thing one may point, px. */
export const pointerReachPx = 6;
export const touchReachPx = 18;
const smallestRobotPx = 5;
const smallestTargetPx = 9;

/** The thing at `atPx`, the nearest of its kind; null: only ground. */
export function itemAt(
  frame: Frame, setting: Setting, camera: Camera, atPx: Spot, reachPx = pointerReachPx,
): Item | null {
  const robotPx = Math.max(setting.radius_m * camera.scale, smallestRobotPx) + reachPx;
  const robot = nearest(column(frame, 'x_m'), column(frame, 'y_m'), camera, atPx, robotPx);
  return robot >= 0 ? { kind: 'robot', index: robot } : gripAt(frame, setting, camera, atPx, reachPx);
}

/** What a drag from `atPx` takes along; null: nothing. */
export function gripAt(
  frame: Frame, setting: Setting, camera: Camera, atPx: Spot, reachPx = pointerReachPx,
): Item | null {
  const targetPx = Math.max(setting.target_tolerance_m * camera.scale, smallestTargetPx) + reachPx / 2;
  const target = nearest(frame.targets.x, frame.targets.y, camera, atPx, targetPx);
  if (target >= 0) return { kind: 'target', index: target };
  const obstacle = nearestObstacle(setting.obstacles, camera, atPx, reachPx);
  return obstacle >= 0 ? { kind: 'obstacle', index: obstacle } : null;
}

/** Index of the point nearest to `atPx`, -1 if none is within `withinPx`. */
function nearest(x: Float64Array, y: Float64Array, camera: Camera, atPx: Spot, withinPx: number): number {
  let best = -1;
  let least = withinPx * withinPx;
  for (let i = 0; i < x.length; ++i) {
    const dx = toPxX(camera, x[i]!) - atPx.x;
    const dy = toPxY(camera, y[i]!) - atPx.y;
    const distance2 = dx * dx + dy * dy;
    if (distance2 > least) continue;
    // Of several at the same place, the last is the one that was drawn on top.
    least = distance2;
    best = i;
  }
  return best;
}

function nearestObstacle(obstacles: readonly Obstacle[], camera: Camera, atPx: Spot, withinPx: number): number {
  const at = toWorld(camera, atPx);
  let best = -1;
  let least = withinPx / camera.scale;
  obstacles.forEach((obstacle, k) => {
    const distance = clearance(obstacle, at);
    if (distance <= least) { least = distance; best = k; }
  });
  return best;
}

/** Distance of a point to the obstacle's surface, m; negative inside a disc or box. A map is the ground on which the rest
 *  stands: nobody points at it. */
export function clearance(obstacle: Obstacle, at: Spot): number {
  if ('map' in obstacle) return Infinity;
  if ('wall' in obstacle) {
    const [ax, ay] = obstacle.from_m;
    const dx = obstacle.to_m[0] - ax, dy = obstacle.to_m[1] - ay;
    const length2 = dx * dx + dy * dy;
    const t = length2 === 0 ? 0 : Math.min(1, Math.max(0, ((at.x - ax) * dx + (at.y - ay) * dy) / length2));
    return Math.hypot(ax + t * dx - at.x, ay + t * dy - at.y);
  }
  const x = at.x - obstacle.center_m[0], y = at.y - obstacle.center_m[1];
  if ('disc' in obstacle) return Math.hypot(x, y) - obstacle.radius_m;
  const c = Math.cos(obstacle.angle_rad), s = Math.sin(obstacle.angle_rad);
  const overX = Math.abs(c * x + s * y) - obstacle.size_m[0] / 2;
  const overY = Math.abs(c * y - s * x) - obstacle.size_m[1] / 2;
  if (overX <= 0 && overY <= 0) return Math.max(overX, overY);
  return Math.hypot(Math.max(overX, 0), Math.max(overY, 0));
}

/** The living robots in a rectangle, m. */
export function robotsIn(frame: Frame, area: Bounds): number[] {
  const x = column(frame, 'x_m'), y = column(frame, 'y_m'), alive = column(frame, 'alive');
  const found: number[] = [];
  for (let i = 0; i < frame.robots; ++i) {
    const inside = x[i]! >= area.minX && x[i]! <= area.maxX && y[i]! >= area.minY && y[i]! <= area.maxY;
    if (inside && alive[i] === 1) found.push(i);
  }
  return found;
}
