// SPDX-License-Identifier: MIT
// The picture of a run as SVG, for papers and slides: the same layers as on the screen, each a group with its name.
import type { Facts } from './facts';
import { haloAlpha, haloPx, LabelSprites, writingOf, type LabelSprite, type LabelStyle } from './label_sprites';
import { layers } from './layers/all';
import { drawGround, drawScaleBar } from './layers/ground';
import type { Labels } from './layers/labels';
import { drawObstacles } from './layers/obstacles';
import { crowd, crowdLinks, drawRadio, mostLinks } from './layers/radio';
import { Shot } from './shot';
import { element, escaped, SvgPen } from './svg_pen';
import type { Theme } from './themes';
import type { SceneView } from './view';

/** Labels as text instead of bitmaps, at the same places. */
class SvgLabels extends LabelSprites {
  private readonly words = new WeakMap<LabelSprite, { text: string; style: LabelStyle; theme: Theme }>();

  override get(text: string, style: LabelStyle, theme: Theme, ratio: number): LabelSprite {
    const sprite = super.get(text, style, theme, ratio);
    this.words.set(sprite, { text, style, theme });
    return sprite;
  }

  override put(pen: CanvasRenderingContext2D, sprite: LabelSprite, x: number, y: number): void {
    const { text, style, theme } = this.words.get(sprite)!;
    const [left, middle] = [x + haloPx, y + sprite.heightPx / 2];
    const write = pen as unknown as SvgPen;
    write.text(text, left, middle, writingOf(style, theme), {
      stroke: theme.background, 'stroke-width': haloPx, 'stroke-linejoin': 'round', 'stroke-opacity': haloAlpha, 'paint-order': 'stroke',
    });
  }
}

const captionPx = { sizePx: 13, leftPx: 12, firstPx: 16, linePx: 17 };

/** What a view shows, with its caption above. `labels`: those of the picture, which remember their sides. */
export function contentOf(view: SceneView, facts: Facts, labels: Labels, caption: readonly string[]): string {
  const pen = new SvgPen();
  const shot = new Shot();
  const sprites = new SvgLabels();
  sprites.use(view.theme, 1);
  shot.labels = sprites;
  shot.take(pen as unknown as CanvasRenderingContext2D, 1, view, facts);
  shot.linkBudget = shot.robots < crowd ? mostLinks : crowdLinks;
  pen.group('ground', () => drawGround(shot));
  pen.group('obstacles', () => drawObstacles(shot));
  pen.group('links', () => { drawRadio(shot); });
  for (const { name, draw } of layers) pen.group(name, () => draw(shot));
  pen.group('labels', () => labels.draw(shot));
  pen.group('scale', () => drawScaleBar(shot));
  pen.group('caption', () => caption.forEach((line, k) => pen.text(
    line, captionPx.leftPx, captionPx.firstPx + k * captionPx.linePx, { ...writingOf('scale', view.theme), sizePx: captionPx.sizePx, color: view.theme.text })));
  return pen.content;
}

export interface Part { widthPx: number; heightPx: number; content: string }

/** Runs side by side as one document. */
export function documentOf(parts: readonly Part[], title: string): string {
  const width = parts.reduce((sum, part) => sum + part.widthPx, 0);
  const height = Math.max(0, ...parts.map((part) => part.heightPx));
  let x = 0;
  const inside = parts.map(({ widthPx, heightPx, content }) => {
    const part = element('svg', { class: 'run', x, width: widthPx, height: heightPx }, `\n${content}\n`); // nothing sticks out of it
    x += widthPx;
    return part;
  });
  const head = element('title', {}, escaped(title));
  return `<?xml version="1.0" encoding="UTF-8"?>\n${element('svg', {
    xmlns: 'http://www.w3.org/2000/svg', width, height, viewBox: `0 0 ${width} ${height}`,
  }, `${head}\n${inside.join('\n')}`)}\n`;
}
