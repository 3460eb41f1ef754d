// SPDX-License-Identifier: MIT
// Robots by role. Besides its colour each has a mark of its own, for grey prints and colour-blind eyes: the root a
// ring, a worker a white dot, a dead robot a cross. A disc at a time, its outline as a larger disc below: without a GPU
// that is three times as fast as one path of them all that is filled and stroked.
import { connector, root, spare, worker, type Shot } from '../shot';

const circle = 2 * Math.PI;
/** Radius of the root's ring in radii of the root. */
export const rootRing = 1.65;
const headingFromPx = 4; // smaller robots have no room for a heading

type Which = (i: number) => boolean;

function disc(pen: CanvasRenderingContext2D, x: number, y: number, radius: number, color: string): void {
  pen.fillStyle = color;
  pen.beginPath();
  pen.arc(x, y, radius, 0, circle);
  pen.fill();
}

/** With an outline: thin, but without one yellow would not be seen on white. */
function discs(shot: Shot, which: Which, radius: number, color: string, inner?: (x: number, y: number) => void): void {
  const { pen, theme, x, y } = shot;
  const half = Math.min(1.2, Math.max(0.7, 0.18 * radius)) / 2;
  for (let i = 0; i < shot.robots; ++i) {
    if (!which(i) || !shot.inSight(x[i]!, y[i]!, 2 * radius)) continue;
    disc(pen, x[i]!, y[i]!, radius + half, theme.outline);
    disc(pen, x[i]!, y[i]!, radius - half, color);
    inner?.(x[i]!, y[i]!);
  }
}

/** Squares look like discs at two pixels and are filled much faster. */
function fillDots(shot: Shot, which: Which, radius: number, color: string): void {
  const { pen, x, y, ratio, dotted, view: { camera } } = shot;
  const seen: number[] = [];
  let left = Infinity, top = Infinity, right = -Infinity, bottom = -Infinity;
  for (let i = 0; i < shot.robots; ++i) {
    if (!which(i) || !shot.inSight(x[i]!, y[i]!, radius)) continue;
    seen.push(i);
    left = Math.min(left, x[i]!);
    right = Math.max(right, x[i]!);
    top = Math.min(top, y[i]!);
    bottom = Math.max(bottom, y[i]!);
  }
  if (seen.length === 0) return;
  const fromX = Math.floor(Math.max(0, left - radius) * ratio), fromY = Math.floor(Math.max(0, top - radius) * ratio);
  dotted.begin(Math.min(camera.widthPx, right + radius) * ratio - fromX, Math.min(camera.heightPx, bottom + radius) * ratio - fromY, color);
  const side = 1.8 * radius * ratio;
  for (const i of seen) dotted.bitmap.add(x[i]! * ratio - fromX, y[i]! * ratio - fromY, side);
  dotted.draw(pen, fromX, fromY, ratio);
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

/** Below the tree, which the many spares must not hide. */
export function drawSparesAndDead(shot: Shot): void {
  const { theme } = shot;
  const isSpare = (i: number) => shot.role(i) === spare && shot.isAlive(i);
  const radius = shot.radiusPx[spare]!;
  if (shot.dots) {
    fillDots(shot, isSpare, radius, theme.dot);
  } else {
    discs(shot, isSpare, radius, theme.roles[spare]);
  }
  drawDead(shot);
}

function drawDead(shot: Shot): void {
  const { pen, theme, x, y } = shot;
  const isDead = (i: number) => !shot.isAlive(i);
  const radius = shot.radiusPx[connector]!;
  for (let i = 0; i < shot.robots; ++i) {
    if (isDead(i) && shot.inSight(x[i]!, y[i]!, radius)) disc(pen, x[i]!, y[i]!, radius, theme.dead);
  }
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
  const { theme, pen } = shot;
  const is = (role: number): Which => (i) => shot.role(i) === role && shot.isAlive(i);
  discs(shot, is(connector), shot.radiusPx[connector]!, theme.roles[connector]);
  const dot = Math.max(1.5, 0.38 * shot.radiusPx[worker]!);
  discs(shot, is(worker), shot.radiusPx[worker]!, theme.roles[worker], (x, y) => disc(pen, x, y, dot, '#ffffff'));
  drawRoots(shot, is(root));
}

function drawRoots(shot: Shot, isRoot: Which): void {
  const { pen, theme, x, y } = shot;
  const radius = shot.radiusPx[root]!;
  const half = Math.max(2, 0.28 * radius) / 2;
  for (let i = 0; i < shot.robots; ++i) {
    if (!isRoot(i) || !shot.inSight(x[i]!, y[i]!, 2 * radius)) continue;
    disc(pen, x[i]!, y[i]!, rootRing * radius + half, theme.roles[root]);
    // What shines through between disc and ring would blur both.
    disc(pen, x[i]!, y[i]!, rootRing * radius - half, theme.background);
  }
  discs(shot, isRoot, radius, theme.roles[root]);
}
