// SPDX-License-Identifier: MIT
// Robots by role. Besides its colour each has a mark of its own, for grey prints and colour-blind eyes: the root a
// ring, a worker a white dot, a dead robot a cross. One path per role and part: filling is what costs, not the pen.
import { connector, root, spare, worker, type Shot } from '../shot';

const circle = 2 * Math.PI;
/** Radius of the root's ring in radii of the root. */
export const rootRing = 1.65;
const headingFromPx = 4; // smaller robots have no room for a heading

type Which = (i: number) => boolean;

function traceCircles(shot: Shot, which: Which, radius: number): void {
  const { pen, x, y } = shot;
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    if (!which(i) || !shot.inSight(x[i]!, y[i]!, radius)) continue;
    pen.moveTo(x[i]! + radius, y[i]!);
    pen.arc(x[i]!, y[i]!, radius, 0, circle);
  }
}

/** Squares look like discs at two pixels and are filled much faster. */
function traceDots(shot: Shot, which: Which, radius: number): void {
  const { pen, x, y } = shot;
  const side = 1.8 * radius;
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    if (which(i) && shot.inSight(x[i]!, y[i]!, radius)) pen.rect(x[i]! - side / 2, y[i]! - side / 2, side, side);
  }
}

/** Fills the pen's path and draws its outline: thin, or yellow would not be seen on white. */
function fill(shot: Shot, color: string, radius: number): void {
  const { pen, theme } = shot;
  pen.fillStyle = color;
  pen.fill();
  pen.strokeStyle = theme.outline;
  pen.lineWidth = Math.min(1.2, Math.max(0.7, 0.18 * radius));
  pen.stroke();
}

/** Where they are going; below the bodies, so that only what sticks out is seen. */
export function drawHeadings(shot: Shot): void {
  const { pen, theme, x, y, heading } = shot;
  if (shot.dots) return;
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    const radius = shot.radiusOf(i);
    if (!shot.isAlive(i) || radius < headingFromPx || !shot.inSight(x[i]!, y[i]!, 2 * radius)) continue;
    pen.moveTo(x[i]!, y[i]!);
    pen.lineTo(x[i]! + 1.65 * radius * Math.cos(heading[i]!), y[i]! - 1.65 * radius * Math.sin(heading[i]!));
  }
  pen.strokeStyle = theme.heading;
  pen.lineCap = 'round';
  pen.lineWidth = Math.min(2.5, Math.max(1, 0.28 * shot.bodyPx));
  pen.stroke();
}

/** Below the tree, which must not be hidden by the many who wait. */
export function drawSparesAndDead(shot: Shot): void {
  const { theme } = shot;
  const isSpare = (i: number) => shot.role(i) === spare && shot.isAlive(i);
  const radius = shot.radiusPx[spare]!;
  if (shot.dots) {
    traceDots(shot, isSpare, radius);
    shot.pen.fillStyle = theme.dot;
    shot.pen.fill();
  } else {
    traceCircles(shot, isSpare, radius);
    fill(shot, theme.roles[spare], radius);
  }
  drawDead(shot);
}

function drawDead(shot: Shot): void {
  const { pen, theme, x, y } = shot;
  const isDead = (i: number) => !shot.isAlive(i);
  const radius = shot.radiusPx[connector]!;
  traceCircles(shot, isDead, radius);
  pen.fillStyle = theme.dead;
  pen.fill();
  const arm = 0.5 * radius;
  pen.beginPath();
  for (let i = 0; i < shot.robots; ++i) {
    if (!isDead(i)) continue;
    pen.moveTo(x[i]! - arm, y[i]! - arm); pen.lineTo(x[i]! + arm, y[i]! + arm);
    pen.moveTo(x[i]! - arm, y[i]! + arm); pen.lineTo(x[i]! + arm, y[i]! - arm);
  }
  pen.strokeStyle = theme.background;
  pen.lineWidth = Math.max(1.2, 0.22 * radius);
  pen.lineCap = 'round';
  pen.stroke();
}

/** The few that matter, on top. */
export function drawCommitted(shot: Shot): void {
  const { pen, theme } = shot;
  for (const role of [connector, worker, root]) {
    const radius = shot.radiusPx[role]!;
    const which = (i: number) => shot.role(i) === role && shot.isAlive(i);
    if (role === root) {
      traceCircles(shot, which, rootRing * radius);
      pen.fillStyle = theme.background; // what shines through between disc and ring would blur both
      pen.fill();
      pen.strokeStyle = theme.roles[root];
      pen.lineWidth = Math.max(2, 0.28 * radius);
      pen.stroke();
    }
    traceCircles(shot, which, radius);
    fill(shot, theme.roles[role]!, radius);
    if (role === worker) {
      traceCircles(shot, which, Math.max(1.5, 0.38 * radius));
      pen.fillStyle = '#ffffff';
      pen.fill();
    }
  }
}
