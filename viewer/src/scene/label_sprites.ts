// SPDX-License-Identifier: MIT
// Labels as small bitmaps. Drawing text with a halo costs some 50 times as much as copying it, and ids do not change.
import type { Theme } from './themes';

export interface LabelSprite { image: ImageBitmap | HTMLCanvasElement; widthPx: number; heightPx: number }
export type LabelStyle = 'id' | 'strong' | 'target' | 'scale';

const family = 'system-ui, -apple-system, "Segoe UI", Roboto, Helvetica, Arial, sans-serif';
const sizesPx: Record<LabelStyle, number> = { id: 11, strong: 13, target: 14, scale: 12 };
const most = 4000;
export const haloPx = 3;
export const haloAlpha = 0.85;

export class LabelSprites {
  private readonly made = new Map<string, LabelSprite>();
  private key = '';

  /** Bitmaps are for one theme and one pixel ratio. */
  use(theme: Theme, ratio: number): void {
    const key = `${theme.name} ${theme.background} ${ratio}`;
    if (key !== this.key) this.made.clear();
    this.key = key;
  }

  get(text: string, style: LabelStyle, theme: Theme, ratio: number): LabelSprite {
    const key = style + text;
    let sprite = this.made.get(key);
    if (!sprite) {
      if (this.made.size >= most) this.made.clear();
      sprite = write(text, style, theme, ratio);
      this.made.set(key, sprite);
    }
    return sprite;
  }

  /** Upper left corner at (x, y), px; on whole pixels, so that it stays sharp. */
  put(pen: CanvasRenderingContext2D, sprite: LabelSprite, x: number, y: number, ratio: number): void {
    const left = Math.round(x * ratio) / ratio;
    const top = Math.round(y * ratio) / ratio;
    pen.drawImage(sprite.image, left, top, sprite.widthPx, sprite.heightPx);
  }
}

/** How a label is written, on a canvas or elsewhere. */
export function writingOf(style: LabelStyle, theme: Theme): { sizePx: number; weight: number; family: string; color: string } {
  return {
    sizePx: sizesPx[style], weight: style === 'target' || style === 'strong' ? 600 : 400, family,
    color: style === 'target' ? theme.targetText : style === 'scale' ? theme.quietText : theme.text,
  };
}

function blank(): OffscreenCanvas | HTMLCanvasElement {
  return typeof OffscreenCanvas === 'undefined' ? document.createElement('canvas') : new OffscreenCanvas(1, 1);
}

function write(text: string, style: LabelStyle, theme: Theme, ratio: number): LabelSprite {
  const canvas = blank();
  const pen = canvas.getContext('2d') as CanvasRenderingContext2D | OffscreenCanvasRenderingContext2D;
  const { sizePx: size, weight, color } = writingOf(style, theme);
  const font = `${weight} ${size}px ${family}`;
  pen.font = font;
  const device = (px: number) => Math.max(1, Math.ceil(px * ratio));
  canvas.width = device(pen.measureText(text).width + 2 * haloPx);
  canvas.height = device(size * 1.1 + 2 * haloPx);
  const [widthPx, heightPx] = [canvas.width / ratio, canvas.height / ratio];
  pen.scale(ratio, ratio);
  pen.font = font; // setting the size has reset it
  pen.textBaseline = 'middle';
  pen.lineJoin = 'round';
  pen.lineWidth = haloPx;
  pen.strokeStyle = theme.background;
  pen.globalAlpha = haloAlpha;
  pen.strokeText(text, haloPx, heightPx / 2);
  pen.globalAlpha = 1;
  pen.fillStyle = color;
  pen.fillText(text, haloPx, heightPx / 2);
  // A bitmap that cannot change any more is copied faster than a canvas.
  const image = 'transferToImageBitmap' in canvas ? canvas.transferToImageBitmap() : canvas;
  return { image, widthPx, heightPx };
}
