// SPDX-License-Identifier: MIT
// The messages between the page and a source of frames. A source is a worker: one reads a recording,
// the other runs the simulation. Both answer the same requests; a live run is a recording whose end
// moves when the page requests what comes next.
import type { Frame, RunEvent, Series, Setting } from '../frame';

/** Sent once, when a source is open, and again whenever something in it has changed (a live run that was
 *  rewound, an obstacle that was moved). */
export interface Header {
  kind: 'recording' | 'live';
  name: string; // of the file or the scenario
  /** In order of time; the one that holds at t is the last with timeS <= t. Never empty. */
  settings: { timeS: number; setting: Setting }[];
  robots: number; // in the first frame
  startS: number; // of the first and the last frame there is now
  endS: number;
  /** Live: there is more to come. A recording ends where it ends. */
  growing: boolean;
  /** A recording that is still being written: its end moves by itself. */
  following: boolean;
  /** How often it has begun anew while it was followed; each time everything is another. */
  take: number;
  version: string; // of the program that made it
  git: string;
  seed: number;
  config: string; // the whole configuration as JSON, "" if unknown
  /** Columns of the run table, as text; empty for a run that has not ended or was cut short. */
  result: Record<string, string>;
  /** Live: what a visitor did, in order; undefined in a recording. */
  acts?: Act[];
  /** Live: that compute it. */
  threads?: number;
  warnings: string[]; // damage that was skipped, in words
}

/** In the terms of a scenario's [[events]] (docs/scenario-keys.md), without `time_s`: it happens now. */
export type Intervention =
  | { kind: 'die'; robot: number }
  | { kind: 'move_target'; target: number; position_m: [number, number]; speed_m_s?: number }
  | { kind: 'add_target'; position_m: [number, number] }
  | { kind: 'remove_target'; target: number }
  | { kind: 'set_loss'; loss: number }
  | { kind: 'blackout'; duration_s: number }
  | { kind: 'set_line_of_sight'; line_of_sight: boolean }
  | { kind: 'move_obstacle'; obstacle: number; position_m: [number, number] }
  | { kind: 'add_obstacle'; position_m: [number, number]; radius_m: number }
  | { kind: 'remove_obstacle'; obstacle: number };

/** A live run: text of a scenario (TOML or JSON) and "key=value" changes, as with --set. */
export interface LiveRequest {
  name: string;
  text: string;
  overrides: string[];
  /** What was done to it, to be done again: an event's JSON, at the beginning of the step after `tick`. */
  acts?: Act[];
  /** That may compute it, where the page has threads. The result is the same. */
  threads?: number;
}

export interface Act {
  tick: number;
  json: string; // an Intervention
}

export type MessageFields = Record<string, number | string | boolean>;

export interface SaidAt {
  timeS: number;
  fields: MessageFields;
}

/** What answers a request for frames; see `frames` below. */
export interface FramesReply {
  /** By time. */
  frames: Frame[];
  /** A source may stop early so that others get their turn: nothing is missing up to here. */
  untilS: number;
  /** Of the last frame that there is now. */
  endS: number;
}

export type Request =
  | { type: 'open'; file: Blob; name: string }
  /** A server's file, read by ranges; `size` in bytes, 0: not known. */
  | { type: 'open_url'; url: string; name: string; size: number }
  | { type: 'open_live'; run: LiveRequest }
  /** Frames with fromS <= time <= toS and the nearest ones on either side, so that a picture of any time
   *  between them can be made. With a stride only those whose tick is a multiple of it, and the first and
   *  the last of a recording. A live run goes on until it is beyond toS. */
  | { type: 'frames'; id: number; fromS: number; toS: number; stride: number }
  /** What this robot broadcast last, at that tick. */
  | { type: 'message'; id: number; robot: number; tick: number }
  /** What it broadcast in [fromS, toS], as far as it was kept; as with frames, not more at a time than is good for others. */
  | { type: 'messages'; id: number; robot: number; fromS: number; toS: number }
  // Live only. An intervention acts at the beginning of the step after `tick`; what was simulated
  // beyond it is forgotten and a new header is sent.
  | { type: 'intervene'; id: number; tick: number; events: Intervention[] }
  /** The scenario from its beginning, without the interventions; a new header is sent. */
  | { type: 'reset'; id: number }
  /** Takes back what was done last, all events of that request; `undone` tells from when on all may differ. */
  | { type: 'undo'; id: number }
  /** Does again what was undone last, unless something else has been done since. At a moment that is not simulated yet
   *  it happens when that comes. */
  | { type: 'redo'; id: number }
  /** The state hash after so many ticks, which `banyan run` has there too. */
  | { type: 'hash'; id: number; tick: number }
  | { type: 'save_recording'; id: number }
  | { type: 'save_scenario'; id: number };

export type Reply =
  | { type: 'header'; header: Header }
  /** All of it for a recording (as soon as it is read), or all (`whole`) or what is new of one that grows; for a
   *  live run what is new, or all of it after a rewind. */
  | { type: 'series'; series: Series; events: RunEvent[]; whole: boolean }
  | ({ type: 'frames'; id: number } & FramesReply)
  /** null: not kept. */
  | { type: 'message'; id: number; fields: MessageFields | null }
  | { type: 'messages'; id: number; said: SaidAt[] }
  | { type: 'hash'; id: number; hash: string }
  | { type: 'done'; id: number }
  /** Also of a redo. tick null: there was nothing to undo, or to do again. */
  | { type: 'undone'; id: number; tick: number | null }
  | { type: 'file'; id: number; name: string; blob: Blob }
  /** A request that could not be met, in words for the visitor; id 0: the source could not be opened
   *  or is lost. */
  | { type: 'failed'; id: number; text: string; problems?: string[] };
