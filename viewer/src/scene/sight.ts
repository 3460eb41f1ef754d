// SPDX-License-Identifier: MIT
// Does an obstacle stand between two points? As `blocks` in world/src/obstacles.cpp, operation by operation, so
// that the page and the program agree about every link.
import type { Obstacle } from '../frame';

/** Whether the disc's inside meets the segment a-b. The segment has to come with its smaller end (by x, then y)
 *  first; see `blocks`. */
export function discBlocks(
  cx: number, cy: number, radius: number, ax: number, ay: number, bx: number, by: number,
): boolean {
  const dx = bx - ax;
  const dy = by - ay;
  const length2 = dx * dx + dy * dy;
  let t = 0;
  if (length2 !== 0) t = Math.min(1, Math.max(0, ((cx - ax) * dx + (cy - ay) * dy) / length2));
  const gapX = ax + dx * t - cx;
  const gapY = ay + dy * t - cy;
  return gapX * gapX + gapY * gapY < radius * radius;
}

/** (cos, sin) by the series of controller/trig.hpp: the same box on both sides, to the last bit. */
export function unitVector(angle: number): [number, number] {
  const quarters = angle * 0.63661977236758134308;
  const q = Math.trunc(quarters < 0 ? quarters - 0.5 : quarters + 0.5);
  const a = angle - q * 1.5703125 - q * 4.83826794896619e-4;
  const z = a * a;
  const s = a * (1 + z * (-1 / 6 + z * (1 / 120 + z * (-1 / 5040 + z * (1 / 362880 - z / 39916800)))));
  const c = 1 + z * (-0.5 + z * (1 / 24 + z * (-1 / 720 + z * (1 / 40320 + z * (-1 / 3628800 + z / 479001600)))));
  switch (q & 3) {
    case 0: return [c, s];
    case 1: return [-s, c];
    case 2: return [-c, -s];
    default: return [s, -c];
  }
}

interface Span { from: number; to: number }

/** Cuts the span of the segment's parameter down to where -half < p + t d < half. */
function clip(p: number, d: number, half: number, span: Span): boolean {
  if (d === 0) return -half < p && p < half;
  const t1 = (-half - p) / d;
  const t2 = (half - p) / d;
  span.from = Math.max(span.from, Math.min(t1, t2));
  span.to = Math.min(span.to, Math.max(t1, t2));
  return span.from < span.to;
}

type FloorMap = Extract<Obstacle, { map: true }>;

function rotationOf(map: FloorMap): [number, number] {
  if (map.angle_rad === 0) return [1, 0];
  const [c, s] = unitVector(map.angle_rad);
  const norm = Math.sqrt(c * c + s * s);
  return [c / norm, s / norm];
}

/** A place in a map's cells, m. */
export function inMetres(map: FloorMap, column: number, row: number): [number, number] {
  const [c, s] = rotationOf(map);
  const x = column * map.resolution_m, y = row * map.resolution_m;
  return [map.origin_m[0] + (c * x - s * y), map.origin_m[1] + (s * x + c * y)];
}

/** Its centre; of a wall, its middle. */
export function centerOf(obstacle: Obstacle): [number, number] {
  if ('map' in obstacle) return inMetres(obstacle, obstacle.cells.columns / 2, obstacle.cells.rows / 2);
  if (!('wall' in obstacle)) return obstacle.center_m;
  return [(obstacle.from_m[0] + obstacle.to_m[0]) / 2, (obstacle.from_m[1] + obstacle.to_m[1]) / 2];
}

function mapBlocks(map: FloorMap, ax: number, ay: number, bx: number, by: number): boolean {
  const [c, s] = rotationOf(map);
  const px = ax - map.origin_m[0], py = ay - map.origin_m[1], qx = bx - map.origin_m[0], qy = by - map.origin_m[1];
  return map.cells.blocksLine((c * px + s * py) / map.resolution_m, (c * py - s * px) / map.resolution_m,
    (c * qx + s * qy) / map.resolution_m, (c * qy - s * qx) / map.resolution_m);
}

type Box = Extract<Obstacle, { box: true }>;
type Wall = Extract<Obstacle, { wall: true }>;

function boxBlocks(box: Box, ax: number, ay: number, bx: number, by: number): boolean {
  const [cx, cy] = box.center_m;
  const [width, height] = box.size_m;
  // Outside the circumscribed disc; its radius is that of half the diagonal.
  if (!discBlocks(cx, cy, 0.5 * Math.sqrt(width * width + height * height), ax, ay, bx, by)) return false;
  const raw = unitVector(box.angle_rad);
  const norm = Math.sqrt(raw[0] * raw[0] + raw[1] * raw[1]);
  const c = raw[0] / norm;
  const s = raw[1] / norm;
  const px = c * (ax - cx) + s * (ay - cy);
  const py = c * (ay - cy) - s * (ax - cx);
  const dx = c * (bx - ax) + s * (by - ay);
  const dy = c * (by - ay) - s * (bx - ax);
  if (ax === bx && ay === by) return Math.abs(px) < 0.5 * width && Math.abs(py) < 0.5 * height;
  const span = { from: 0, to: 1 };
  return clip(px, dx, 0.5 * width, span) && clip(py, dy, 0.5 * height, span);
}

/** A wall has no thickness: a line along it, or one that ends on it, is free; one through its end is not. */
function wallBlocks(wall: Wall, ax: number, ay: number, bx: number, by: number): boolean {
  const [fx, fy] = wall.from_m;
  const [tx, ty] = wall.to_m;
  const sideA = (tx - fx) * (ay - fy) - (ty - fy) * (ax - fx);
  const sideB = (tx - fx) * (by - fy) - (ty - fy) * (bx - fx);
  if (!((sideA < 0 && sideB > 0) || (sideA > 0 && sideB < 0))) return false;
  const sideFrom = (bx - ax) * (fy - ay) - (by - ay) * (fx - ax);
  const sideTo = (bx - ax) * (ty - ay) - (by - ay) * (tx - ax);
  return (sideFrom <= 0 && sideTo >= 0) || (sideFrom >= 0 && sideTo <= 0);
}

/** Whether the open segment a-b meets the obstacle; the same for b-a. */
export function blocks(obstacle: Obstacle, ax: number, ay: number, bx: number, by: number): boolean {
  if (bx < ax || (bx === ax && by < ay)) return blocks(obstacle, bx, by, ax, ay);
  if ('disc' in obstacle) {
    return discBlocks(obstacle.center_m[0], obstacle.center_m[1], obstacle.radius_m, ax, ay, bx, by);
  }
  if ('map' in obstacle) return mapBlocks(obstacle, ax, ay, bx, by);
  return 'box' in obstacle ? boxBlocks(obstacle, ax, ay, bx, by) : wallBlocks(obstacle, ax, ay, bx, by);
}
