// SPDX-License-Identifier: MIT
// The simulation as a source of frames: the compiled class (viewer/live/) with a memory of what has been.
// Nothing here waits; live_host.ts decides how long it may simulate at a time.
import { columns, type Frame, type RunEvent, type Series } from '../frame';
import { History, type Kept } from './history';
import { isObject, type JsonObject, parseObject } from './json';
import type { LiveClass, LiveModule } from './live_module';
import { pack, type Packed, unpack } from './packed';
import { noTargets, parseEvent, parseTargets } from './parse';
import { Problem } from './problem';
import type { Act, FramesReply, Header, Intervention, LiveRequest, MessageFields, SaidAt } from './protocol';
import type { TimedSetting } from './provenance';
import { SeriesBuilder } from './series';
import { parseSetting } from './setting';

const framesBytes = 192 << 20;
const messagesBytes = 64 << 20;
/** Up to this size all robots' messages are kept; in larger swarms only those of robots asked for, from then on. */
const mostListened = 40;

interface Spoken extends Kept {
  json: Map<number, string>; // by robot
}

/** What a visitor did, and with which request: those of one are undone together. */
interface Deed extends Act {
  request: number;
}

export class LiveRun {
  private frames = new History<Packed>(framesBytes);
  private messages = new History<Spoken>(messagesBytes);
  private builder = new SeriesBuilder();
  private rowsSent = 0;
  private events: RunEvent[] = [];
  private eventsSent = 0;
  private whole = true; // the page knows nothing of the series yet, or something else
  private settings: TimedSetting[] = [];
  private settingVersion = NaN;
  private readonly listened = new Set<number>();
  private done: Deed[] = [];
  private requests = 0;
  /** To be done again once their tick comes. */
  private due: Deed[] = [];
  /** What was undone, a request each, the last one at the end. */
  private undone: Deed[][] = [];
  private result: Record<string, string> = {};
  private warnings: string[] = [];
  private tickS = 0.1;
  /** What the page knows of the header is no longer true. */
  headerChanged = true;

  private constructor(
    private readonly live: LiveClass, private readonly module: LiveModule, private readonly request: LiveRequest, private readonly threads: number,
  ) {}

  /** Throws a Problem with a line for each thing that is wrong with the scenario. `threads`: more than one needs the
   *  module that has them. */
  static load(module: LiveModule, request: LiveRequest, threads = 1): LiveRun {
    const run = new LiveRun(new module.Live(), module, request, threads);
    try {
      if (threads > 1) run.live.useThreads(threads);
      run.begin();
    } catch (problem) {
      run.close();
      throw problem;
    }
    const own = module.columns();
    if (own.join() !== columns.join()) throw new Error('the simulation speaks of other columns than this page');
    run.listenToAll();
    run.due = (request.acts ?? []).map((act) => ({ ...act, request: ++run.requests }));
    run.capture();
    return run;
  }

  /** The scenario again, without the interventions. */
  reset(): void {
    this.frames = new History<Packed>(framesBytes);
    this.messages = new History<Spoken>(messagesBytes);
    this.builder = new SeriesBuilder();
    this.events = [];
    this.settings = [];
    this.settingVersion = NaN;
    this.done = [];
    this.due = [];
    this.undone = [];
    this.result = {};
    this.whole = true;
    this.headerChanged = true;
    this.begin();
    this.capture();
  }

  private begin(): void {
    const { name, text, overrides } = this.request;
    const lines = this.live.load(name, text, overrides);
    if (!this.live.loaded()) throw new Problem(`${name} cannot be run`, lines);
    this.warnings = lines;
  }

  close(): void {
    this.live.delete();
  }

  get head(): number { return this.live.tick(); }
  get robots(): number { return this.live.robots(); }
  get tickLengthS(): number { return this.tickS; }
  /** Of the head at once; of an earlier tick by running the scenario once more, as it would be saved. Throws a Problem. */
  hashAt(tick: number): string {
    if (tick === this.head) return this.live.hash();
    if (!Number.isInteger(tick) || tick < 0 || tick > this.head) throw new Problem('that moment has not been simulated yet');
    const again = new this.module.Live();
    try {
      again.load(this.request.name.replace(/\.json$/, '.toml'), this.live.scenarioToml(), []);
      again.step(tick);
      return again.hash();
    } finally {
      again.delete();
    }
  }

  step(): void {
    if (this.due.length > 0) this.doDue();
    this.live.step(1);
    this.capture();
  }

