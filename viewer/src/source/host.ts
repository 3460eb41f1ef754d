// SPDX-License-Identifier: MIT
// What both workers share: requests are answered one after the other, a failure is a reply, and what
// takes long gives way.
import type { Frame } from '../frame';
import { Problem, wordsOf } from './problem';
import type { Reply, Request } from './protocol';

export type Post = (reply: Reply, transfer: Transferable[]) => void;

/** Lets messages come in: a macrotask, without the delay of setTimeout in browsers. */
export function nextTurn(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(null);
  });
}

export function idOf(request: Request): number {
  return 'id' in request ? request.id : 0;
}

export abstract class Host {
  private readonly queue: Request[] = [];
  private working = false;
  private idle: (() => void)[] = [];

  constructor(private readonly post: Post) {}

  /** Whatever a page sends. Never throws. */
  receive(request: Request): void {
    this.queue.push(request);
    if (!this.working) void this.work();
  }

  protected abstract answer(request: Request): Promise<void>;

  protected send(reply: Reply): void {
    this.post(reply, transferables(reply));
  }

  protected get busy(): boolean {
    return this.queue.length > 0;
  }

  /** For work in the background: after all requests that are there, and those that come meanwhile. */
  protected async pause(): Promise<void> {
    await nextTurn();
    while (this.working) await new Promise<void>((resolve) => this.idle.push(resolve));
  }

  private async work(): Promise<void> {
    this.working = true;
    for (let request; (request = this.queue.shift()) !== undefined; ) {
      try {
        await this.answer(request);
      } catch (error) {
        this.fail(idOf(request), error);
      }
    }
    this.working = false;
    for (const wake of this.idle.splice(0)) wake();
  }

  protected fail(id: number, error: unknown): void {
    if (!(error instanceof Problem)) console.error(error); // for debugging
    const problems = error instanceof Problem ? error.problems : [];
    this.send({ type: 'failed', id, text: wordsOf(error), ...(problems.length > 0 && { problems }) });
  }
}

function transferables(reply: Reply): Transferable[] {
  const buffers = new Set<ArrayBufferLike>();
  if (reply.type === 'frames') for (const frame of reply.frames) addFrame(buffers, frame);
  if (reply.type === 'series') for (const values of Object.values(reply.series)) buffers.add(values.buffer);
  return [...buffers] as ArrayBuffer[];
}

function addFrame(buffers: Set<ArrayBufferLike>, { data, targets }: Frame): void {
  for (const array of [data, targets.x, targets.y, targets.worker]) if (array.byteLength > 0) buffers.add(array.buffer);
}
