// SPDX-License-Identifier: MIT
// A canvas that fills its host, with as many pixels as the screen has there.

const mostRatio = 3; // more is invisible and expensive
/** Device pixels in one picture at most: beyond, a large screen without a GPU would crawl. */
const mostPixels = 8.5e6;

export class Surface {
  readonly canvas: HTMLCanvasElement;
  /** CSS pixels. */
  widthPx = 0;
  heightPx = 0;
  /** Device pixels per CSS pixel. */
  ratio = 1;
  private readonly pen: CanvasRenderingContext2D;
  private readonly observer: ResizeObserver;
  private readonly stop = new AbortController();

  constructor(private readonly host: HTMLElement, background: string, private readonly changed: () => void) {
    this.canvas = document.createElement('canvas');
    Object.assign(this.canvas.style, { display: 'block', width: '100%', height: '100%', background });
    host.append(this.canvas);
    const pen = this.canvas.getContext('2d', { alpha: false });
    if (!pen) throw new Error('this browser has no canvas to draw on');
    this.pen = pen;
    this.observer = new ResizeObserver(() => { if (this.measure()) this.changed(); });
    this.observer.observe(host);
    document.addEventListener('visibilitychange', () => {
      if (!document.hidden) this.changed();
    }, { signal: this.stop.signal });
    this.watchRatio();
    this.measure();
  }

  /** The pen, in CSS pixels and in its initial state as far as layers rely on it. */
  begin(): CanvasRenderingContext2D {
    const width = Math.max(1, Math.round(this.widthPx * this.ratio));
    const height = Math.max(1, Math.round(this.heightPx * this.ratio));
    // Only here, right before drawing: setting the size clears the canvas, and an empty one would flash.
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const { pen } = this;
    pen.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    pen.globalAlpha = 1;
    pen.setLineDash([]);
    return pen;
  }

  dispose(): void {
    this.observer.disconnect();
    this.stop.abort();
    this.canvas.remove();
  }

  /** Whether size or ratio have changed. */
  private measure(): boolean {
    const width = this.host.clientWidth;
    const height = this.host.clientHeight;
    const area = Math.max(1, width * height);
    const ratio = Math.min(globalThis.devicePixelRatio || 1, mostRatio, Math.max(1, Math.sqrt(mostPixels / area)));
    if (width === this.widthPx && height === this.heightPx && ratio === this.ratio) return false;
    this.widthPx = width;
    this.heightPx = height;
    this.ratio = ratio;
    return true;
  }

  /** A window that is moved to another screen, or the browser's zoom: the query is for one ratio, so it is set anew. */
  private watchRatio(): void {
    const query = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    query.addEventListener('change', () => {
      if (this.measure()) this.changed();
      this.watchRatio();
    }, { once: true, signal: this.stop.signal });
  }
}
