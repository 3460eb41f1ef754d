// SPDX-License-Identifier: MIT
// The compiled simulation and the native program side by side: what the tests of this folder share.
//   BANYAN_PROGRAM  the native program
//   BANYAN_LIVE     the folder with banyan_live.mjs and banyan_live.wasm
import { execFile } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { promisify } from 'node:util';

const program = process.env.BANYAN_PROGRAM;
const folder = process.env.BANYAN_LIVE;
export const scenarios = fileURLToPath(new URL('../../../scenarios/', import.meta.url));

export async function loadModule() {
  const { default: createBanyanLive } = await import(pathToFileURL(join(folder, 'banyan_live.mjs')));
  return createBanyanLive({ wasmBinary: await readFile(join(folder, 'banyan_live.wasm')) });
}
export const module = await loadModule();

/** A fresh run of a scenario's text; warnings are fine, errors are not. */
export function open(text, overrides = [], name = 'scenario.toml') {
  const live = new module.Live();
  const problems = live.load(name, text, overrides);
  if (!live.loaded()) throw new Error(problems.join('\n'));
  return live;
}

/** A scenario's text with the cells of its maps in the place of their files: the browser has none. */
export async function withoutFiles(path) {
  const text = await readFile(path, 'utf8');
  if (!/^(map|file) = /m.test(text)) return text;
  return (await promisify(execFile)(program, ['validate', path, '--show', 'toml'], { maxBuffer: 1 << 26 })).stdout;
}

/** The columns of the run table that the program comes to with this scenario. */
export async function native(text, overrides = []) {
  const at = await mkdtemp(join(tmpdir(), 'banyan-wasm-'));
  try {
    const file = join(at, 'scenario.toml');
    await writeFile(file, text);
    const options = ['run', file, '--json', '--quiet', '--no-record', '--threads', '1', '--out', join(at, 'out')];
    for (const change of overrides) options.push('--set', change);
    const { stdout } = await promisify(execFile)(program, options, { maxBuffer: 1 << 26 });
    return JSON.parse(stdout).result;
  } finally {
    await rm(at, { recursive: true, force: true });
  }
}

/** Options with which the program stops after `ticks`, whatever has happened. */
export function until(ticks, tickS = 0.1) {
  return [`mission.time_limit_s=${ticks * tickS}`, 'mission.stop_when_complete=false'];
}

/** What the program writes besides: `banyan ...args`. */
export async function banyan(...args) {
  return promisify(execFile)(program, args, { maxBuffer: 1 << 28 });
}
