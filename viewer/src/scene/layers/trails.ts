// SPDX-License-Identifier: MIT
// Where robots have been lately, fading with age. Spares' trails are left out where there are hundreds of them: they
// would cover the ground.
import type { Frame } from '../../frame';
import { toPxX, toPxY } from '../camera';
import { many, roleCount, spare, type Shot } from '../shot';

const ages = 3; // steps of fading
const oldestShare = 0.28; // of the newest part's opacity

export function drawTrails(shot: Shot): void {
  const { pen, view, theme } = shot;
  const trails = view.trails.filter((f) => f.robots >= shot.robots && f.timeS < view.frame.timeS);
  if (!view.switches.trails || trails.length === 0) return;
  const points = [...trails, view.frame];
  pen.lineCap = 'butt';
  pen.lineJoin = 'round';
  for (let age = 0; age < ages; ++age) {
    const from = Math.floor(((points.length - 1) * age) / ages);
    const to = Math.floor(((points.length - 1) * (age + 1)) / ages);
    pen.globalAlpha = theme.trailAlpha * (oldestShare + ((1 - oldestShare) * age) / (ages - 1));
    for (let role = shot.robots >= many ? spare + 1 : spare; role < roleCount; ++role) {
      pen.strokeStyle = role === spare ? theme.spareTrail : theme.roles[role]!;
      // Lines of one device pixel are ten times as fast as wider ones, and spares are many.
      pen.lineWidth = role === spare ? 1 / shot.ratio : Math.max(1.25, 0.35 * shot.radiusPx[role]!);
      trace(shot, points, from, to, role);
    }
  }
  pen.globalAlpha = 1;
}

/** Has the robot stayed where its body covers the trail? */
function isHidden(shot: Shot, points: readonly Frame[], i: number): boolean {
  const { view: { camera } } = shot;
  const reach = shot.radiusOf(i);
  for (const { data, robots } of points) {
    if (Math.abs(toPxX(camera, data[i]!) - shot.x[i]!) > reach || Math.abs(toPxY(camera, data[robots + i]!) - shot.y[i]!) > reach) return false;
  }
  return true;
}

/** The pieces from the `from`th to the `to`th point, of all robots that have this role now, in one path. */
function trace(shot: Shot, points: readonly Frame[], from: number, to: number, role: number): void {
  const { pen, view: { camera } } = shot;
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    if (shot.role(i) !== role || !shot.isAlive(i) || isHidden(shot, points, i)) continue;
    // x_m and y_m are the first columns; a view of them for each robot and point would be thousands of objects.
    let lastX = Infinity, lastY = Infinity;
    for (let k = from; k <= to; ++k) {
      const x = toPxX(camera, points[k]!.data[i]!);
      const y = toPxY(camera, points[k]!.data[points[k]!.robots + i]!);
      if (k === from) pen.moveTo(x, y);
      else if (Math.abs(x - lastX) + Math.abs(y - lastY) < 0.5) continue; // stood still
      else pen.lineTo(x, y);
      lastX = x;
      lastY = y;
    }
  }
  pen.stroke();
}
