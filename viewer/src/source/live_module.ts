// SPDX-License-Identifier: MIT
// The door of the compiled simulation as this side sees it (viewer/live/live.d.ts).

/** What `Live` in viewer/live/live.hpp says, method by method; what it throws is an Error with words. Made of WebAssembly memory: delete() it. */
export interface LiveClass {
  load(name: string, text: string, overrides: string[]): string[];
  loaded(): boolean;
  step(ticks: number): void;
  tick(): number;
  timeS(): number;
  finished(): boolean;
  complete(): boolean;
  rewind(tick: number): void;
  intervene(eventJson: string): string[];
  frame(): Float64Array;
  robots(): number;
  targetsJson(): string;
  settingJson(): string;
  settingVersion(): number;
  metricsJson(): string;
  takeEventsJson(): string;
  messageJson(robot: number): string;
  hash(): string;
  resultJson(): string;
  seed(): number;
  name(): string;
  configJson(): string;
  scenarioToml(): string;
  recording(): Uint8Array;
  delete(): void;
}

export interface LiveModule {
  Live: new () => LiveClass;
  columns(): string[];
  version(): string;
  git(): string;
}
