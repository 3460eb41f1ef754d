// SPDX-License-Identifier: MIT
// Names of targets, ids, labels. Those that matter most are placed first, each where it covers no other; what finds no
// place is left out. A label stays on the side it was on, or a moving swarm would flicker.
import { column } from '../../frame';
import { toPxX, toPxY } from '../camera';
import type { LabelSprite, LabelStyle } from '../label_sprites';
import { sameItem, type Item } from '../view';
import { connector, root, spare, worker, type Shot } from '../shot';
import { targetRadiusPx } from './targets';

const cellPx = 8;
/** Sides of a robot where its label may stand: dx, dy in -1..1, in the order of preference. */
const sides = [[1, 1], [1, -1], [-1, 1], [-1, -1]] as const;
const mostLabels = 300;

const isRobot = (item: Item | null, i: number) => item?.kind === 'robot' && item.index === i;

/** Which parts of the picture are taken, in cells of 8 px. */
class Taken {
  private cells = new Uint8Array(0);
  private columns = 0;
  private rows = 0;

  clear(widthPx: number, heightPx: number): void {
    this.columns = Math.ceil(widthPx / cellPx) + 1;
    this.rows = Math.ceil(heightPx / cellPx) + 1;
    if (this.cells.length < this.columns * this.rows) this.cells = new Uint8Array(this.columns * this.rows);
    else this.cells.fill(0);
  }

  /** Takes the rectangle if it is free, and says whether it was. */
  take(x: number, y: number, widthPx: number, heightPx: number): boolean {
    const left = Math.max(0, Math.floor(x / cellPx));
    const right = Math.min(this.columns - 1, Math.floor((x + widthPx) / cellPx));
    const top = Math.max(0, Math.floor(y / cellPx));
    const bottom = Math.min(this.rows - 1, Math.floor((y + heightPx) / cellPx));
    for (let r = top; r <= bottom; ++r) {
      for (let c = left; c <= right; ++c) if (this.cells[r * this.columns + c]) return false;
    }
    for (let r = top; r <= bottom; ++r) this.cells.fill(1, r * this.columns + left, r * this.columns + right + 1);
    return true;
  }
}

export class Labels {
  private readonly taken = new Taken();
  private side = new Int8Array(0); // by robot
  private readonly targetSide = new Map<number, number>();

  draw(shot: Shot): void {
    const { camera } = shot.view;
    this.taken.clear(camera.widthPx, camera.heightPx);
    if (this.side.length < shot.robots) this.side = new Int8Array(shot.robots);
    this.targets(shot);
    this.robots(shot);
  }

  private targets(shot: Shot): void {
    const { view, labels, theme, pen, ratio } = shot;
    const { targets } = view.frame;
    const away = 0.72 * targetRadiusPx(shot) + 1;
    for (let k = 0; k < targets.x.length; ++k) {
      const sprite = labels.get(`T${k}`, 'target', theme, ratio);
      const x = toPxX(view.camera, targets.x[k]!), y = toPxY(view.camera, targets.y[k]!);
      if (!shot.inSight(x, y, away)) continue;
      const side = freestSide(shot, x, y, away, sprite, this.targetSide.get(k));
      this.targetSide.set(k, side);
      const at = corner(x, y, away, side, sprite);
      this.taken.take(at.x, at.y, sprite.widthPx, sprite.heightPx);
      labels.put(pen, sprite, at.x, at.y, ratio);
    }
  }

  private robots(shot: Shot): void {
    const { switches, selection, hovered } = shot.view;
    const strong = sameItem(selection, hovered) ? [selection] : [selection, hovered];
    for (const item of strong) {
      if (item?.kind === 'robot' && item.index < shot.robots) this.robot(shot, item.index, true);
    }
    if (!switches.ids && !switches.labels) return;
    let written = 0;
    for (const role of [root, worker, connector, spare]) {
      for (let i = 0; i < shot.robots && written < mostLabels; ++i) {
        const done = isRobot(selection, i) || isRobot(hovered, i);
        if (!done && shot.role(i) === role && shot.isAlive(i) && this.robot(shot, i, false)) ++written;
      }
    }
  }

  /** `always`: at the first side even if it covers another, and with everything there is to say. */
  private robot(shot: Shot, i: number, always: boolean): boolean {
    const { x, y, labels, theme, pen, view, ratio } = shot;
    if (!shot.inSight(x[i]!, y[i]!, 0)) return false;
    const text = words(shot, i, view.switches.ids || always, view.switches.labels);
    if (text === '') return false;
    const style: LabelStyle = always ? 'strong' : 'id';
    const sprite = labels.get(text, style, theme, ratio);
    const away = (shot.role(i) === root ? 1.35 : 0.7) * shot.radiusOf(i) + 1;
    for (let k = 0; k < sides.length; ++k) {
      const side = (this.side[i]! + k) % sides.length;
      const at = corner(x[i]!, y[i]!, away, side, sprite);
      if (!this.taken.take(at.x + 3, at.y + 4, sprite.widthPx - 6, sprite.heightPx - 8) && !(always && k === 0)) continue;
      this.side[i] = side;
      labels.put(pen, sprite, at.x, at.y, ratio);
      return true;
    }
    return false;
  }
}

/** Upper right first, as in the still pictures. */
const targetSides = [1, 3, 0, 2] as const;

/** The side it was on, or else the first, where it would cover no part of the tree. */
function freestSide(
  shot: Shot, x: number, y: number, away: number, sprite: LabelSprite, last: number | undefined,
): number {
  const { camera } = shot.view;
  for (const side of last === undefined ? targetSides : [last, ...targetSides]) {
    const at = corner(x, y, away, side, sprite);
    const right = at.x + sprite.widthPx, bottom = at.y + sprite.heightPx;
    if (at.x < 0 || at.y < 0 || right > camera.widthPx || bottom > camera.heightPx) continue;
    const covers = (px: number, py: number) => px > at.x - 6 && px < right + 6 && py > at.y - 6 && py < bottom + 6;
    if (!shot.facts.edges.some(({ from, to }) => passesThrough(shot, from, to, covers))) return side;
  }
  return targetSides[0];
}

const steps = 8; // points of an edge that are looked at

function passesThrough(shot: Shot, from: number, to: number, covers: (x: number, y: number) => boolean): boolean {
  for (let k = 0; k <= steps; ++k) {
    const t = k / steps;
    if (covers((1 - t) * shot.x[from]! + t * shot.x[to]!, (1 - t) * shot.y[from]! + t * shot.y[to]!)) return true;
  }
  return false;
}

const place = { x: 0, y: 0 };

/** The upper left corner of a label at that side; the halo's width may overlap the robot. */
function corner(x: number, y: number, awayPx: number, side: number, sprite: LabelSprite): { x: number; y: number } {
  const [dx, dy] = sides[side]!;
  place.x = dx > 0 ? x + awayPx - 2 : x - awayPx - sprite.widthPx + 2;
  place.y = dy > 0 ? y + awayPx - 4 : y - awayPx - sprite.heightPx + 4;
  return place;
}

function words(shot: Shot, i: number, id: boolean, label: boolean): string {
  if (!label) return id ? String(i) : '';
  const labelM = column(shot.facts.frame, 'label_m')[i]!;
  const depth = column(shot.facts.frame, 'depth')[i]!;
  const parts = id ? [String(i)] : [];
  if (labelM >= 0 && shot.role(i) !== spare) parts.push(`${labelM.toFixed(1)} m`);
  if (depth > 0 && shot.role(i) !== spare) parts.push(`d${depth}`);
  return parts.join(' · ');
}
