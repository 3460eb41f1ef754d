// SPDX-License-Identifier: MIT
// What a visitor takes along: a picture or a drawing of the moment, the series as a table, a film of a stretch.
import { button, download, h, setText } from '../dom';
import type { Series } from '../frame';
import { documentOf, type Part } from '../scene/svg';

export interface Shown {
  canvas: HTMLCanvasElement;
  words: string[]; // the lines of the caption
  /** null: nothing has been drawn yet. */
  svg(): Part | null;
}

export interface KeepSources {
  /** The runs side by side as they are drawn now. */
  pictures(): Shown[];
  tables(): { name: string; series: Series }[];
  name(): string; // for files, without an ending
}

/** As the program writes it (docs/file-formats.md): empty where there is no value. */
export function csvOf(series: Series): string {
  const names = Object.keys(series);
  const rows = series[names[0]]?.length ?? 0;
  const lines = [names.join(',')];
  for (let k = 0; k < rows; ++k) lines.push(names.map((name) => (Number.isNaN(series[name][k]) ? '' : String(series[name][k]))).join(','));
  return `${lines.join('\n')}\n`;
}

const framesPerS = 30;
const filmTypes = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm', 'video/mp4'];

export class Keep {
  readonly element: HTMLElement;
  private readonly film: HTMLButtonElement;
  private recorder: MediaRecorder | null = null;
  private canvas: HTMLCanvasElement | null = null; // that is filmed

  constructor(private readonly sources: KeepSources) {
    this.film = button('Film', 'Films what the picture shows, until you press it again', () => this.toggleFilm(), { 'aria-pressed': 'false' });
    this.film.disabled = typeof MediaRecorder === 'undefined' || typeof HTMLCanvasElement.prototype.captureStream !== 'function';
    this.element = h('section', { class: 'keep', 'aria-label': 'Save' },
      h('h3', {}, 'Save'),
      h('div', { class: 'buttons' },
        button('Picture', 'This moment as PNG, runs side by side in one', () => this.savePicture()),
        button('Drawing', 'This moment as SVG, to be printed at any size and to be changed', () => this.saveDrawing()),
        button('Table', 'The series of each run as CSV, as far as it has been seen; of the selected robot, too, if a plot is of it', () => this.saveTables()),
        this.film));
  }

  /** After each picture: a film goes on. */
  drawn(): void {
    if (this.canvas !== null) paint(this.sources.pictures(), this.canvas);
  }

  private savePicture(): void {
    const canvas = document.createElement('canvas');
    paint(this.sources.pictures(), canvas);
    canvas.toBlob((blob) => { if (blob) download(`${this.sources.name()}.png`, blob); }, 'image/png');
  }

  private saveDrawing(): void {
    const parts = this.sources.pictures().flatMap(({ svg }) => svg() ?? []);
    const text = documentOf(parts, this.sources.name());
    download(`${this.sources.name()}.svg`, new Blob([text], { type: 'image/svg+xml' }));
  }

  private saveTables(): void {
    for (const { name, series } of this.sources.tables()) download(`${name}.csv`, new Blob([csvOf(series)], { type: 'text/csv' }));
  }

  private toggleFilm(): void {
    if (this.recorder !== null) return this.recorder.stop();
    const canvas = (this.canvas = document.createElement('canvas'));
    this.drawn();
    const type = filmTypes.find((t) => MediaRecorder.isTypeSupported(t));
    const recorder = (this.recorder = new MediaRecorder(canvas.captureStream(framesPerS), type ? { mimeType: type } : {}));
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => { parts.push(data); };
    recorder.onstop = () => {
      const ending = recorder.mimeType.includes('mp4') ? 'mp4' : 'webm';
      download(`${this.sources.name()}.${ending}`, new Blob(parts, { type: recorder.mimeType }));
      this.recorder = this.canvas = null;
      this.showFilming(false);
    };
    recorder.start();
    this.showFilming(true);
  }

  private showFilming(filming: boolean): void {
    setText(this.film, filming ? 'Stop filming' : 'Film');
    this.film.setAttribute('aria-pressed', String(filming));
  }
}

/** All runs side by side with their captions. */
function paint(pictures: Shown[], into: HTMLCanvasElement): void {
  const width = pictures.reduce((sum, { canvas }) => sum + canvas.width, 0);
  const height = Math.max(0, ...pictures.map(({ canvas }) => canvas.height));
  if (into.width !== width) into.width = width;
  if (into.height !== height) into.height = height;
  const pen = into.getContext('2d');
  if (pen === null || width === 0) return;
  let x = 0;
  for (const { canvas, words } of pictures) {
    const ratio = canvas.width / Math.max(1, canvas.clientWidth);
    pen.drawImage(canvas, x, 0);
    pen.font = `${13 * ratio}px system-ui, sans-serif`;
    pen.fillStyle = getComputedStyle(canvas).color;
    words.forEach((line, k) => pen.fillText(line, x + 12 * ratio, (20 + 17 * k) * ratio));
    x += canvas.width;
  }
}
