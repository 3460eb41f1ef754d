// SPDX-License-Identifier: MIT
// The worker that reads a recording.
import wasm from '@foxglove/wasm-zstd/dist/wasm-zstd.wasm?url';
import type { Request } from './protocol';
import { RecordingHost } from './recording_host';
import { type Decompress, loadZstd } from './zstd';

let zstd: Promise<Decompress> | null = null;
const load = async () => await loadZstd(await (await fetch(wasm)).arrayBuffer());

const host = new RecordingHost((reply, transfer) => postMessage(reply, { transfer }), () => (zstd ??= load()));
addEventListener('message', (event: MessageEvent<Request>) => host.receive(event.data));
