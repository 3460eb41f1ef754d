// SPDX-License-Identifier: MIT
// The worker that runs the simulation. The module is large: it is loaded once it is needed.
import { LiveHost } from './live_host';
import type { LiveModule } from './live_module';
import type { Request } from './protocol';

let module: Promise<LiveModule> | null = null;
const load = async (): Promise<LiveModule> => {
  const { default: create } = await import('@live/banyan_live.mjs');
  return await create();
};

const host = new LiveHost((reply, transfer) => postMessage(reply, { transfer }), () => (module ??= load()));
addEventListener('message', (event: MessageEvent<Request>) => host.receive(event.data));
