// SPDX-License-Identifier: MIT
// An address as an experiment: a scenario, what is changed in it, what was done to it at which tick, and where one
// looks. The simulation is deterministic, so this short text replays all of it, here and in the program, which reads
// the same (cli/src/link.cpp). What is behind the # never reaches a server.
import type { Act } from './source/protocol';

export interface Experiment {
  scenario: string; // of those that come with Banyan; "": `text`
  name: string; // of the file whose text it is
  text: string;
  recording: string; // instead: its address, on the same server
  algorithms: string[];
  seeds: number[];
  sets: string[]; // "key=value"
  /** For each run side by side. */
  acts: Act[][];
  timeS: number | null;
  view: { xM: number; yM: number; scale: number } | null;
  robot: number | null;
  /** Other runs that stand beside these, each as an address of its own. */
  beside: string[];
}

export const nothing: Experiment = {
  scenario: '', name: '', text: '', recording: '', algorithms: [], seeds: [], sets: [], acts: [], timeS: null, view: null, robot: null,
  beside: [],
};

/** Servers and chats cut longer addresses; what does not fit becomes a file. */
export const longestLink = 6000;

/** From what follows a #; null: it says nothing. A name alone is that of a scenario. Unknown keys are passed over, and
 *  what is wrong in a known one is told. */
export function readLink(hash: string): { experiment: Experiment; problems: string[] } | null {
  const written = hash.replace(/^#/, '');
  if (written === '') return null;
  if (!/[=&]/.test(written)) return { experiment: { ...nothing, scenario: decoded(written) }, problems: [] };
  const experiment = structuredClone(nothing);
  const problems: string[] = [];
  for (const part of written.split('&')) {
    const equals = part.indexOf('=');
    if (equals < 0) continue;
    const [key, value] = [part.slice(0, equals), decoded(part.slice(equals + 1))];
    if (!take(experiment, key, value)) problems.push(`The address has ${key} = “${value}”, which is not possible.`);
  }
  return { experiment, problems };
}

/** False: the value is not possible. */
function take(e: Experiment, key: string, value: string): boolean {
  const number = value === '' ? NaN : Number(value);
  switch (key) {
    case 'scenario': e.scenario = value; return true;
    case 'name': e.name = value; return true;
    case 'recording': e.recording = value; return isLocal(value);
    case 'algorithm': e.algorithms.push(value); return true;
    case 'set': e.sets.push(value); return true;
    case 'seed': e.seeds.push(number); return Number.isInteger(number) && number >= 0;
    case 't': e.timeS = number; return Number.isFinite(number) && number >= 0;
    case 'robot': e.robot = number; return Number.isInteger(number) && number >= 0;
    case 'text': return takeText(e, value);
    case 'view': return takeView(e, value);
    case 'do': return takeAct(e, value);
    case 'beside': e.beside.push(value); return readLink(value) !== null;
    default: return true;
  }
}

function takeText(e: Experiment, value: string): boolean {
  const bytes = fromBase64(value);
  if (bytes === null) return false;
  e.text = new TextDecoder().decode(bytes);
  return true;
}

function takeView(e: Experiment, value: string): boolean {
  const [xM, yM, scale] = value.split(',').map(Number);
  if (![xM, yM, scale].every(Number.isFinite) || !(scale > 0)) return false;
  e.view = { xM, yM, scale };
  return true;
}

/** "50:{...}", or of the second run alone "50@2:{...}". */
function takeAct(e: Experiment, value: string): boolean {
  const found = /^(\d+)(?:@([1-4]))?:(\{.*\})$/.exec(value);
  if (found === null) return false;
  const act = { tick: Number(found[1]), json: found[3] };
  const runs = found[2] === undefined ? [0, 1, 2, 3] : [Number(found[2]) - 1];
  for (const run of runs) (e.acts[run] ??= []).push(act);
  return true;
}

export function writeLink(e: Experiment): string {
  const parts: [string, string][] = [];
  if (e.recording !== '') parts.push(['recording', e.recording]);
  else if (e.scenario !== '') parts.push(['scenario', e.scenario]);
  else parts.push(['name', e.name], ['text', toBase64(new TextEncoder().encode(e.text))]);
  for (const algorithm of e.algorithms) parts.push(['algorithm', algorithm]);
  for (const seed of e.seeds) parts.push(['seed', String(seed)]);
  for (const set of e.sets) parts.push(['set', set]);
  parts.push(...actParts(e.acts));
  for (const other of e.beside) parts.push(['beside', other.replace(/^#/, '')]);
  if (e.timeS !== null) parts.push(['t', String(Math.round(e.timeS * 1e4) / 1e4)]);
  if (e.view !== null) parts.push(['view', [e.view.xM, e.view.yM, e.view.scale].map((v) => Number(v.toPrecision(6))).join(',')]);
  if (e.robot !== null) parts.push(['robot', String(e.robot)]);
  return `#${parts.map(([key, value]) => `${key}=${encoded(value)}`).join('&')}`;
}

/** What was done to all runs is written once. */
function actParts(acts: Act[][]): [string, string][] {
  const same = acts.every((of) => JSON.stringify(of) === JSON.stringify(acts[0]));
  if (same) return (acts[0] ?? []).map(({ tick, json }) => ['do', `${tick}:${json}`]);
  return acts.flatMap((of, run) => of.map(({ tick, json }): [string, string] => ['do', `${tick}@${run + 1}:${json}`]));
}

/** As little as an address needs: what people read in it stays readable. */
const encoded = (text: string) => encodeURIComponent(text).replace(/%(3A|2C|3D|2F|40)/g, decodeURIComponent);

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a % that encodes nothing
  }
}

/** The page loads nothing from elsewhere, whatever an address asks for. */
function isLocal(address: string): boolean {
  const base = globalThis.location?.href ?? 'http://localhost/';
  return URL.canParse(address, base) && new URL(address, base).origin === new URL(base).origin;
}

export function toBase64(bytes: Uint8Array): string {
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '');
}

export function fromBase64(text: string): Uint8Array | null {
  if (!/^[A-Za-z0-9_-]*$/.test(text)) return null;
  try {
    return Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
  } catch {
    return null;
  }
}
