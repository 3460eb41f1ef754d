// SPDX-License-Identifier: MIT
// Radio links: the fine mesh behind everything else. If all robots hear each other it would cover all else, and
// drawing it takes most of the time: the more links, the fainter, and beyond a number only the shortest.
import type { Links } from '../links';
import type { Shot } from '../shot';
import { mixed } from '../themes';

/** Links that can be told apart in a window, and be drawn in some 10 ms without a GPU. */
export const mostLinks = 6000;
const lengthClasses = 64;

/** The length, px, up to which links are drawn: Infinity, or so that about `linkBudget` are. */
function longestPx(shot: Shot, pairs: Int32Array): number {
  if (pairs.length / 2 <= shot.linkBudget) return Infinity;
  const rangePx = shot.view.setting.range_m * shot.view.camera.scale * 1.1; // they may have moved since the tick
  const counts = new Int32Array(lengthClasses);
  let inSight = 0;
  for (let k = 0; k < pairs.length; k += 2) {
    const i = pairs[k]!, j = pairs[k + 1]!;
    if (!shot.lineInSight(i, j)) continue;
    ++inSight;
    const length = Math.hypot(shot.x[i]! - shot.x[j]!, shot.y[i]! - shot.y[j]!);
    ++counts[Math.min(lengthClasses - 1, Math.floor((lengthClasses * length) / rangePx))]!;
  }
  if (inSight <= shot.linkBudget) return Infinity;
  let sum = 0;
  let c = 0;
  while (c < lengthClasses - 1 && sum + counts[c]! <= shot.linkBudget) sum += counts[c++]!;
  return (rangePx * Math.max(1, c)) / lengthClasses;
}

/** Links that are drawn, and all that are in sight: fewer are drawn only when the longest are left out. `about`: so many
 *  robots that all are estimated. */
export interface RadioCount { drawn: number; all: number; about: boolean }

/** From this number on only the links that may be drawn are computed: all of 10,000 robots take longer than a tick. */
export const crowd = 2000;
/** Of those: more would be drawn anew with every tick, over the whole picture, and tell no more. */
export const crowdLinks = 2000;
const spareShare = 1.2; // of the budget: the estimate may be low

/** The links to choose from, and about how many others there are. */
function linksOf(shot: Shot): Links & { others: number } {
  if (shot.robots < crowd) return { ...shot.facts.links, others: 0 };
  const { linkBudget, facts: { radio } } = shot;
  const seen = new Uint8Array(shot.facts.frame.robots);
  for (let i = 0; i < shot.robots; ++i) if (shot.inSight(shot.x[i]!, shot.y[i]!, 0)) seen[i] = 1;
  const { lengthM, pairs } = radio.lengthFor(spareShare * linkBudget, seen);
  const found = radio.linksWithin(lengthM, seen);
  return { ...found, others: Math.max(0, Math.round(pairs) - (found.open.length + found.blocked.length) / 2) };
}

/** Draws the pairs as one path and counts them. */
function strokePairs(shot: Shot, pairs: Int32Array, dashed: boolean, count: RadioCount): void {
  const { pen, x, y } = shot;
  const longest2 = Math.pow(longestPx(shot, pairs), 2);
  pen.beginPath();
  for (let k = 0; k < pairs.length; k += 2) {
    const i = pairs[k]!, j = pairs[k + 1]!;
    if (!shot.lineInSight(i, j)) continue;
    ++count.all;
    const dx = x[i]! - x[j]!, dy = y[i]! - y[j]!;
    if (dx * dx + dy * dy > longest2) continue;
    if (dashed) shot.shortLine(i, j);
    else shot.line(i, j);
    ++count.drawn;
  }
  pen.stroke();
}

/** 1 for a sparse net, down to a third where each has dozens of links. */
function faintness(pairs: Int32Array, shot: Shot): number {
  const perRobot = Math.min(pairs.length / 2, mostLinks) / Math.max(1, shot.robots);
  const faint = Math.max(0.3, 5 / Math.max(1, perRobot));
  return Math.min(1, Math.sqrt(shot.ratio) * faint); // finer pixels need more ink
}

export function drawRadio(shot: Shot): RadioCount {
  const { pen, view, theme } = shot;
  const { links, blocked } = view.switches;
  const count = { drawn: 0, all: 0, about: false };
  if (!links && !blocked) return count;
  const found = linksOf(shot);
  pen.lineCap = 'butt';
  // One device pixel: lines up to that width are drawn one by one, wider ones as a single huge area, ten times slower.
  pen.lineWidth = 1 / shot.ratio;
  if (links) {
    pen.strokeStyle = mixed(theme.link, theme.background, faintness(found.open, shot));
    strokePairs(shot, found.open, false, count);
  }
  if (blocked && found.blocked.length > 0) {
    pen.strokeStyle = mixed(theme.blocked, theme.background, Math.max(0.5, faintness(found.blocked, shot)));
    // Dashes cost several times a plain line: only while there are few.
    const dashed = found.blocked.length / 2 < mostLinks / 4;
    if (dashed) pen.setLineDash([3, 4]);
    shot.linkBudget /= 2; // they come on top of the others
    strokePairs(shot, found.blocked, dashed, count);
    pen.setLineDash([]);
  }
  count.all += found.others;
  count.about = found.others > 0;
  return count;
}
