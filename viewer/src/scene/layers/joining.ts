// SPDX-License-Identifier: MIT
// Spares about to join: a thin arrow to the middle of the edge they asked to be let into, which is that of `owner`
// to its parent; firm once the owner has granted it.
import { column } from '../../frame';
import { connector, spare, type Shot } from '../shot';

const headPx = 6;

export function drawJoining(shot: Shot): void {
  const { pen, theme, facts } = shot;
  const request = column(facts.frame, 'request');
  const grant = column(facts.frame, 'grant');
  const asks = (i: number, owner: number) =>
    owner >= 0 && owner < shot.robots && shot.isAlive(i) && shot.role(i) === spare;
  pen.lineCap = 'round';
  pen.strokeStyle = theme.spareTrail;
  pen.lineWidth = 1.25;
  pen.globalAlpha = 0.6;
  pen.setLineDash([2, 3.5]);
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    if (asks(i, request[i]!) && grant[request[i]!] !== i) traceArrow(shot, i, request[i]!, false);
  }
  pen.stroke();
  pen.setLineDash([]);
  pen.globalAlpha = 1;
  pen.strokeStyle = theme.roles[connector];
  pen.lineWidth = 1.75;
  pen.beginPath();
  for (let owner = 0; owner < shot.robots; ++owner) {
    const i = grant[owner]!;
    if (i >= 0 && i < shot.robots && asks(i, owner)) traceArrow(shot, i, owner, true);
  }
  pen.stroke();
}

function traceArrow(shot: Shot, i: number, owner: number, head: boolean): void {
  const { pen, x, y, facts } = shot;
  const parent = facts.parent[owner]!;
  const other = parent >= 0 && parent < shot.robots ? parent : owner;
  const toX = (x[owner]! + x[other]!) / 2, toY = (y[owner]! + y[other]!) / 2;
  const dx = toX - x[i]!, dy = toY - y[i]!;
  const length = Math.hypot(dx, dy);
  const start = shot.radiusOf(i) + 2;
  if (length < start + headPx) return; // almost there
  const ux = dx / length, uy = dy / length;
  pen.moveTo(x[i]! + start * ux, y[i]! + start * uy);
  pen.lineTo(toX, toY);
  if (!head) return;
  pen.moveTo(toX - headPx * (ux + 0.5 * -uy), toY - headPx * (uy + 0.5 * ux));
  pen.lineTo(toX, toY);
  pen.lineTo(toX - headPx * (ux - 0.5 * -uy), toY - headPx * (uy - 0.5 * ux));
}
