// SPDX-License-Identifier: MIT
// The worker that runs the simulation. The module is large: it is loaded once it is needed.
import { LiveHost } from './live_host';
import type { LiveModule } from './live_module';
import { Problem } from './problem';
import type { Request } from './protocol';

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

const host = new LiveHost((reply, transfer) => postMessage(reply, { transfer }), () => (module ??= load()));
addEventListener('message', (event: MessageEvent<Request>) => host.receive(event.data));
