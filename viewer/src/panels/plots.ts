// SPDX-License-Identifier: MIT
// Four curves in step with the clock; any column of the series table can be chosen for each. The numbers are those of the series table; runs side by side
// share the axes. A click or a drag in a plot moves the clock.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import type { Series } from '../frame';
import { h, setText } from '../dom';

interface Curve {
  title: string;
  unit: string;
  help: string;
  /** From the columns of the series table; NaN where there is no value. */
  value(series: Series, tick: number): number;
  digits: number;
  /** Tells a small value from 0. */
  tiny?: boolean;
  whole: boolean;
}

export const curves: Curve[] = [ // those shown first
  {
    title: 'Broken tree edges', unit: '', digits: 0, whole: true,
    help: 'Edges of the tree whose ends are out of range or hidden from each other',
    value: (s, k) => s.broken_by_distance[k] + s.broken_by_occlusion[k],
  },
  {
    title: 'λ₂ of the radio network', unit: '', digits: 4, tiny: true, whole: false,
    help: 'Algebraic connectivity: 0 when the network is in several parts',
    value: (s, k) => (s.components[k] > 1 ? 0 : s.fiedler[k]),
  },
  {
    title: 'Farthest worker', unit: 'm', digits: 2, whole: false,
    help: 'Largest remaining distance of a worker to its target',
    value: (s, k) => s.worst_target_distance_m[k],
  },
  {
    title: 'Committed robots', unit: '', digits: 0, whole: true,
    help: 'Robots in the tree: alive and no spare',
    value: (s, k) => s.committed[k],
  },
];

type Table = [number[], ...(number | null)[][]];

/** One curve of all runs as uPlot wants it: their times joined, null where a run has no value. */
export function tabulate(curve: Curve, runs: Series[]): Table {
  if (runs.length === 1) {
    const times = Array.from(runs[0].time_s);
    return [times, times.map((_, k) => known(curve.value(runs[0], k)))];
  }
  const joined = uPlot.join(
    runs.map((s) => {
      const times = Array.from(s.time_s);
      return [times, times.map((_, k) => known(curve.value(s, k)))] as uPlot.AlignedData;
    }),
  );
  return joined as unknown as Table;
}

/** A value as it is read off. What is small is not shown as nothing: λ₂ of a large network in one piece is. */
export function readOff({ digits, tiny = false }: Pick<Curve, 'digits' | 'tiny'>, value: number | null): string {
  if (value === null) return '–';
  const isSmall = value !== 0 && Math.abs(value) < 10 ** (1 - digits);
  return tiny && isSmall ? value.toPrecision(2).replace('e-', '·10⁻').replace(/(?<=⁻)\d+/, superscript) : value.toFixed(digits);
}
const superscript = (digits: string) => [...digits].map((d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(d)]).join('');

const known = (v: number) => (Number.isFinite(v) ? v : null);

/** The last value at or before a time; null if there is none. */
export function valueAt(curve: Curve, series: Series, timeS: number): number | null {
  const times = series.time_s;
  if (times === undefined) return null;
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= timeS + 1e-9) low = middle + 1;
    else high = middle;
  }
  for (let k = low - 1; k >= 0; --k) {
    const v = curve.value(series, k);
    if (Number.isFinite(v)) return v;
  }
  return null;
}

/** What can be chosen: the curves above, and every column as it is. */
function choices(runs: Series[]): Curve[] {
  const names = new Set(runs.flatMap((series) => Object.keys(series)));
  for (const name of ['tick', 'time_s']) names.delete(name);
  return [...curves, ...[...names].map(columnCurve)];
}

function columnCurve(name: string): Curve {
  return {
    title: name, unit: '', digits: 4, tiny: true, whole: false, help: `The column ${name} of the series table`,
    value: (series, k) => series[name]?.[k] ?? NaN,
  };
}

const runColors = ['--run-1', '--run-2', '--run-3', '--run-4'];
const dashes = [undefined, [5, 3], [2, 3], [9, 3, 2, 3]];

interface Range { min: number; max: number }

interface PlotActions {
  seek(timeS: number): void;
  hover(timeS: number | null): void;
  /** `factor` > 1: a longer stretch around `atS`; Infinity: all. */
  zoom(atS: number, factor: number, now: Range): void;
  changed(): void;
}

