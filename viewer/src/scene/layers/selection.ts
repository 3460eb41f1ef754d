// SPDX-License-Identifier: MIT
// What is selected, hovered, dragged: below the robots the reach of its radio, its neighbours and its way to the
// root; above them the ring.
import { toPxX, toPxY } from '../camera';
import { root, type Shot } from '../shot';
import type { Item } from '../view';
import { centerOf } from '../sight';
import { rootRing } from './robots';
import { targetRadiusPx, traceTarget } from './targets';
import { traceObstacle, wallPx } from './obstacles';

const circle = 2 * Math.PI;

export function drawUnderSelection(shot: Shot): void {
  const { pen, view, theme } = shot;
  const { selection } = view;
  if (selection?.kind !== 'robot' || selection.index >= shot.robots) return;
  const i = selection.index;
  pen.strokeStyle = theme.accent;
  drawRange(shot, i);
  if (shot.isAlive(i)) drawNeighbours(shot, i);
  drawPath(shot, i);
}

function drawRange(shot: Shot, i: number): void {
  const { pen, theme, view } = shot;
  pen.beginPath();
  pen.arc(shot.x[i]!, shot.y[i]!, view.setting.range_m * view.camera.scale, 0, circle);
  pen.fillStyle = theme.accent;
  pen.globalAlpha = 0.05;
  pen.fill();
  pen.globalAlpha = 0.55;
  pen.lineWidth = 1.25;
  pen.setLineDash([2, 5]);
  pen.lineCap = 'round';
  pen.stroke();
  pen.setLineDash([]);
  pen.globalAlpha = 1;
}

function drawNeighbours(shot: Shot, i: number): void {
  const { pen, facts } = shot;
  const neighbours = facts.radio.neighbours(i);
  pen.beginPath();
  for (const j of neighbours) if (j < shot.robots) shot.line(i, j);
  pen.lineWidth = 1 / shot.ratio;
  pen.globalAlpha = 0.5;
  pen.stroke();
  pen.beginPath();
  for (const j of neighbours) {
    if (j >= shot.robots) continue;
    const radius = shot.radiusOf(j) + 2.5;
    pen.moveTo(shot.x[j]! + radius, shot.y[j]!);
    pen.arc(shot.x[j]!, shot.y[j]!, radius, 0, circle);
  }
  pen.globalAlpha = 0.5;
  pen.stroke();
  pen.globalAlpha = 1;
}

function drawPath(shot: Shot, i: number): void {
  const { pen, facts } = shot;
  const path = facts.pathToRoot(i);
  pen.beginPath();
  for (let k = 1; k < path.length; ++k) shot.line(path[k - 1]!, path[k]!);
  pen.lineCap = 'round';
  pen.lineWidth = Math.max(13, 2.6 * shot.bodyPx);
  pen.globalAlpha = 0.3;
  pen.stroke();
  pen.globalAlpha = 1;
}

export function drawOverSelection(shot: Shot): void {
  const { view } = shot;
  if (view.hovered) ring(shot, view.hovered, 1.5, 0.8);
  if (view.selection) ring(shot, view.selection, 2.5, 1);
  if (view.dragged) drawDragged(shot);
  if (view.area) drawArea(shot);
  if (view.disc) drawNewDisc(shot, view.disc);
  if (view.cursor) drawCursor(shot);
}

/** Adds the outline of an item, `gapPx` outside of it, to the path; moved by (dx, dy) m. */
function traceItem(shot: Shot, item: Item, gapPx: number, dx = 0, dy = 0): void {
  const { pen, view } = shot;
  const { camera, frame } = view;
  if (item.kind === 'robot' && item.index < shot.robots) {
    const x = shot.x[item.index]! + dx * camera.scale, y = shot.y[item.index]! - dy * camera.scale;
    traceTarget(pen, x, y, (shot.isAlive(item.index) && shot.role(item.index) === root ? rootRing : 1) * shot.radiusOf(item.index) + gapPx);
  } else if (item.kind === 'target' && item.index < frame.targets.x.length) {
    const x = toPxX(camera, frame.targets.x[item.index]! + dx), y = toPxY(camera, frame.targets.y[item.index]! + dy);
    traceTarget(pen, x, y, targetRadiusPx(shot) + gapPx);
  } else if (item.kind === 'obstacle' && item.index < view.setting.obstacles.length) {
    traceObstacle(pen, view.setting.obstacles[item.index]!, camera, dx, dy);
  }
}

