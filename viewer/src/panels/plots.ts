// SPDX-License-Identifier: MIT
// Four curves in step with the clock; what each shows can be chosen (curves.ts). Runs side by side share the axes. A click
// or a drag in a plot moves the clock.
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import type { Series } from '../frame';
import { h, setText } from '../dom';
import { choices, curves, readOff, tabulate, valueAt, type Curve } from './curves';

const runColors = ['--run-1', '--run-2', '--run-3', '--run-4'];
const dashes = [undefined, [5, 3], [2, 3], [9, 3, 2, 3]];

interface Range { min: number; max: number }

/** What there is to plot. */
export interface PlottedRuns {
  tables: Series[]; // the series of each run
  robots: Series[]; // of the selected robot in each run; as far as it is there
  fields: readonly string[]; // of its messages
  marks: readonly number[]; // which of the runs side by side each table is of
}

interface PlotActions {
  seek(timeS: number): void;
  hover(timeS: number | null): void;
  /** `factor` > 1: a longer stretch around `atS`; Infinity: all. */
  zoom(atS: number, factor: number, now: Range): void;
  changed(): void;
}

/** From 0 on, or from below it if there are such values. */
function rangeOf(low: number, high: number, whole: boolean): [number, number] {
  const [least, most] = [low, high].map((v) => (Number.isFinite(v) ? v : 0));
  return [Math.min(0, least * 1.08), Math.max(whole ? 1 : 1e-3, most * 1.08)];
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
  private runs: Series[] = []; // of the curve: from one of these two
  private tables: Series[] = [];
  private robots: Series[] = [];
  private fields: readonly string[] = []; // of the messages
  private marks: readonly number[] = []; // which of the runs side by side each is
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
    this.offer();
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  private offer(): void {
    const groups = choices(this.tables, this.fields);
    const titles = groups.flatMap((group) => group.curves.map(({ title }) => title)).join();
    if (titles === this.offered) return;
    this.offered = titles;
    this.select.replaceChildren(...groups.map((group) =>
      h('optgroup', { label: group.title }, ...group.curves.map(({ title }) => h('option', { value: title }, title)))));
    this.select.value = this.curve.title;
  }

  private choose(): void {
    this.curve = choices(this.tables, this.fields).flatMap((group) => group.curves).find(({ title }) => title === this.select.value) ?? this.curve;
    this.element.title = this.curve.help;
    this.setRuns(this.given());
    this.remake();
    this.to.changed();
  }

  get ofRobot(): boolean { return this.curve.robot === true; }
  get ofMessage(): boolean { return this.curve.said === true; }

  private given(): PlottedRuns { return { tables: this.tables, robots: this.robots, fields: this.fields, marks: this.marks }; }

  setRuns({ tables, robots, fields, marks }: PlottedRuns): void {
    this.tables = tables;
    this.robots = robots;
    if (fields.length > 0) this.fields = fields;
    const marked = marks.join() !== this.marks.join();
    this.marks = marks;
    this.offer();
    const runs = this.ofRobot ? robots : tables;
    if (runs.every((series) => series.time_s.length === 0)) return this.clear();
    const remake = this.chart === null || marked || runs.length !== this.runs.length;
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
        scales: { x: { time: false }, y: { range: (_, low, high) => rangeOf(low, high, whole) } },
        axes: [
          { ...axis, size: 20, gap: 3, space: 60, values: (_, ticks) => ticks.map((t) => `${t} s`) },
          { ...axis, size: 38, gap: 4, space: 22, incrs: whole ? [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000] : undefined },
        ],
        series: [
          {},
          ...this.runs.map((_, k) => ({
            stroke: color(runColors[this.mark(k)]), width: 1.5, dash: dashes[this.mark(k)], spanGaps: true, points: { show: false },
          })),
        ],
      },
      tabulate(this.curve, this.runs) as unknown as uPlot.AlignedData,
      this.canvas,
    );
    this.chart.over.append(this.cursor, this.hover);
    this.listen(this.chart);
  }

  /** Of the k-th curve: that of its run in the picture. */
  private mark(k: number): number { return this.ofRobot ? k : (this.marks[k] ?? k); }

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

  constructor(seek: (timeS: number) => void, chosen: () => void) {
    const actions: PlotActions = {
      seek,
      hover: (timeS) => { this.hoverS = timeS; this.setTime(this.timeS); },
      zoom: (atS, factor, now) => this.zoom(atS, factor, now),
      changed: () => { this.setTime(this.timeS); chosen(); },
    };
    this.plots = curves.map((curve) => new Plot(curve, actions));
    this.element = h('section', { class: 'plots', 'aria-label': 'Plots' }, ...this.plots.map((p) => p.element));
  }

  private zoom(atS: number, factor: number, now: Range): void {
    const all = Math.max(0, ...this.runs.map(({ time_s: t }) => (t.length === 0 ? 0 : t[t.length - 1])));
    const min = Math.max(0, atS - (atS - now.min) * factor);
    const max = Math.min(all, atS + (now.max - atS) * factor);
    const range = Number.isFinite(factor) && max - min < 0.98 * all && max - min > 1e-6 ? { min, max } : null;
    if (Number.isFinite(factor) && max - min < shortestS) return;
    for (const plot of this.plots) plot.zoom(range);
    this.setTime(this.timeS);
  }

  /** Called again whenever something has grown. */
  setRuns(runs: PlottedRuns): void {
    this.runs = runs.tables;
    this.element.classList.toggle('many', runs.tables.length > 1);
    for (const plot of this.plots) plot.setRuns(runs);
  }

  /** Whether any curve is of the selected robot, and any of what it says. */
  get wanted(): { robot: boolean; said: boolean } {
    return { robot: this.plots.some((plot) => plot.ofRobot), said: this.plots.some((plot) => plot.ofMessage) };
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
