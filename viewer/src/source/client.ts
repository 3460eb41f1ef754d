// SPDX-License-Identifier: MIT
// A source as the page sees it: a worker behind promises, its replies so far, and the frames around what
// is shown, fetched ahead of need.
import type { Frame, RunEvent, Series, Setting } from '../frame';
import { FrameCache, type Pair, type Span } from './cache';
import { Observable } from './emitter';
import { Problem } from './problem';
import type { Header, Intervention, MessageFields, Reply, Request, SaidAt } from './protocol';
import { SeriesTable } from './table';

/** The part of Worker that is used. */
export interface WorkerLike {
  postMessage(request: Request): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Reply>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  onmessageerror: ((event: MessageEvent) => void) | null;
}

export type OpenRequest = Extract<Request, { type: 'open' | 'open_url' | 'open_live' }>;
export interface SavedFile {
  name: string;
  blob: Blob;
}

interface Waiting {
  resolve: (reply: Reply) => void;
  reject: (problem: Problem) => void;
}

const mostInFlight = 2; // requests for frames: a jump elsewhere must not wait for a long queue
const mostAttempts = 3;
const aheadWallS = 1.5; // of playing that should always be there
const liveAheadWallS = 0.5;

export class Source {
  readonly header = new Observable<Header | null>(null);
  readonly series = new Observable<Series>({});
  readonly events = new Observable<RunEvent[]>([]);
  /** Not null: the source is lost, or could not be opened; in words. */
  readonly failure = new Observable<Problem | null>(null);
  /** Not null: some frames could not be had even after several attempts, in words; retry() tries again. */
  readonly trouble = new Observable<Problem | null>(null);
  /** Called with the time (s) after which everything may differ: a live run was interfered with. */
  readonly rewound = new Observable<number>(Infinity);
  /** Called when frames have come. */
  readonly arrived = new Observable<number>(0);

  private cache: FrameCache | null = null;
  private readonly table = new SeriesTable();
  private readonly waiting = new Map<number, Waiting>();
  private readonly inFlight = new Set<string>();
  private readonly attempts = new Map<string, number>();
  private nextId = 1;
  private generation = 0; // of the cache: answers to requests before a rewind are dropped
  private lastS = 0; // of the last frame that there is
  private undoing = 0; // changes of the past that the worker has not confirmed yet

  constructor(private readonly worker: WorkerLike, open: OpenRequest, private readonly cacheBytes?: number) {
    worker.onmessage = ({ data }) => this.receive(data);
    worker.onerror = (event) => this.lose(`this part of the page has crashed: ${event.message || 'it could not be loaded'}`);
    worker.onmessageerror = () => this.lose('this part of the page has crashed: a message could not be read');
    worker.postMessage(open);
  }

  get ready(): boolean { return this.cache !== null; }
  get startS(): number { return this.header.value?.startS ?? 0; }
  /** Of the last frame; a live run can go beyond it. */
  get endS(): number { return this.lastS; }
  /** A recording that is still being written. */
  get following(): boolean { return this.header.value?.following ?? false; }
  get growing(): boolean { return this.header.value?.growing ?? false; }
  get tickS(): number { return this.header.value?.settings[0].setting.tick_s ?? 0.1; }

  /** The setting that holds at a time; null before the source is open. */
  settingAt(timeS: number): Setting | null {
    const settings = this.header.value?.settings ?? [];
    let low = 0;
    for (let high = settings.length; low < high; ) {
      const middle = (low + high) >> 1;
      if (settings[middle].timeS <= timeS + 1e-9) low = middle + 1;
      else high = middle;
    }
    return settings[Math.max(0, low - 1)]?.setting ?? null;
  }

  /** The frames around a time, if they are here; never waits. A coarser stride serves in need. */
  pair(timeS: number, stride = 1): Pair | null {
    return this.cache?.pair(this.clamped(timeS), stride, this.growing) ?? null;
  }

  /** Cached frames in a stretch of time, for trails. */
  framesBetween(fromS: number, toS: number, stride = 1): Frame[] {
    return this.cache?.framesBetween(fromS, toS, stride) ?? [];
  }

