// SPDX-License-Identifier: MIT
// Answers the page's requests from a live run, simulating as far as they need.
import { Host, nextTurn, type Post } from './host';
import { LiveRun } from './live';
import type { LiveModule } from './live_module';
import { Problem } from './problem';
import type { LiveRequest, Request } from './protocol';

const sliceMs = 25; // other requests wait no longer than that, and one tick
const mostMs = 200; // then what there is goes out, so that the page sees progress
const mostReplyBytes = 32 << 20;
const mostThreads = 4; // as many as the module has ready (viewer/CMakeLists.txt), and the worker itself
const leastRobots = 1000; // fewer have nothing to share: waiting for each other takes as long as what they do

type Of<Type extends Request['type']> = Extract<Request, { type: Type }>;

export class LiveHost extends Host {
  private run: LiveRun | null = null;

  /** `threaded`: the same with threads, where the page may have them. */
  constructor(post: Post, private readonly module: () => Promise<LiveModule>, private readonly threaded?: () => Promise<LiveModule | null>) {
    super(post);
  }

  protected async answer(request: Request): Promise<void> {
    if (request.type === 'open_live') return await this.open(request);
    const { run } = this;
    if (run === null) throw new Problem('no simulation is running');
    if (request.type === 'frames') await this.frames(run, request);
    else if (request.type === 'message') this.message(run, request);
    else if (request.type === 'messages') this.send({ type: 'messages', id: request.id, said: run.said(request.robot, request.fromS, request.toS) });
    else if (request.type === 'intervene') this.intervene(run, request);
    else if (request.type === 'reset') this.reset(run, request.id);
    else if (request.type === 'undo') this.undo(run, request.id);
    else if (request.type === 'redo') this.redo(run, request.id);
    else if (request.type === 'hash') this.send({ type: 'hash', id: request.id, hash: run.hashAt(request.tick) });
    else if (request.type === 'save_recording') this.saveRecording(run, request.id);
    else if (request.type === 'save_scenario') this.saveScenario(run, request.id);
    else throw new Problem('the simulation opens no recordings');
  }

  private async open({ run }: Of<'open_live'>): Promise<void> {
    this.run?.close();
    this.run = null;
    const plain = LiveRun.load(await this.module(), run);
    this.run = (await this.withThreads(plain, run)) ?? plain;
    this.tell(this.run);
  }

  /** The same run again, where that pays; null: it does not, or there are no threads. */
  private async withThreads(plain: LiveRun, request: LiveRequest): Promise<LiveRun | null> {
    const threads = Math.min(mostThreads, request.threads ?? 1);
    if (threads < 2 || plain.robots < leastRobots) return null;
    const module = (await this.threaded?.()) ?? null;
    if (module === null) return null;
    plain.close();
    return LiveRun.load(module, request, threads);
  }

  private async frames(run: LiveRun, { id, fromS, toS, stride: wanted }: Of<'frames'>): Promise<void> {
    const stride = Math.max(1, Math.floor(wanted) || 1);
    if (!Number.isFinite(fromS) || !Number.isFinite(toS)) throw new Problem('a time is not a number');
    const goal = Math.min(run.tickAfter(toS, stride), run.head + mostTicks(run));
    await this.simulate(run, goal);
    this.tell(run);
    this.send({ type: 'frames', id, ...run.framesReply(fromS, toS, stride) });
  }

  /** Up to `goal`, or until others want something or the time is up. */
  private async simulate(run: LiveRun, goal: number): Promise<void> {
    const start = performance.now();
    while (run.head < goal) {
      const until = performance.now() + sliceMs;
      do run.step();
      while (run.head < goal && performance.now() < until);
      await nextTurn();
      if (this.busy || performance.now() - start > mostMs) return;
    }
  }

  private message(run: LiveRun, { id, robot, tick }: Of<'message'>): void {
    this.send({ type: 'message', id, fields: run.message(robot, tick) });
  }

  private intervene(run: LiveRun, { id, tick, events }: Of<'intervene'>): void {
    try {
      run.intervene(tick, events);
    } finally {
      this.tell(run); // it may have gone back in any case
    }
    this.send({ type: 'done', id });
  }

  private reset(run: LiveRun, id: number): void {
    run.reset();
    this.tell(run);
    this.send({ type: 'done', id });
  }

  private undo(run: LiveRun, id: number): void {
    const tick = run.undo();
    this.tell(run);
    this.send({ type: 'undone', id, tick });
  }

  private redo(run: LiveRun, id: number): void {
    try {
      const tick = run.redo();
      this.tell(run);
      this.send({ type: 'undone', id, tick });
    } catch (problem) {
      this.tell(run); // it may have gone back in any case
      throw problem;
    }
  }

  private saveRecording(run: LiveRun, id: number): void {
    const bytes = run.recording() as Uint8Array<ArrayBuffer>;
    this.send({ type: 'file', id, name: `${fileName(run)}.mcap`, blob: new Blob([bytes], { type: 'application/octet-stream' }) });
  }

  private saveScenario(run: LiveRun, id: number): void {
    this.send({ type: 'file', id, name: `${fileName(run)}.toml`, blob: new Blob([run.scenario()], { type: 'text/plain' }) });
  }

  /** What has changed since the page was told. */
  private tell(run: LiveRun): void {
    if (run.headerChanged) this.send({ type: 'header', header: run.header() });
    const table = run.takeTable();
    if (table !== null) this.send({ type: 'series', ...table });
  }
}

// A request for a year is answered piece by piece.
function mostTicks(run: LiveRun): number {
  return Math.max(16, Math.floor(mostReplyBytes / (144 * Math.max(1, run.robots))));
}

function fileName(run: LiveRun): string {
  return run.name.replace(/[^A-Za-z0-9._-]+/g, '-') || 'live';
}
