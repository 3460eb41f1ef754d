// SPDX-License-Identifier: MIT
// The picture of a run: a canvas and its layers, redrawn whenever the page says that something has changed. Why
// Canvas 2D: it is several times as fast as WebGL where there is no GPU (docs/viewer.md).
import { Backdrop } from './backdrop';
import { FactsCache, type Facts } from './facts';
import { LabelSprites } from './label_sprites';
import { layers } from './layers/all';
import { drawScaleBar } from './layers/ground';
import { Labels } from './layers/labels';
import type { RadioCount } from './layers/radio';
import { Shot } from './shot';
import { Surface } from './surface';
import { contentOf } from './svg';
import type { Theme } from './themes';
import type { SceneView } from './view';

const stillMs = 150; // a camera that has not moved for so long stands still

export class Scene {
  private readonly surface: Surface;
  private readonly factsCache = new FactsCache();
  private readonly sprites = new LabelSprites();
  private readonly labels = new Labels();
  private readonly backdrop = new Backdrop();
  private later: ReturnType<typeof setTimeout> | undefined;
  private readonly shot = new Shot();
  private count: RadioCount = { drawn: 0, all: 0, about: false };

  /** `changed` is called when the picture has to be drawn again for reasons of its own: it was resized, moved to a
   *  screen with other pixels, its tab is shown again, or the camera stands still and what was left out is due. */
  constructor(host: HTMLElement, theme: Theme, private readonly changed: () => void = () => {}) {
    this.surface = new Surface(host, theme.background, changed);
  }

  get canvas(): HTMLCanvasElement { return this.surface.canvas; }
  get widthPx(): number { return this.surface.widthPx; }
  get heightPx(): number { return this.surface.heightPx; }

  /** Of the last picture: radio links that are drawn, of all that are in sight; fewer when they would only make a
   *  grey area. */
  get radioLinks(): RadioCount { return this.count; }

  /** Links, edges and neighbours of the instant that is shown, for panels; as computed for the picture. */
  facts(view: SceneView): Facts { return this.factsCache.of(view.frame, view.recorded, view.setting); }

  draw(view: SceneView): void {
    if (document.hidden) return; // not visible; `changed` comes when it is
    const pen = this.surface.begin();
    const { shot } = this;
    const ratio = this.surface.ratio;
    this.sprites.use(view.theme, ratio);
    shot.labels = this.sprites;
    shot.take(pen, ratio, view, this.facts(view));
    this.count = this.backdrop.draw(shot);
    for (const layer of layers) layer.draw(shot);
    if (!view.bare) this.labels.draw(shot);
    if (!view.bare) drawScaleBar(shot);
    this.drawAgainLater();
  }

  /** The same picture as the content of an SVG. */
  svg(view: SceneView, caption: readonly string[]): string {
    return contentOf(view, this.facts(view), this.labels, caption);
  }

  dispose(): void {
    clearTimeout(this.later);
    this.surface.dispose();
  }

  private drawAgainLater(): void {
    clearTimeout(this.later);
    if (this.backdrop.coarse) this.later = setTimeout(this.changed, stillMs);
  }
}
