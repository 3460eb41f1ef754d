// SPDX-License-Identifier: MIT
// The worker that reads a recording.
import wasm from '@foxglove/wasm-zstd/dist/wasm-zstd.wasm?url';
import { Problem } from './problem';
import type { Request } from './protocol';
import { RecordingHost } from './recording_host';
import { type Decompress, loadZstd } from './zstd';

let zstd: Promise<Decompress> | null = null;

async function load(): Promise<Decompress> {
  try {
    return await loadZstd(await (await fetch(wasm)).arrayBuffer());
  } catch (error) {
    zstd = null; // it may be there next time
    console.error(error);
    throw new Problem('a part of this page could not be loaded (zstd)');
  }
}

const host = new RecordingHost((reply, transfer) => postMessage(reply, { transfer }), () => (zstd ??= load()));
addEventListener('message', (event: MessageEvent<Request>) => host.receive(event.data));
