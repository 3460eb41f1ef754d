// SPDX-License-Identifier: MIT
// What a plot can show, and its values: curves of the swarm, columns of the series table, numbers of a robot's reports.
import uPlot from 'uplot';
import type { Series } from '../frame';
import { robotColumns, saidName } from '../state/robot_series';

export interface Curve {
  title: string;
  unit: string;
  help: string;
  /** From the columns of the series table; NaN where there is no value. */
  value(series: Series, tick: number): number;
  digits: number;
  /** Tells a small value from 0. */
  tiny?: boolean;
  whole: boolean;
  /** Of the selected robot's reports instead of the series table. */
  robot?: boolean;
  /** Of what it broadcasts. */
  said?: boolean;
}

export const curves: Curve[] = [ // those shown first
  {
    title: 'Broken tree edges', unit: '', digits: 0, whole: true,
    help: 'Edges of the tree whose ends are out of range or occluded',
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

/** The last value at or before a time; null if there is none. What a robot's report does not have at that time, it has
 *  not: only the table's columns are computed now and then. */
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
  const first = curve.robot === true ? low - 1 : 0;
  for (let k = low - 1; k >= Math.max(0, first); --k) {
    const v = curve.value(series, k);
    if (Number.isFinite(v)) return v;
  }
  return null;
}

export interface Group { title: string; curves: Curve[] }

/** What can be chosen: the curves above, every column as it is, the numbers of the selected robot's reports, and the
 *  `fields` of its messages. */
export function choices(runs: Series[], fields: readonly string[] = []): Group[] {
  const names = new Set(runs.flatMap((series) => Object.keys(series)));
  for (const name of ['tick', 'time_s']) names.delete(name);
  return [
    { title: 'The swarm', curves },
    ...(names.size === 0 ? [] : [{ title: 'Columns of the series table', curves: [...names].map(columnCurve) }]),
    { title: 'The selected robot', curves: robotColumns.map(robotCurve) },
    ...(fields.length === 0 ? [] : [{ title: 'What the selected robot says', curves: fields.map(saidCurve) }]),
  ];
}

function robotCurve({ name, unit, help }: (typeof robotColumns)[number]): Curve {
  const measured = unit !== '';
  return {
    title: `robot: ${name}`, unit, digits: measured ? 2 : 0, whole: !measured, robot: true, help: `${help}. Of the selected robot`,
    value: (series, k) => series[name]?.[k] ?? NaN,
  };
}

function saidCurve(field: string): Curve {
  const name = saidName(field);
  return {
    title: `robot ${name}`, unit: '', digits: 4, tiny: true, whole: false, robot: true, said: true,
    help: `The field ${field} of the messages that the selected robot broadcasts`,
    value: (series, k) => series[name]?.[k] ?? NaN,
  };
}

function columnCurve(name: string): Curve {
  return {
    title: name, unit: '', digits: 4, tiny: true, whole: false, help: `The column ${name} of the series table`,
    value: (series, k) => series[name]?.[k] ?? NaN,
  };
}
