// SPDX-License-Identifier: MIT
// Thousands of small squares of one colour, drawn pixel by pixel into a bitmap: without a GPU that takes half of what as
// many calls of fillRect() do, and a quarter of what WebGL does (docs/viewer.md). Their edges are as smooth.

/** Pixels, 0xAABBGGRR. */
export class DotBitmap {
  words = new Uint32Array(0);
  width = 0;
  height = 0;
  private rgb = 0;

  /** Empty; `color` as #rrggbb. */
  clear(width: number, height: number, color: string, words = new Uint32Array(width * height)): void {
    this.width = width;
    this.height = height;
    this.words = words.fill(0);
    const [r, g, b] = [1, 3, 5].map((k) => Number.parseInt(color.slice(k, k + 2), 16));
    this.rgb = (b! << 16) | (g! << 8) | r!;
  }

  /** Around that place; what lies outside is left out. */
  add(x: number, y: number, side: number): void {
    const { width, height, words, rgb } = this;
    const x0 = x - side / 2, y0 = y - side / 2, x1 = x0 + side, y1 = y0 + side;
    const lastColumn = Math.min(width, Math.ceil(x1)), lastRow = Math.min(height, Math.ceil(y1));
    for (let row = Math.max(0, Math.floor(y0)); row < lastRow; ++row) {
      const share = 255 * (Math.min(y1, row + 1) - Math.max(y0, row));
      for (let column = Math.max(0, Math.floor(x0)), at = row * width + column; column < lastColumn; ++column, ++at) {
        const alpha = (share * (Math.min(x1, column + 1) - Math.max(x0, column)) + 0.5) | 0;
        if (alpha > words[at]! >>> 24) words[at] = (alpha << 24) | rgb;
      }
    }
  }
}

const step = 64; // of its size, so that a swarm that spreads does not need a new bitmap for each picture

export class Dots {
  readonly bitmap = new DotBitmap();
  private canvas: HTMLCanvasElement | null = null;
  private pen: CanvasRenderingContext2D | null = null;
  private image: ImageData | null = null;
  private words = new Uint32Array(0);

  /** Empty, and at least so large. */
  begin(width: number, height: number, color: string): void {
    const columns = step * Math.ceil(width / step), rows = step * Math.ceil(height / step);
    if (this.image === null || this.image.width !== columns || this.image.height !== rows) {
      this.canvas ??= document.createElement('canvas');
      this.canvas.width = columns;
      this.canvas.height = rows;
      this.pen = this.canvas.getContext('2d', { willReadFrequently: true }); // it stays where we write it
      this.image = new ImageData(columns, rows);
      this.words = new Uint32Array(this.image.data.buffer);
    }
    this.bitmap.clear(columns, rows, color, this.words);
  }

  /** With its corner at (left, top), device pixels; the pen counts in CSS pixels, `ratio` device pixels each. */
  draw(onto: CanvasRenderingContext2D, left: number, top: number, ratio: number): void {
    const { canvas, image } = this;
    this.pen?.putImageData(image!, 0, 0);
    onto.drawImage(canvas!, left / ratio, top / ratio, canvas!.width / ratio, canvas!.height / ratio);
  }
}