const wheelStep = 0.002; // per pixel of the wheel

class Plot {
  readonly element: HTMLElement;
  private chart: uPlot | null = null;
  private readonly readout = h('output', { class: 'plot-value', 'aria-live': 'off' }); // it changes all the time
  private readonly canvas = h('div', { class: 'plot-canvas' });
  private readonly cursor = h('div', { class: 'plot-cursor' });
  private readonly hover = h('div', { class: 'plot-cursor plot-hover', hidden: true });
  private range: Range | null = null;
  private runs: Series[] = [];
  private readonly select: HTMLSelectElement;
  private offered = ''; // the titles to choose from

  constructor(private curve: Curve, private readonly to: PlotActions) {
    this.select = h('select', { class: 'plot-choice', 'aria-label': 'Curve', onchange: () => this.choose() });
    this.element = h(
      'figure',
      { class: 'plot', title: curve.help },
      h('figcaption', {}, this.select, this.readout),
      this.canvas,
    );
    this.offer([]);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  private offer(runs: Series[]): void {
    const titles = choices(runs).map(({ title }) => title);
    if (titles.join() === this.offered) return;
    this.offered = titles.join();
    this.select.replaceChildren(...titles.map((title) => h('option', { value: title }, title)));
    this.select.value = this.curve.title;
  }

  private choose(): void {
    this.curve = choices(this.runs).find(({ title }) => title === this.select.value) ?? this.curve;
    this.element.title = this.curve.help;
    this.remake();
    this.to.changed();
  }

  setRuns(runs: Series[]): void {
    this.offer(runs);
    if (runs.every((series) => series.time_s.length === 0)) return this.clear();
    const remake = this.chart === null || runs.length !== this.runs.length;
    this.runs = runs;
    if (remake) this.make();
    else this.chart?.setData(tabulate(this.curve, runs) as unknown as uPlot.AlignedData);
    this.zoom(this.range);
  }

  /** Another run is open, of which nothing is known yet: the curves of the last one are not its. */
  private clear(): void {
    this.runs = [];
    this.chart?.destroy();
    this.chart = null;
    setText(this.readout, '');
  }

  /** A stretch of time instead of all of it; null: all. */
  zoom(range: Range | null): void {
    const was = this.range;
    this.range = range;
    if (this.chart === null || (range === null && was === null)) return;
    const times = this.runs.flatMap(({ time_s: t }) => (t.length === 0 ? [] : [t[0], t[t.length - 1]]));
    this.chart.setScale('x', range ?? { min: Math.min(...times), max: Math.max(...times) });
  }

  /** `hoverS`: the pointer is at another moment, in whichever plot. */
  setTime(timeS: number, hoverS: number | null = null): void {
    const values = this.runs.map((s) => valueAt(this.curve, s, hoverS ?? timeS));
    const text = values.map((v) => readOff(this.curve, v)).join(' | ');
    this.readout.classList.toggle('hovered', hoverS !== null);
    setText(this.readout, this.curve.unit && text !== '' && text !== '–' ? `${text} ${this.curve.unit}` : text);
    if (this.chart === null) return;
    const left = this.chart.valToPos(timeS, 'x');
    this.cursor.style.transform = `translateX(${left.toFixed(1)}px)`;
    this.hover.hidden = hoverS === null;
    if (hoverS !== null) this.hover.style.transform = `translateX(${this.chart.valToPos(hoverS, 'x').toFixed(1)}px)`;
  }

  remake(): void {
    if (this.chart !== null) this.make();
  }

  private make(): void {
    this.chart?.destroy();
    const style = getComputedStyle(document.documentElement);
    const color = (name: string) => style.getPropertyValue(name).trim();
    const axis = { stroke: color('--quiet'), grid: { stroke: color('--grid'), width: 1 }, ticks: { show: false }, font: '11px system-ui, sans-serif' };
    const whole = this.curve.whole;
    this.chart = new uPlot(
      {
        ...this.size(),
        legend: { show: false },
        cursor: { show: false },
        padding: [6, 16, 0, 0],
        scales: { x: { time: false }, y: { range: (_, __, high) => [0, Math.max(whole ? 1 : 1e-3, (Number.isFinite(high) ? high : 0) * 1.08)] } },
        axes: [
          { ...axis, size: 20, gap: 3, space: 60, values: (_, ticks) => ticks.map((t) => `${t} s`) },
          { ...axis, size: 38, gap: 4, space: 22, incrs: whole ? [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000] : undefined },
        ],
        series: [
          {},
          ...this.runs.map((_, k) => ({
            stroke: color(runColors[k]), width: 1.5, dash: dashes[k], spanGaps: true, points: { show: false },
          })),
        ],
      },
      tabulate(this.curve, this.runs) as unknown as uPlot.AlignedData,
      this.canvas,
    );
    this.chart.over.append(this.cursor, this.hover);
    this.listen(this.chart);
  }

  private listen(chart: uPlot): void {
    const timeAt = (event: MouseEvent) => chart.posToVal(event.clientX - chart.over.getBoundingClientRect().left, 'x');
    chart.over.addEventListener('pointerdown', (event) => {
      chart.over.setPointerCapture(event.pointerId);
      this.to.seek(timeAt(event));
    });
    chart.over.addEventListener('pointermove', (event) => {
      const dragged = chart.over.hasPointerCapture(event.pointerId);
      if (dragged) this.to.seek(timeAt(event));
      this.to.hover(dragged || event.pointerType === 'touch' ? null : timeAt(event));
    });
    chart.over.addEventListener('pointerleave', () => this.to.hover(null));
    chart.over.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.to.zoom(timeAt(event), Math.exp(event.deltaY * wheelStep), { min: chart.scales.x.min ?? 0, max: chart.scales.x.max ?? 1 });
    }, { passive: false });
    chart.over.addEventListener('dblclick', () => this.to.zoom(0, Infinity, { min: 0, max: 1 }));
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(80, this.canvas.clientWidth), height: Math.max(50, this.canvas.clientHeight) };
  }

  private resize(): void {
    const { width, height } = this.size();
    if (this.chart && (this.chart.width !== width || this.chart.height !== height)) {
      this.chart.setSize({ width, height });
      this.to.changed(); // the clock's line is elsewhere now
    }
  }
}