  /** How far from one time to a later one frames are here, without a gap. */
  limit(fromS: number, toS: number, stride: number): number {
    const { cache } = this;
    if (cache === null) return fromS;
    let timeS = fromS;
    while (timeS < toS) {
      if (!this.growing && timeS >= this.endS) return toS;
      const pair = cache.pair(this.clamped(timeS), stride, this.growing, false);
      if (pair === null) break;
      if (pair.after === null) return !this.growing && pair.before.timeS >= this.endS - 1e-9 ? toS : timeS;
      timeS = Math.max(pair.after.timeS, timeS + 1e-6);
    }
    return Math.min(timeS, toS);
  }

  /** Sees to it that what is shown now and soon is here. `speed`: s of the run per s; 0 standing still,
   *  negative when the visitor drags backwards. */
  prefetch(timeS: number, speed: number, stride: number): void {
    const { cache } = this;
    if (cache === null || this.failure.value !== null) return;
    const block = cache.durationS(stride);
    const count = Math.max(1, Math.min(6, Math.ceil((Math.abs(speed) * aheadWallS) / block)));
    const now = cache.spanAt(this.clamped(timeS), stride);
    for (let k = 0; k <= count; ++k) {
      const span = { stride, index: now.index + (speed < 0 ? -k : k) };
      if (span.index < 0 || !this.reaches(span, cache)) continue;
      if (this.growing) this.fetchLive(span, cache, timeS, Math.abs(speed));
      else if (!this.following || (cache.missingFrom(span) ?? Infinity) < this.endS - 1e-9) this.fetch(span, cache, cache.endOf(span));
    }
  }

  // What is simulated ahead is lost when the visitor interferes, so a live run keeps just ahead of the clock.
  private fetchLive(span: Span, cache: FrameCache, timeS: number, speed: number): void {
    const aheadS = Math.max(speed * liveAheadWallS, 4 * span.stride * this.tickS);
    const missing = cache.missingFrom(span);
    if (missing !== null && missing < timeS + 0.5 * aheadS) this.fetch(span, cache, Math.min(cache.endOf(span), timeS + aheadS));
  }

  /** After trouble: a server may be there again. */
  retry(): void {
    this.attempts.clear();
    this.trouble.set(null);
  }

  /** All frames from one time to another, whether they are shown or not. */
  async frames(fromS: number, toS: number): Promise<Frame[]> {
    const reply = await this.ask((id) => ({ type: 'frames', id, fromS, toS, stride: 1 }));
    return reply.type === 'frames' ? reply.frames : [];
  }

  async message(robot: number, tick: number): Promise<MessageFields | null> {
    const reply = await this.ask((id) => ({ type: 'message', id, robot, tick }));
    return reply.type === 'message' ? reply.fields : null;
  }

  /** What a robot said over a stretch of time, as far as it was kept. */
  async messages(robot: number, fromS: number, toS: number): Promise<SaidAt[]> {
    const reply = await this.ask((id) => ({ type: 'messages', id, robot, fromS, toS }));
    return reply.type === 'messages' ? reply.said : [];
  }

  /** Acts at the beginning of the step after `tick`; what was simulated beyond is forgotten. */
  intervene(tick: number, events: Intervention[]): Promise<void> {
    return this.changePast(tick * this.tickS, (id) => ({ type: 'intervene', id, tick, events }));
  }

  /** Back to the start, without the interventions. */
  reset(): Promise<void> {
    return this.changePast(0, (id) => ({ type: 'reset', id }));
  }

  /** Takes back what was done last; the tick in which it had been done, null: nothing was. */
  undo(): Promise<number | null> { return this.again('undo'); }
  /** Does it again; null: there is nothing that was undone. */
  redo(): Promise<number | null> { return this.again('redo'); }

  private async again(type: 'undo' | 'redo'): Promise<number | null> {
    ++this.undoing;
    try {
      const reply = await this.ask((id) => ({ type, id }));
      const tick = reply.type === 'undone' ? reply.tick : null;
      if (tick !== null) this.forgetAfter(tick * this.tickS);
      return tick;
    } finally {
      --this.undoing;
    }
  }

  /** Live: 16 hexadecimal digits over everything that can influence a later tick. */
  async hash(tick: number): Promise<string> {
    const reply = await this.ask((id) => ({ type: 'hash', id, tick }));
    return reply.type === 'hash' ? reply.hash : '';
  }

