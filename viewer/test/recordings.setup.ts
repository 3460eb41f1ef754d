// SPDX-License-Identifier: MIT
// Makes the recordings that are read by the tests, with the native program: $BANYAN, or what is built here.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import type { TestProject } from 'vitest/node';

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.resolve(here, '../..');

/** Directory, scenario, further options. */
const runs: [string, string, string[]][] = [
  ['three', 'three-targets', []],
  ['sparse', 'three-targets', ['--set', 'output.record_every=7']],
  ['moving', 'changing-mission', []],
  ['large', 'paper-large', []],
];

declare module 'vitest' {
  interface ProvidedContext {
    recordings: string;
  }
}

export function program(): string {
  const places = [process.env.BANYAN, path.join(root, 'build/check/bin/banyan'), path.join(root, 'build/release/bin/banyan')];
  const found = places.find((place) => place !== undefined && existsSync(place));
  if (found === undefined) throw new Error('no banyan: build it, or say where it is with BANYAN');
  return found;
}

export default function setup(project: TestProject): () => void {
  const directory = mkdtempSync(path.join(tmpdir(), 'banyan-viewer-'));
  const banyan = program();
  const call = (...options: string[]) => execFileSync(banyan, options, { stdio: ['ignore', 'pipe', 'inherit'], maxBuffer: 1 << 30 });
  for (const [name, scenario, options] of runs) {
    const out = path.join(directory, name);
    call('run', path.join(root, `scenarios/${scenario}.toml`), '--out', out, '--series', '--quiet', ...options);
    writeFileSync(path.join(out, 'export.csv'), call('export', path.join(out, 'run.mcap')));
  }
  project.provide('recordings', directory);
  return () => rmSync(directory, { recursive: true, force: true });
}