const shortestS = 0.5; // of a stretch that is zoomed to

export class Plots {
  readonly element: HTMLElement;
  private readonly plots: Plot[];

  private timeS = 0;
  private hoverS: number | null = null;
  private runs: Series[] = [];

  constructor(seek: (timeS: number) => void) {
    const actions: PlotActions = {
      seek,
      hover: (timeS) => { this.hoverS = timeS; this.setTime(this.timeS); },
      zoom: (atS, factor, now) => this.zoom(atS, factor, now),
      changed: () => this.setTime(this.timeS),
    };
    this.plots = curves.map((curve) => new Plot(curve, actions));
    this.element = h('section', { class: 'plots', 'aria-label': 'Plots' }, ...this.plots.map((p) => p.element));
  }

  /** The series of each run shown; called again whenever one has grown. */
  private zoom(atS: number, factor: number, now: Range): void {
    const all = Math.max(0, ...this.runs.map(({ time_s: t }) => (t.length === 0 ? 0 : t[t.length - 1])));
    const min = Math.max(0, atS - (atS - now.min) * factor);
    const max = Math.min(all, atS + (now.max - atS) * factor);
    const range = Number.isFinite(factor) && max - min < 0.98 * all && max - min > 1e-6 ? { min, max } : null;
    if (Number.isFinite(factor) && max - min < shortestS) return;
    for (const plot of this.plots) plot.zoom(range);
    this.setTime(this.timeS);
  }

  setRuns(runs: Series[]): void {
    this.runs = runs;
    this.element.classList.toggle('many', runs.length > 1);
    for (const plot of this.plots) plot.setRuns(runs);
  }

  setTime(timeS: number): void {
    this.timeS = timeS;
    for (const plot of this.plots) plot.setTime(timeS, this.hoverS);
  }

  /** The colours have changed. */
  restyle(): void {
    for (const plot of this.plots) plot.remake();
  }
}
