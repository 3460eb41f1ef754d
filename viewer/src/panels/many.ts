// SPDX-License-Identifier: MIT
// Many seeds of one scenario as small pictures of the same moment, and beside them what they come to. A picture that is
// clicked is opened in the page.
import { button, download, h, setText } from '../dom';
import { boundsOf } from '../scene/bounds';
import { fitted } from '../scene/camera';
import { Scene } from '../scene/picture';
import type { Theme } from '../scene/themes';
import { defaultSwitches, type SceneView } from '../scene/view';
import { Batch, hasEnded, shownAt, type BatchRun, type BatchSource } from '../state/batch';
import { outcomeOf, percent } from '../state/outcome';
import { resultsCsv, summarise, type Spread, type SummaryRow } from '../state/summary';
import type { LiveChoice } from './live';

export interface ManyActions {
  /** Resolves when it has told what it holds. */
  source(choice: LiveChoice, algorithm: string, seed: number): Promise<BatchSource>;
  /** In the page. */
  open(choice: LiveChoice, algorithm: string, seed: number): void;
  theme(): Theme;
}

const counts = [4, 6, 8, 12, 16, 24];
const usualCount = 8;
const marginPx = 8;
const playedForS = 8; // all of it, when it is played
/** Little lines would only make little pictures grey. */
const switches = { ...defaultSwitches, links: false, trails: false };

/** One run. */
class Small {
  readonly element: HTMLElement;
  private readonly words = h('span');
  private readonly scene: Scene;
  private drawn: unknown = null;
  private timeS = Infinity;

  constructor(private readonly run: BatchRun, title: string, private readonly theme: () => Theme, open: () => void) {
    const picture = h('div', { class: 'picture' });
    this.element = h('button', { type: 'button', class: 'small', title: 'Open it in the page', onclick: open },
      picture, h('span', { class: 'small-title' }, title), this.words);
    this.scene = new Scene(picture, theme(), () => { this.drawn = null; this.draw(this.timeS); });
    this.scene.canvas.setAttribute('aria-hidden', 'true');
  }

  draw(timeS: number): void {
    this.timeS = timeS;
    const outcome = outcomeOf(this.run.result);
    setText(this.words, this.run.problem !== '' ? this.run.problem : (outcome?.headline ?? (this.run.frames.length > 0 ? 'running …' : 'waiting')));
    this.words.dataset.state = this.run.problem !== '' ? 'bad' : outcome === null ? '' : outcome.good ? 'good' : 'bad';
    const shown = shownAt(this.run, timeS);
    const { widthPx, heightPx } = this.scene;
    if (shown === null || widthPx === 0 || shown.frame === this.drawn) return;
    this.drawn = shown.frame;
    const view: SceneView = {
      ...shown, trails: [], selection: null, hovered: null, switches, theme: this.theme(),
      camera: fitted(boundsOf(shown.setting, shown.frame), widthPx, heightPx, marginPx), bare: true,
    };
    this.scene.draw(view);
  }

  dispose(): void { this.scene.dispose(); }
}

export class Many {
  readonly element: HTMLDialogElement;
  private readonly title = h('h2');
  private readonly count = h('select', { id: 'many-count' }, ...counts.map((n) => h('option', { value: n, selected: n === usualCount }, String(n))));
  private readonly first = h('input', { id: 'many-first', type: 'number', min: 0, step: 1, value: 1 });
  private readonly smalls = h('div', { class: 'smalls' });
  private readonly summary = h('div', { class: 'many-summary', 'aria-live': 'polite' });
  private readonly moment = h('input', { id: 'many-moment', type: 'range', min: 0, max: 1, step: 'any', value: 1, oninput: () => this.choose(Number(this.moment.value)) });
  private readonly momentText = h('output', { for: 'many-moment' });
  private readonly play = button('Play', 'All of them from their start', () => this.togglePlay());
  private readonly csv = button('Table', 'The results as CSV', () => this.saveTable());
  private choice: LiveChoice | null = null;
  private batch: Batch | null = null;
  private pictures: Small[] = [];
  private timeS = Infinity; // the newest
  private playing = false;
  private told = 0; // runs in the summary

  constructor(private readonly actions: ManyActions) {
    const form = h('form', { class: 'many-form', onsubmit: (event: SubmitEvent) => { event.preventDefault(); this.start(); } },
      h('label', { for: 'many-first' }, 'First seed'), this.first, h('label', { for: 'many-count' }, 'Seeds'), this.count,
      h('button', { type: 'submit', class: 'primary' }, 'Run'), button('Close', 'Close (Escape)', () => this.element.close()));
    this.element = h('dialog', { class: 'many', 'aria-label': 'Many seeds', onclose: () => this.clear() },
      h('header', {}, this.title, form),
      h('div', { class: 'many-body' }, this.smalls, this.summary),
      h('div', { class: 'many-foot' }, this.play, h('label', { for: 'many-moment' }, 'Moment'), this.moment, this.momentText, this.csv));
  }

  /** With the scenario and the algorithms of the choice. */
  open(choice: LiveChoice, firstSeed: number): void {
    this.choice = choice;
    this.first.value = String(firstSeed);
    setText(this.title, choice.name);
    this.element.showModal();
    this.start();
  }