  /** Everything in [fromS, toS] that there is, as `frames` in protocol.ts says. */
  framesReply(fromS: number, toS: number, stride: number): FramesReply {
    const from = Math.ceil(fromS / this.tickS - 1e-6);
    const found = this.frames.around(from, Math.floor(toS / this.tickS + 1e-6), stride);
    const endS = this.head * this.tickS;
    const all = this.head >= this.tickAfter(toS, stride);
    // Else up to the last frame of this stride: what is behind it has no frame on its other side yet.
    const untilS = all ? toS : Math.min(toS, Math.floor(this.head / stride) * stride * this.tickS);
    return { frames: found.map(unpack), untilS, endS };
  }

  /** The head that a request for frames up to `toS` needs. */
  tickAfter(toS: number, stride: number): number {
    return (Math.floor(toS / this.tickS / stride + 1e-6) + 1) * stride;
  }

  /** Null if it was not kept. */
  message(robot: number, tick: number): MessageFields | null {
    this.listened.add(robot);
    const json = tick >= this.head ? this.live.messageJson(robot) : this.messages.at(tick)?.json.get(robot);
    if (json === undefined || json === 'null') return null;
    return fieldsOf(parseObject(json));
  }

  /** What it said over a stretch of time, as far as it was kept. */
  said(robot: number, fromS: number, toS: number): SaidAt[] {
    this.listened.add(robot);
    return this.messages.around(Math.ceil(fromS / this.tickS - 1e-6), Math.floor(toS / this.tickS + 1e-6), 1).flatMap(({ tick, json }) => {
      const timeS = tick * this.tickS;
      const text = json.get(robot);
      const outside = timeS < fromS - 1e-6 || timeS > toS + 1e-6;
      return outside || text === undefined || text === 'null' ? [] : [{ timeS, fields: fieldsOf(parseObject(text)) }];
    });
  }

  /** Acts at the beginning of the step after `tick`, beside what was done there before. What is later is forgotten.
   *  Throws a Problem if it cannot be; then what was done later will happen again. */
  intervene(tick: number, events: Intervention[]): void {
    if (!Number.isInteger(tick) || tick < 0 || tick > this.head) throw new Problem('that moment has not been simulated yet');
    this.actAt(tick, events.map((event) => JSON.stringify(event)), ++this.requests);
    this.due = [];
    this.undone = [];
  }

  private actAt(tick: number, events: readonly string[], request: number): void {
    const before = [...this.done, ...this.due];
    if (tick < this.head) this.rewind(tick);
    this.due = before.filter((act) => act.tick > tick);
    for (const json of events) this.act(json, request);
  }

  /** Takes back what was done last, with all of that request. Returns the tick from which on all may differ; null:
   *  nothing was done. */
  undo(): number | null {
    const last = this.due.at(-1) ?? this.done.at(-1); // what is due comes after all that is done
    if (last === undefined) return null;
    const isLast = ({ request }: Deed) => request === last.request;
    const undone = [...this.undone, [...this.done, ...this.due].filter(isLast)];
    const tick = this.takeBack(last, this.done.filter((deed) => !isLast(deed)));
    this.undone = undone;
    return tick;
  }

  private takeBack({ tick, request }: Deed, kept: Deed[]): number {
    if (this.due.some((deed) => deed.request === request)) {
      this.due = this.due.filter((deed) => deed.request !== request);
      this.headerChanged = true;
      return Math.min(tick, this.head);
    }
    if (tick === 0) {
      this.reset();
      for (const deed of kept) this.again(deed);
      return 0;
    }
    this.done = kept;
    if (tick < this.head) {
      this.rewind(tick);
      return tick;
    }
    // Going back to the head itself would undo nothing.
    this.rewind(tick - 1);
    this.due = kept.filter((deed) => deed.tick === tick);
    this.step();
    return tick;
  }

  private doDue(): void {
    const now = this.due.filter(({ tick }) => tick === this.head);
    this.due = this.due.filter(({ tick }) => tick !== this.head);
    for (const deed of now) this.again(deed);
  }

  /** Does again what was undone last. Returns its tick; null: there is nothing. Throws a Problem if it cannot be. */
  redo(): number | null {
    const deeds = this.undone.at(-1);
    if (deeds === undefined) return null;
    const [{ tick, request }] = deeds;
    const rest = this.undone.slice(0, -1);
    if (tick > this.head) {
      this.due = [...this.due, ...deeds]; // when it comes
      this.headerChanged = true;
    } else {
      this.actAt(tick, deeds.map(({ json }) => json), request);
    }
    this.undone = rest;
    return tick;
  }

