// SPDX-License-Identifier: MIT
// Types of the compiled simulation (bindings.cpp; live.hpp says what each function does):
//   import createBanyanLive from '@live/banyan_live.mjs';
//   const module = await createBanyanLive();          // a page or a worker; Node.js: ({ wasmBinary })
//   const live = new module.Live();
// Functions whose name ends in Json return the text of what the comment names. Without a loaded
// scenario, and where a comment says so, they throw an Error with words for the visitor.

export interface Live {
  /** Problems, a line each, as the program prints them; warnings are among them, so ask loaded().
   *  `overrides`: "key=value". Replaces the run there was. */
  load(name: string, text: string, overrides: string[]): string[];
  loaded(): boolean;

  /** Steps are computed by so many threads from now on, and come out the same. At most four, and one in the module
   *  without threads. Needs no scenario. */
  useThreads(threads: number): void;

  /** Also beyond the end of the mission. */
  step(ticks: number): void;
  /** The head, 0 at the start. */
  tick(): number;
  timeS(): number;
  /** `banyan run` would have stopped here or earlier. */
  finished(): boolean;
  /** All targets have been held at once. */
  complete(): boolean;
  /** Back to an earlier tick; what was done from there on is forgotten, interventions at `tick` itself
   *  included, and with them the events not taken yet. To tick() itself: nothing changes. Throws for a
   *  tick that has not been. Takes as long as simulating that far. */
  rewind(tick: number): void;
  /** JSON of one Intervention (src/source/protocol.ts): acts in the next step. Returns what is wrong
   *  with it, a line each, and has then changed nothing; [] if it will happen. */
  intervene(eventJson: string): string[];

  /** The head, column by column: robot i's column c is at c * robots() + i. A copy. */
  frame(): Float64Array;
  robots(): number;
  /** {tick, time_s, x_m: number[], y_m: number[], worker: number[]} of the head. */
  targetsJson(): string;
  /** Setting (src/frame.ts) as it is now. */
  settingJson(): string;
  /** Another number whenever settingJson() may be another. */
  settingVersion(): number;
  /** One row of the series table, {column: number | boolean | null}; also at tick 0. */
  metricsJson(): string;
  /** RunEvent[] since the last call, load() or rewind(). */
  takeEventsJson(): string;
  /** {field: number | string}, or null: no such robot, or it has not spoken yet (tick 0). */
  messageJson(robot: number): string;
  /** 16 hexadecimal digits, those that `banyan run --json` calls hash. */
  hash(): string;
  /** Record<string, string>: Header.result, of the run so far. */
  resultJson(): string;

  seed(): number;
  name(): string;
  /** The whole configuration, interventions included. */
  configJson(): string;
  /** The same as a scenario file: the program comes to the same hash at the same tick. */
  scenarioToml(): string;
  /** The run so far as an .mcap file. Takes as long as simulating it once more. Throws. */
  recording(): Uint8Array;

  /** Frees the memory; the object must not be used after. */
  delete(): void;
}

export interface BanyanLive {
  Live: new () => Live;
  /** Must be `columns` of src/frame.ts. */
  columns(): string[];
  /** What mission.algorithm chooses from. */
  algorithms(): string[];
  version(): string;
  git(): string;
}

export default function createBanyanLive(options?: {
  wasmBinary?: ArrayBuffer | Uint8Array;
  locateFile?: (path: string, prefix: string) => string;
}): Promise<BanyanLive>;
