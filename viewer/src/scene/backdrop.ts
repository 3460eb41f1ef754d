// SPDX-License-Identifier: MIT
// Ground, obstacles and radio links as one bitmap that is kept until the next tick or until the camera moves. Between
// two ticks a robot moves by less than its own radius, so the ends of links stay hidden below the bodies; and thousands
// of links are what takes most of the time. Where even that is too slow, fewer are drawn while the camera moves.
import type { Facts } from './facts';
import { drawGround } from './layers/ground';
import { drawObstacles } from './layers/obstacles';
import { crowd, crowdLinks, drawRadio, mostLinks, type RadioCount } from './layers/radio';
import type { Shot } from './shot';
import type { SceneView } from './view';

const keepFromLinks = 1500; // fewer are drawn with every frame, and follow the robots to the pixel
const linksInMotion = 1200;
const slowMs = 6; // of the 16 of a frame

export class Backdrop {
  private canvas: HTMLCanvasElement | null = null;
  private facts: Facts | null = null;
  private view: SceneView | null = null;
  private ratio = 0;
  private count: RadioCount = { drawn: 0, all: 0, about: false };
  private fullMs = 0; // what all links took the last time
  private isCoarse = false;

  /** Links are missing because the camera moved: draw again when it stands still. */
  get coarse(): boolean { return this.isCoarse; }

  draw(shot: Shot): RadioCount {
    shot.linkBudget = shot.robots < crowd ? mostLinks : crowdLinks;
    if (!isWorthKeeping(shot)) {
      this.isCoarse = false;
      return drawAll(shot);
    }
    const { pen, view } = shot;
    const { widthPx, heightPx } = view.camera;
    const start = performance.now();
    const isNew = !this.holds(shot);
    if (isNew) {
      this.isCoarse = this.fullMs > slowMs && this.view !== null && !sameCamera(this.view, view);
      if (this.isCoarse) shot.linkBudget = linksInMotion;
      this.make(shot);
    }
    pen.drawImage(this.canvas!, 0, 0, widthPx, heightPx); // without a GPU this waits for the bitmap
    if (isNew && !this.isCoarse) this.fullMs = performance.now() - start;
    return this.count;
  }

  private holds({ view, facts, ratio }: Shot): boolean {
    const last = this.view;
    if (last === null || this.isCoarse || this.facts !== facts || this.ratio !== ratio) return false;
    const { links, blocked } = last.switches;
    return last.theme === view.theme && sameCamera(last, view) &&
      links === view.switches.links && blocked === view.switches.blocked;
  }

  private make(shot: Shot): void {
    const { pen, view, facts, ratio } = shot;
    const canvas = (this.canvas ??= document.createElement('canvas'));
    const width = Math.max(1, Math.round(view.camera.widthPx * ratio));
    const height = Math.max(1, Math.round(view.camera.heightPx * ratio));
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    shot.pen = canvas.getContext('2d', { alpha: false })!;
    shot.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.count = drawAll(shot);
    shot.pen = pen;
    this.facts = facts;
    this.ratio = ratio;
    this.view = { ...view }; // the caller may change its own
  }
}

function isWorthKeeping({ view: { switches }, facts, robots }: Shot): boolean {
  if (!switches.links && !switches.blocked) return false;
  if (robots >= crowd) return true;
  const { open, blocked } = facts.links;
  const links = (switches.links ? open.length : 0) + (switches.blocked ? blocked.length : 0);
  return links / 2 >= keepFromLinks;
}

function sameCamera({ camera: a }: SceneView, { camera: b }: SceneView): boolean {
  return a.xM === b.xM && a.yM === b.yM && a.scale === b.scale && a.widthPx === b.widthPx && a.heightPx === b.heightPx;
}

function drawAll(shot: Shot): RadioCount {
  drawGround(shot);
  drawObstacles(shot);
  return drawRadio(shot);
}
