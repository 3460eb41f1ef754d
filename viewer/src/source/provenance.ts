// SPDX-License-Identifier: MIT
// What a recording says about itself: its program, what a picture needs to know, how the run ended.
import type { Setting } from '../frame';
import { Malformed } from './json';
import { Problem, type Warnings } from './problem';
import { defaultSetting, parseSetting } from './setting';
import type { Track } from './track';

export interface Provenance {
  version: string;
  git: string;
  seed: number;
  config: string;
}

const formatVersion = '1';

type Metadata = ReadonlyMap<string, ReadonlyMap<string, string>>;

/** Throws a Problem for a recording of another format. */
export function readProvenance(metadata: Metadata, warnings: Warnings): Provenance {
  const entries = metadata.get('banyan.provenance');
  if (entries === undefined) warnings.add('it does not say where it comes from (no banyan.provenance)');
  const entry = (key: string) => entries?.get(key) ?? '';
  if (entries !== undefined && entry('format_version') !== formatVersion) {
    throw new Problem(
      `is a recording of format version '${entry('format_version').slice(0, 16)}', and this page reads ${formatVersion}: ` +
      `open it with the version of banyan that made it (${entry('version').slice(0, 16)}), or run the scenario again`,
    );
  }
  const seed = Number(entry('seed'));
  return {
    version: entry('version'), git: entry('git'), seed: Number.isFinite(seed) ? seed : 0, config: entry('config'),
  };
}

export function readResult(metadata: Metadata): Record<string, string> {
  return Object.fromEntries(metadata.get('banyan.result') ?? []);
}

export interface TimedSetting {
  timeS: number;
  setting: Setting;
}

/** From the channel, where settings that change are; without it from the metadata. Never empty. */
export async function readSettings(track: Track | null, metadata: Metadata, warnings: Warnings): Promise<TimedSetting[]> {
  const settings: TimedSetting[] = [];
  const take = (timeS: number, text: string) => {
    try {
      settings.push({ timeS, setting: parseSetting(text, (warning) => warnings.add(warning)) });
    } catch (error) {
      if (!(error instanceof Malformed)) throw error;
      warnings.add(`the setting cannot be read: ${error.message}`);
    }
  };
  if (track !== null) for await (const entry of track.forwards(0)) take(entry.time * 1e-9, entry.text());
  const json = metadata.get('banyan.setting')?.get('json');
  if (settings.length === 0 && json !== undefined) take(0, json);
  if (settings.length === 0) {
    warnings.add('it does not say robot radius and radio range (no banyan.setting); defaults are assumed');
    settings.push({ timeS: 0, setting: defaultSetting() });
  }
  return settings.sort((a, b) => a.timeS - b.timeS);
}