  private start(): void {
    this.clear();
    const { choice } = this;
    if (choice === null) return;
    const first = Math.max(0, Math.round(Number(this.first.value) || 0));
    const seeds = Array.from({ length: Number(this.count.value) }, (_, k) => first + k);
    const what = seeds.flatMap((seed) => choice.algorithms.map((algorithm) => ({ algorithm, seed })));
    const batch = new Batch(what, (k) => this.actions.source(choice, what[k].algorithm, what[k].seed), () => { if (this.batch === batch) this.show(); });
    this.batch = batch;
    this.pictures = batch.runs.map((run) => new Small(run, titleOf(run, choice), () => this.actions.theme(), () => {
      this.element.close();
      this.actions.open(choice, run.algorithm, run.seed);
    }));
    this.smalls.dataset.algorithms = String(choice.algorithms.length);
    this.smalls.replaceChildren(...this.pictures.map(({ element }) => element));
    this.show();
    void batch.run(Math.max(1, Math.min(4, navigator.hardwareConcurrency - 1)));
  }

  private clear(): void {
    this.batch?.stop();
    this.batch = null;
    this.playing = false;
    this.timeS = Infinity;
    this.told = -1;
    for (const picture of this.pictures) picture.dispose();
    this.pictures = [];
    this.smalls.replaceChildren();
  }

  private show(): void {
    const { batch } = this;
    if (batch === null) return;
    const { endS } = batch;
    this.moment.max = String(Math.max(endS, 1e-3));
    this.moment.value = String(Math.min(this.timeS, endS));
    setText(this.momentText, `${Math.min(this.timeS, endS).toFixed(1)} s`);
    setText(this.play, this.playing ? 'Pause' : 'Play');
    for (const picture of this.pictures) picture.draw(this.timeS);
    if (batch.ended !== this.told) this.tell(batch);
  }

  private tell(batch: Batch): void {
    this.told = batch.ended;
    const ended = batch.runs.filter((run) => hasEnded(run) && run.problem === '');
    this.csv.disabled = ended.length === 0;
    this.summary.replaceChildren(
      h('h3', {}, `${batch.ended} of ${batch.runs.length} runs have ended`),
      ...(ended.length === 0 ? [] : [tableOf(summarise(ended.map(({ algorithm, result }) => ({ algorithm: result.algorithm ?? algorithm, result }))))]),
      h('p', { class: 'hint' }, 'Medians, with the least and the most in brackets; times and robots of the complete runs, shares of all.'));
  }

  /** At the end of the slider: whatever is newest. */
  private choose(timeS: number): void {
    this.playing = false;
    this.timeS = timeS >= Number(this.moment.max) ? Infinity : timeS;
    this.show();
  }

  private togglePlay(): void {
    this.playing = !this.playing;
    if (this.playing && this.timeS >= (this.batch?.endS ?? 0)) this.timeS = 0;
    let lastMs = performance.now();
    const go = (nowMs: number) => {
      const endS = this.batch?.endS ?? 0;
      if (!this.playing || this.batch === null) return;
      this.timeS += (Math.max(0, nowMs - lastMs) / 1000) * (endS / playedForS);
      lastMs = nowMs;
      if (this.timeS >= endS) { this.timeS = Infinity; this.playing = false; }
      this.show();
      requestAnimationFrame(go);
    };
    this.show();
    requestAnimationFrame(go);
  }

  private saveTable(): void {
    const ended = this.batch?.runs.filter((run) => hasEnded(run) && run.problem === '') ?? [];
    const text = resultsCsv(ended.map(({ algorithm, seed, result }) => ({ algorithm: result.algorithm ?? algorithm, seed, result })));
    download(`${(this.choice?.name ?? 'runs').replace(/\.[^.]*$/, '')}-seeds.csv`, new Blob([text], { type: 'text/csv' }));
  }
}

function titleOf({ algorithm, seed }: BatchRun, choice: LiveChoice): string {
  return choice.algorithms.length > 1 ? `${algorithm === '' ? 'the scenario’s' : algorithm}, seed ${seed}` : `seed ${seed}`;
}

function tableOf(rows: readonly SummaryRow[]): HTMLElement {
  const seconds = (v: number) => `${v.toFixed(1)} s`;
  const lines: [string, (row: SummaryRow) => string][] = [
    ['complete', ({ complete, runs }) => `${complete} of ${runs}`],
    ['complete after', ({ timeS }) => spreadText(timeS, seconds)],
    ['robots used', ({ committed }) => spreadText(committed, (v) => String(Math.round(v * 10) / 10))],
    ['some edge broken', ({ broken }) => spreadText(broken, percent)],
    ['network split', ({ split }) => spreadText(split, percent)],
  ];
  return h('table', { class: 'facts beside' },
    h('thead', {}, h('tr', {}, h('td'), ...rows.map(({ algorithm }) => h('th', { scope: 'col' }, algorithm)))),
    h('tbody', {}, ...lines.map(([name, text]) => h('tr', {}, h('th', { scope: 'row' }, name), ...rows.map((row) => h('td', {}, text(row)))))));
}

function spreadText(spread: Spread | null, text: (value: number) => string): string {
  if (spread === null) return '–';
  return spread.least === spread.most ? text(spread.median) : `${text(spread.median)} (${text(spread.least)} to ${text(spread.most)})`;
}