function ring(shot: Shot, item: Item, widthPx: number, alpha: number): void {
  const { pen, theme } = shot;
  const wall = item.kind === 'obstacle' && 'wall' in (shot.view.setting.obstacles[item.index] ?? {});
  pen.beginPath();
  traceItem(shot, item, 4);
  pen.lineCap = 'round';
  pen.globalAlpha = alpha;
  if (!wall) {
    pen.strokeStyle = theme.background;
    pen.lineWidth = widthPx + 2;
    pen.stroke();
  }
  pen.strokeStyle = theme.accent;
  pen.lineWidth = wall ? wallPx : widthPx;
  pen.stroke();
  pen.globalAlpha = 1;
}

/** Where an item is in the world, m. */
export function placeOf(shot: Shot, item: Item): { x: number; y: number } {
  const { frame, setting } = shot.view;
  if (item.kind === 'target') return { x: frame.targets.x[item.index] ?? 0, y: frame.targets.y[item.index] ?? 0 };
  if (item.kind === 'robot') return { x: frame.data[item.index] ?? 0, y: frame.data[frame.robots + item.index] ?? 0 };
  const obstacle = setting.obstacles[item.index];
  if (!obstacle) return { x: 0, y: 0 };
  const [x, y] = centerOf(obstacle);
  return { x, y };
}

/** A ghost where it would be put, and the way there. */
function drawDragged(shot: Shot): void {
  const { pen, theme, view } = shot;
  const { item, toM } = view.dragged!;
  const from = placeOf(shot, item);
  pen.strokeStyle = theme.accent;
  pen.lineWidth = 1.5;
  pen.setLineDash([4, 4]);
  pen.beginPath();
  pen.moveTo(toPxX(view.camera, from.x), toPxY(view.camera, from.y));
  pen.lineTo(toPxX(view.camera, toM.x), toPxY(view.camera, toM.y));
  pen.stroke();
  pen.setLineDash([]);
  pen.beginPath();
  traceItem(shot, item, 0, toM.x - from.x, toM.y - from.y);
  pen.fillStyle = item.kind === 'target' ? theme.target : theme.obstacle;
  pen.globalAlpha = 0.45;
  pen.fill();
  pen.globalAlpha = 1;
  pen.lineWidth = 2;
  pen.stroke();
}

function drawNewDisc({ pen, theme, view: { camera } }: Shot, { at, radiusM }: { at: { x: number; y: number }; radiusM: number }): void {
  pen.beginPath();
  traceTarget(pen, toPxX(camera, at.x), toPxY(camera, at.y), radiusM * camera.scale);
  pen.fillStyle = theme.obstacle;
  pen.globalAlpha = 0.45;
  pen.fill();
  pen.globalAlpha = 1;
  pen.strokeStyle = theme.accent;
  pen.lineWidth = 2;
  pen.stroke();
}

/** A cross around the place, open in its middle. */
function drawCursor({ pen, theme, view }: Shot): void {
  const x = toPxX(view.camera, view.cursor!.x), y = toPxY(view.camera, view.cursor!.y);
  pen.beginPath();
  for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]] as const) {
    pen.moveTo(x + 5 * dx, y + 5 * dy);
    pen.lineTo(x + 18 * dx, y + 18 * dy);
  }
  pen.strokeStyle = theme.background;
  pen.lineWidth = 5;
  pen.stroke();
  pen.strokeStyle = theme.accent;
  pen.lineWidth = 2;
  pen.stroke();
}

/** The rectangle, and a ring around each living robot in it. */
function drawArea(shot: Shot): void {
  const { pen, theme, view } = shot;
  const area = view.area!;
  const left = toPxX(view.camera, area.minX), right = toPxX(view.camera, area.maxX);
  const top = toPxY(view.camera, area.maxY), bottom = toPxY(view.camera, area.minY);
  pen.strokeStyle = theme.accent;
  pen.fillStyle = theme.accent;
  pen.globalAlpha = 0.1;
  pen.fillRect(left, top, right - left, bottom - top);
  pen.globalAlpha = 1;
  pen.lineWidth = 1.25;
  pen.strokeRect(left, top, right - left, bottom - top);
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    const x = shot.x[i]!, y = shot.y[i]!;
    if (!shot.isAlive(i) || x < left || x > right || y < top || y > bottom) continue;
    traceTarget(pen, x, y, shot.radiusOf(i) + 3);
  }
  pen.lineWidth = 2;
  pen.stroke();
}
