// SPDX-License-Identifier: MIT
// The trees. The current one in ink, an edge the thicker the more robots are below it, as in the tree Banyan is named
// after; the old one in dashed orange beside it; edges that do not hold in dotted vermillion with a break mark.
import type { Edge } from '../facts';
import { connector, thinnestEdgePx, type Shot } from '../shot';

const widths = 5; // steps of thickness, a path each

/** Step of thickness of the edge above a subtree of `size`, of `all`. */
function step(size: number, all: number): number {
  const share = Math.sqrt(size - 1) / Math.max(1, Math.sqrt(all - 1));
  return Math.min(widths - 1, Math.floor(share * widths));
}

function thickestPx(shot: Shot): number {
  return Math.min(12, Math.max(4.5, 0.9 * shot.radiusPx[connector]!));
}

export function drawTree(shot: Shot): void {
  const { pen, theme, facts, view } = shot;
  const sizes = facts.subtreeSizes;
  let all = 1;
  for (let i = 0; i < shot.robots; ++i) all = Math.max(all, sizes[i]!);
  const thickest = thickestPx(shot);
  pen.lineCap = 'round';
  if (view.switches.oldTree) drawOldTree(shot);
  const broken = facts.broken.filter((e) => !e.old || view.switches.oldTree);
  strokeAll(shot, broken, theme.background, 6); // a halo, which must not interrupt edges that hold
  pen.lineCap = 'round';
  pen.strokeStyle = theme.tree;
  for (let w = 0; w < widths; ++w) {
    pen.beginPath();
    for (const edge of facts.edges) {
      if (edge.old || edge.link !== 'open' || step(sizes[edge.from]!, all) !== w) continue;
      if (shot.lineInSight(edge.from, edge.to)) shot.line(edge.from, edge.to);
    }
    pen.lineWidth = thinnestEdgePx + ((thickest - thinnestEdgePx) * w) / (widths - 1);
    pen.stroke();
  }
  drawBroken(shot, broken);
}

function drawOldTree(shot: Shot): void {
  const { pen, theme, facts } = shot;
  pen.beginPath();
  for (const edge of facts.edges) {
    if (!edge.old || edge.link !== 'open' || !shot.lineInSight(edge.from, edge.to)) continue;
    // Where old and new edge are one, the old one is seen as a dashed seam to both sides.
    shot.shortLine(edge.from, edge.to);
  }
  pen.lineCap = 'butt';
  pen.strokeStyle = theme.oldTree;
  pen.lineWidth = Math.max(4.5, 0.9 * thickestPx(shot));
  pen.setLineDash([8, 6]);
  pen.stroke();
  pen.setLineDash([]);
  pen.lineCap = 'round';
}

/** Half the length of a break mark, px. */
const markOf = (shot: Shot) => Math.min(7, Math.max(4, 1.1 * shot.bodyPx));

function strokeAll(shot: Shot, edges: readonly Edge[], color: string, widthPx: number): void {
  const { pen } = shot;
  pen.beginPath();
  for (const { from, to } of edges) shot.shortLine(from, to);
  pen.strokeStyle = color;
  pen.lineWidth = widthPx;
  pen.stroke();
}

/** Above the edges that hold: what hides a parent is often a robot of the tree, and its edge runs along the broken one. */
function drawBroken(shot: Shot, edges: readonly Edge[]): void {
  if (edges.length === 0) return;
  shot.pen.setLineDash([0, 6]);
  strokeAll(shot, edges, shot.theme.broken, 3);
  shot.pen.setLineDash([]);
  drawBreakMarks(shot, edges);
}

/** Two strokes across the middle, as engineers mark a break. */
function drawBreakMarks(shot: Shot, edges: readonly Edge[]): void {
  const { pen, theme, x, y } = shot;
  const reach = markOf(shot);
  const gap = 0.36 * reach;
  const trace = () => {
    pen.beginPath();
    for (const { from, to } of edges) {
      const dx = x[to]! - x[from]!, dy = y[to]! - y[from]!;
      const length = Math.hypot(dx, dy);
      if (length < 4 * reach) continue; // the dots must do
      const ux = dx / length, uy = dy / length;
      const mx = (x[from]! + x[to]!) / 2, my = (y[from]! + y[to]!) / 2;
      for (const side of [-gap, gap]) {
        const cx = mx + side * ux, cy = my + side * uy;
        // Slanted by a third against the edge.
        const ax = reach * (-uy + 0.45 * ux), ay = reach * (ux + 0.45 * uy);
        pen.moveTo(cx - ax, cy - ay);
        pen.lineTo(cx + ax, cy + ay);
      }
    }
  };
  pen.lineCap = 'round';
  trace();
  pen.strokeStyle = theme.background;
  pen.lineWidth = 2 * gap + 1.5;
  pen.stroke();
  pen.strokeStyle = theme.broken;
  pen.lineWidth = 0.32 * reach;
  pen.stroke();
}