  /** What was done once, now; what cannot be any more (a link from another version) is a warning. */
  private again({ json, request }: Deed): void {
    try {
      this.act(json, request);
    } catch (problem) {
      if (!(problem instanceof Problem)) throw problem;
      this.warnings.push(`what was done at ${this.live.timeS().toFixed(1)} s cannot be done: ${problem.message}`);
      this.headerChanged = true;
    }
  }

  /** Now. */
  private act(json: string, request: number): void {
    const lines = this.live.intervene(json);
    if (lines.length > 0) throw new Problem(lines.join('; '), lines);
    this.done.push({ tick: this.head, json, request });
    this.headerChanged = true; // its configuration lists what was done
  }

  private rewind(tick: number): void {
    const here = this.done.filter((act) => act.tick === tick);
    this.done = this.done.filter((act) => act.tick < tick);
    this.live.rewind(tick); // forgets what was done at `tick` itself, too
    for (const deed of here) this.act(deed.json, deed.request);
    this.frames.cut(tick);
    this.messages.cut(tick);
    this.builder.cut(tick + 1); // a row per tick
    this.events = this.events.filter((event) => event.tick <= tick);
    this.settings = this.settings.filter(({ timeS }) => timeS <= (tick + 0.5) * this.tickS);
    this.settingVersion = this.live.settingVersion();
    if (!this.live.finished()) this.result = {};
    this.whole = true;
    this.headerChanged = true;
  }

  /** The rows and events that were not taken yet; null if there are none. */
  takeTable(): { series: Series; events: RunEvent[]; whole: boolean } | null {
    const { whole } = this;
    const firstRow = whole ? 0 : this.rowsSent;
    if (!whole && firstRow === this.builder.rows && this.eventsSent === this.events.length) return null;
    const table = { series: this.builder.take(firstRow), events: this.events.slice(whole ? 0 : this.eventsSent), whole };
    this.rowsSent = this.builder.rows;
    this.eventsSent = this.events.length;
    this.whole = false;
    return table;
  }

  header(): Header {
    this.headerChanged = false;
    const { live } = this;
    return {
      kind: 'live', name: this.request.name, settings: this.settings, robots: live.robots(), startS: 0,
      endS: this.head * this.tickS, growing: true, following: false, take: 0, version: this.module.version(), git: this.module.git(),
      seed: live.seed(), config: live.configJson(), result: this.result, warnings: this.warnings,
      acts: [...this.done, ...this.due].map(({ tick, json }) => ({ tick, json })), threads: this.threads,
    };
  }

  recording(): Uint8Array { return this.live.recording(); }
  scenario(): string { return this.live.scenarioToml(); }
  get name(): string { return this.live.name(); }

  private listenToAll(): void {
    const robots = this.live.robots();
    if (robots <= mostListened) for (let robot = 0; robot < robots; ++robot) this.listened.add(robot);
  }

  /** Keeps what the head looks like. */
  private capture(): void {
    const { live } = this;
    const tick = live.tick();
    if (live.settingVersion() !== this.settingVersion) this.captureSetting(live.timeS());
    const frame: Frame = { tick, timeS: live.timeS(), robots: live.robots(), data: live.frame(), targets: noTargets };
    this.frames.push(pack(frame, parseTargets(live.targetsJson())));
    this.builder.add(live.metricsJson());
    this.captureEvents();
    this.captureMessages(tick);
    if (live.finished() && Object.keys(this.result).length === 0) this.captureResult();
  }

  private captureSetting(timeS: number): void {
    this.settingVersion = this.live.settingVersion();
    const setting = parseSetting(this.live.settingJson(), (text) => this.warnings.push(text));
    this.settings.push({ timeS, setting });
    this.tickS = setting.tick_s;
    this.headerChanged = true;
  }

  private captureEvents(): void {
    const json = this.live.takeEventsJson();
    if (json === '[]') return;
    for (const event of JSON.parse(json) as unknown[]) this.events.push(parseEvent(JSON.stringify(event)));
  }

  private captureMessages(tick: number): void {
    if (this.listened.size === 0) return;
    const json = new Map([...this.listened].map((robot) => [robot, this.live.messageJson(robot)]));
    let bytes = 100;
    for (const text of json.values()) bytes += text.length + 60;
    this.messages.push({ tick, bytes, json });
  }

  private captureResult(): void {
    const result = parseObject(this.live.resultJson());
    this.result = Object.fromEntries(Object.entries(result).map(([key, value]) => [key, value === null ? '' : String(value)]));
    this.headerChanged = true;
  }
}

function fieldsOf(object: JsonObject): MessageFields {
  const fields = Object.entries(object).filter(([, value]) => value !== null && !isObject(value) && !Array.isArray(value));
  return Object.fromEntries(fields) as MessageFields;
}
