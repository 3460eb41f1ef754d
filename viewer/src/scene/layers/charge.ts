// SPDX-License-Identifier: MIT
// How much charge each living robot has: a ring that runs clockwise from the top and is as long as its share of a full
// battery. Nothing where robots do not run on batteries. Who is about to run down has a ring of another colour, and the
// whole ring faintly below, so that a short rest is seen.
import { column } from '../../frame';
import { root, type Shot } from '../shot';
import { rootRing } from './robots';

const circle = 2 * Math.PI;
const top = -Math.PI / 2;
/** Less charge than this is little. */
export const little = 0.25;
const ringPx = 4; // smaller robots have no room for a ring

/** From the middle of the robot, px: outside its mark, and outside the root's own ring. */
function ringRadius(shot: Shot, i: number): number {
  const radius = shot.radiusOf(i);
  return (shot.role(i) === root ? rootRing : 1) * radius + 0.45 * radius + 1;
}

export function drawCharge(shot: Shot): void {
  const { pen, theme, x, y } = shot;
  const spent = column(shot.view.frame, 'spent');
  if (shot.dots || shot.radiusPx[root]! < ringPx || !spent.some((share) => share > 0)) return;
  const arcs = (color: string, alpha: number, which: (i: number) => boolean, share: (i: number) => number): void => {
    pen.globalAlpha = alpha;
    pen.strokeStyle = color;
    pen.beginPath();
    for (let i = 0; i < shot.robots; ++i) {
      const radius = ringRadius(shot, i);
      if (!shot.isAlive(i) || !which(i) || !shot.inSight(x[i]!, y[i]!, 2 * radius)) continue;
      pen.moveTo(x[i]!, y[i]! - radius);
      pen.arc(x[i]!, y[i]!, radius, top, top + circle * share(i));
    }
    pen.stroke();
  };
  pen.lineCap = 'butt';
  pen.lineWidth = Math.min(3, Math.max(1.5, 0.3 * shot.bodyPx));
  const charge = (i: number): number => 1 - spent[i]!;
  arcs(theme.heading, 0.2, () => true, () => 1);
  arcs(theme.heading, 0.9, (i) => charge(i) >= little, charge);
  arcs(theme.roles[root], 1, (i) => charge(i) < little, charge);
  pen.globalAlpha = 1;
}
