// SPDX-License-Identifier: MIT
// The worker that runs the simulation. The module is large: it is loaded once it is needed.
import { LiveHost } from './live_host';
import type { LiveModule } from './live_module';
import { Problem } from './problem';
import type { Request } from './protocol';

declare const builtWithThreads: boolean; // vite.config.ts

let module: Promise<LiveModule> | null = null;

async function load(): Promise<LiveModule> {
  try {
    const { default: create } = await import('@live/banyan_live.mjs');
    return await create();
  } catch (error) {
    module = null; // it may be there next time
    console.error(error);
    throw new Problem('a part of this page could not be loaded (the simulation)');
  }
}

/** Where the page is served isolated, as `banyan view` does. It is no part of the bundle: its own workers load it by its
 *  address (vite.config.ts puts it there). Null: it is not to be had, and one thread does. */
async function loadThreads(): Promise<LiveModule | null> {
  if (!builtWithThreads || !self.crossOriginIsolated) return null;
  try {
    const address = new URL('../threads/banyan_live_threads.mjs', self.location.href).href;
    const { default: create } = (await import(/* @vite-ignore */ address)) as typeof import('@live/banyan_live.mjs');
    return await create();
  } catch (error) {
    console.warn('one thread computes the run, because the others could not be loaded:', error);
    return null;
  }
}

const host = new LiveHost((reply, transfer) => postMessage(reply, { transfer }), () => (module ??= load()), loadThreads);
addEventListener('message', (event: MessageEvent<Request>) => host.receive(event.data));