  async saveRecording(): Promise<SavedFile> {
    return fileOf(await this.ask((id) => ({ type: 'save_recording', id })));
  }
  async saveScenario(): Promise<SavedFile> {
    return fileOf(await this.ask((id) => ({ type: 'save_scenario', id })));
  }

  close(): void {
    if (this.failure.value === null) this.lose('it was closed');
  }

  private clamped(timeS: number): number {
    return this.growing ? Math.max(timeS, this.startS) : Math.min(Math.max(timeS, this.startS), this.endS);
  }

  // Behind the end of a recording there is nothing; a live run goes on.
  private reaches(span: Span, cache: FrameCache): boolean {
    return this.growing || cache.startOf(span) <= this.endS;
  }

  private fetch(span: Span, cache: FrameCache, toS: number): void {
    const key = `${span.stride}:${span.index}`;
    const fromS = cache.missingFrom(span);
    const tried = this.attempts.get(key) ?? 0;
    if (fromS === null || this.inFlight.has(key) || this.inFlight.size >= mostInFlight || tried >= mostAttempts) return;
    const { generation } = this;
    this.inFlight.add(key);
    this.ask((id) => ({ type: 'frames', id, fromS, toS, stride: span.stride }))
      .then((reply) => {
        if (generation !== this.generation || reply.type !== 'frames') return;
        this.inFlight.delete(key);
        this.attempts.delete(key);
        this.lastS = Math.max(this.lastS, reply.endS);
        cache.put(span, reply);
        this.arrived.set(this.arrived.value + 1);
      })
      .catch((problem: Problem) => {
        if (generation !== this.generation) return;
        this.inFlight.delete(key);
        this.attempts.set(key, tried + 1);
        if (tried + 1 === mostAttempts && this.failure.value === null) this.trouble.set(problem);
      });
  }

  /** What is undone is forgotten before the worker knows, or it would be shown until the answer comes. Whatever is
   *  asked for from now on is answered after the change; if that fails, the same frames are only fetched again. */
  private async changePast(fromS: number, make: (id: number) => Request): Promise<void> {
    this.forgetAfter(fromS);
    ++this.undoing;
    try {
      await this.ask(make);
    } finally {
      --this.undoing;
    }
  }

  private forgetAfter(timeS: number): void {
    this.cache?.dropAfter(timeS);
    ++this.generation;
    this.inFlight.clear();
    this.attempts.clear();
    this.lastS = Math.min(this.lastS, timeS);
    this.rewound.set(timeS);
  }

  private ask(make: (id: number) => Request): Promise<Reply> {
    if (this.failure.value !== null) return Promise.reject(this.failure.value);
    const id = this.nextId++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage(make(id));
    });
  }

  private receive(reply: Reply): void {
    if (reply.type === 'header') return this.takeHeader(reply.header);
    if (reply.type === 'series') return this.takeSeries(reply);
    if (reply.type === 'failed' && reply.id === 0) return this.lose(reply.text, reply.problems);
    const waiting = this.waiting.get(reply.id);
    this.waiting.delete(reply.id);
    if (reply.type === 'failed') waiting?.reject(new Problem(reply.text, reply.problems));
    else waiting?.resolve(reply);
  }

  private takeHeader(header: Header): void {
    const before = this.header.value;
    if (before !== null && before.take !== header.take) {
      this.cache = null;
      this.forgetAfter(-1); // all of it
    }
    // A reply under way when the past was changed reports an end that no longer exists.
    this.lastS = this.undoing > 0 ? Math.min(this.lastS, header.endS) : header.endS;
    this.cache ??= new FrameCache(header.settings[0].setting.tick_s, header.robots, this.cacheBytes);
    this.header.set(header);
  }

  private takeSeries({ series, events, whole }: Extract<Reply, { type: 'series' }>): void {
    if (whole) this.table.replace(series);
    else this.table.append(series);
    this.series.set(this.table.value);
    this.events.set(whole ? events : this.events.value.concat(events));
  }

  private lose(text: string, problems?: string[]): void {
    const problem = new Problem(text, problems);
    this.worker.terminate();
    for (const { reject } of this.waiting.values()) reject(problem);
    this.waiting.clear();
    this.failure.set(problem);
  }
}

function fileOf(reply: Reply): SavedFile {
  if (reply.type !== 'file') throw new Problem('there is no file');
  return { name: reply.name, blob: reply.blob };
}
