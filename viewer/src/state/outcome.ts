// SPDX-License-Identifier: MIT
// How a run ended, in the words of `banyan run` (cli/src/summary.cpp), from the row of the run table that recordings
// carry and live runs tell once their mission is over.

export interface Outcome {
  endS: number; // when the mission was over: it is no news before
  good: boolean;
  headline: string;
  details: string[];
}

/** null: the run has no result (yet). */
export function outcomeOf(result: Record<string, string>): Outcome | null {
  const number = (name: string) => (result[name] === undefined || result[name] === '' ? NaN : Number(result[name]));
  const good = result.complete === 'true';
  const endS = number(good ? 'completion_time_s' : 'time_s');
  if (!Number.isFinite(endS)) return null;
  return { endS, good, headline: headlineOf(result, good, endS, number), details: detailsOf(number, good) };
}

type Numbers = (name: string) => number;

function headlineOf(result: Record<string, string>, good: boolean, endS: number, number: Numbers): string {
  if (good) return `Complete after ${endS.toFixed(1)} s`;
  if (number('survivors') === 0) return 'Not complete: all robots have died';
  if (result.interrupted === 'true') return `Stopped at ${endS.toFixed(1)} s`;
  return `Not complete within ${number('time_limit_s').toFixed(1)} s`;
}

function detailsOf(number: Numbers, good: boolean): string[] {
  const details: string[] = [];
  const share = (name: string) => percent(number(name) / number('ticks'));
  if (!good && Number.isFinite(number('held_ratio'))) details.push(`${percent(number('held_ratio'))} of the targets held`);
  if (Number.isFinite(number('committed'))) details.push(`${number('committed')} of ${number('robots')} robots used`);
  if (number('broken_ticks') === 0) details.push('no edge ever broken');
  if (number('broken_ticks') > 0) details.push(`some edge broken ${share('broken_ticks')} of the time`);
  if (number('split_ticks') > 0) details.push(`radio network split ${share('split_ticks')} of the time`);
  if (number('deaths') > 0) details.push(`${number('deaths')} died`);
  return details;
}

/** Not rounded to nothing, nor to all. */
export function percent(share: number): string {
  const value = 100 * share;
  if (value > 0 && value < 0.1) return 'less than 0.1 %';
  return `${value < 10 || (value > 99 && value < 100) ? Math.floor(10 * value) / 10 : Math.round(value)} %`;
}
