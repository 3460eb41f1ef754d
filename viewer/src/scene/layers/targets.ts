// SPDX-License-Identifier: MIT
// Targets: the circle of their tolerance and a cross; filled once a worker holds the target. One that was
// given up is a faint dashed ring. Their numbers are written with the other labels.
import { givenUp } from '../../frame';
import { toPxX, toPxY } from '../camera';
import { targetsHeld } from '../held';
import { worker, type Shot } from '../shot';

/** The circle's radius, px; large enough to stand around a robot. */
export function targetRadiusPx(shot: Shot): number {
  return Math.max(shot.view.setting.target_tolerance_m * shot.view.camera.scale, shot.radiusPx[worker]! + 4);
}

export function traceTarget(pen: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  pen.moveTo(x + radius, y);
  pen.arc(x, y, radius, 0, 2 * Math.PI);
}

/** Only where it was. */
function drawGivenUp({ pen, theme }: Shot, x: number, y: number, radius: number): void {
  pen.beginPath();
  traceTarget(pen, x, y, radius);
  pen.setLineDash([2, 4]);
  pen.globalAlpha = 0.5;
  pen.strokeStyle = theme.target;
  pen.lineWidth = 1;
  pen.stroke();
  pen.globalAlpha = 1;
  pen.setLineDash([]);
}

export function drawTargets(shot: Shot): void {
  const { pen, view, theme } = shot;
  const { targets } = view.frame;
  const radius = targetRadiusPx(shot);
  const holds = targetsHeld(view.frame, view.setting.target_tolerance_m);
  pen.lineCap = 'butt';
  for (let k = 0; k < targets.x.length; ++k) {
    const x = toPxX(view.camera, targets.x[k]!);
    const y = toPxY(view.camera, targets.y[k]!);
    if (!shot.inSight(x, y, radius + 4)) continue;
    if (targets.worker[k] === givenUp) {
      drawGivenUp(shot, x, y, radius);
      continue;
    }
    const held = holds[k] === 1;
    pen.beginPath();
    traceTarget(pen, x, y, radius);
    pen.globalAlpha = held ? 0.42 : 0.16;
    pen.fillStyle = theme.target;
    pen.fill();
    pen.globalAlpha = 1;
    const arm = Math.min(radius * 0.55, 7);
    pen.moveTo(x - arm, y); pen.lineTo(x + arm, y);
    pen.moveTo(x, y - arm); pen.lineTo(x, y + arm);
    pen.strokeStyle = theme.target;
    pen.lineWidth = held ? 2.5 : 1.75;
    pen.stroke();
  }
}
