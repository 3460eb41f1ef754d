// SPDX-License-Identifier: MIT
// What the layers share while one picture is drawn: all robots' places and sizes in pixels, and what to draw with.
// One object lives as long as the scene; its arrays are refilled for each picture.
import { column, roles } from '../frame';
import { toPxX, toPxY } from './camera';
import { Dots } from './dots';
import type { Facts } from './facts';
import type { LabelSprites } from './label_sprites';
import type { Theme } from './themes';
import type { SceneView } from './view';

export const spare = 0, connector = 1, worker = 2, root = 3;
export const roleCount = roles.length;

/** Radii in px below which a robot of this role could not be told apart, by role; many robots get smaller ones. */
const smallestPx = [2.6, 4.2, 5, 6] as const;
const smallestOfManyPx = [1.6, 2.8, 3.8, 5] as const;
export const many = 500;

/** Bounds for the tree's lines, px: the outermost edge, and one with all robots below it. */
export const thinnestEdgePx = 1.8;

export class Shot {
  pen!: CanvasRenderingContext2D;
  view!: SceneView;
  facts!: Facts;
  theme!: Theme;
  labels!: LabelSprites;
  robots = 0;
  /** Device pixels per CSS pixel. */
  ratio = 1;
  /** Pixels. */
  x = new Float64Array(0);
  y = new Float64Array(0);
  heading!: Float64Array;
  /** Of a robot's body on the screen, px. */
  bodyPx = 0;
  /** Of the mark of a robot of each role, px. */
  readonly radiusPx = [0, 0, 0, 0];
  /** Radio links that may be drawn. */
  linkBudget = Infinity;
  readonly dotted = new Dots();
  /** So many and so small that robots are dots: no outline, no heading. */
  dots = false;

  take(pen: CanvasRenderingContext2D, ratio: number, view: SceneView, facts: Facts): void {
    this.pen = pen;
    this.ratio = ratio;
    this.view = view;
    this.facts = facts;
    this.theme = view.theme;
    this.robots = Math.min(view.frame.robots, facts.frame.robots);
    this.place();
    this.bodyPx = view.setting.radius_m * view.camera.scale;
    const smallest = this.robots >= many ? smallestOfManyPx : smallestPx;
    for (let r = 0; r < roleCount; ++r) this.radiusPx[r] = Math.max(smallest[r]!, this.bodyPx);
    this.dots = this.robots >= many && this.bodyPx < 3.5;
  }

  private place(): void {
    const { frame, camera } = this.view;
    if (this.x.length < this.robots) {
      this.x = new Float64Array(this.robots);
      this.y = new Float64Array(this.robots);
    }
    const xM = column(frame, 'x_m');
    const yM = column(frame, 'y_m');
    for (let i = 0; i < this.robots; ++i) {
      this.x[i] = toPxX(camera, xM[i]!);
      this.y[i] = toPxY(camera, yM[i]!);
    }
    this.heading = column(frame, 'heading_rad');
  }

  role(i: number): number { return this.facts.role[i]!; }
  isAlive(i: number): boolean { return this.facts.alive[i] === 1; }
  radiusOf(i: number): number { return this.radiusPx[this.isAlive(i) ? this.role(i) : connector]!; }

  /** Is any part of a mark at this place, so large, in the picture? */
  inSight(x: number, y: number, reachPx: number): boolean {
    const { widthPx, heightPx } = this.view.camera;
    return x > -reachPx && y > -reachPx && x < widthPx + reachPx && y < heightPx + reachPx;
  }

  /** Could a line between two robots be seen? */
  lineInSight(i: number, j: number): boolean {
    const { widthPx, heightPx } = this.view.camera;
    const x = this.x, y = this.y;
    if (i >= this.robots || j >= this.robots) return false;
    return !((x[i]! < 0 && x[j]! < 0) || (y[i]! < 0 && y[j]! < 0) ||
      (x[i]! > widthPx && x[j]! > widthPx) || (y[i]! > heightPx && y[j]! > heightPx));
  }

  /** The part of a line that may be seen: a dashed line that goes far beyond the picture would take seconds. The
   *  dashes stay where they are, as it is cut by whole periods from the end of i. */
  shortLine(i: number, j: number): void {
    if (!this.lineInSight(i, j)) return;
    const { widthPx, heightPx } = this.view.camera;
    const ax = this.x[i]!, ay = this.y[i]!, dx = this.x[j]! - ax, dy = this.y[j]! - ay;
    const length = Math.hypot(dx, dy);
    const reach = widthPx + heightPx;
    if (!(length > reach)) return this.line(i, j);
    // From the point nearest to the middle of the picture, as far as the picture can reach.
    const middle = ((widthPx / 2 - ax) * dx + (heightPx / 2 - ay) * dy) / length;
    const period = 42; // a multiple of all dashes in use, px
    const from = Math.max(0, Math.floor((middle - reach) / period) * period);
    const to = Math.min(length, middle + reach);
    this.pen.moveTo(ax + (dx * from) / length, ay + (dy * from) / length);
    this.pen.lineTo(ax + (dx * to) / length, ay + (dy * to) / length);
  }

  line(i: number, j: number): void {
    this.pen.moveTo(this.x[i]!, this.y[i]!);
    this.pen.lineTo(this.x[j]!, this.y[j]!);
  }
}
