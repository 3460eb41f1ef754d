// SPDX-License-Identifier: MIT
// Sources with their workers; apart from client.ts, which needs no browser.
import { Source } from './client';
import type { LiveRequest } from './protocol';

function recordingWorker(): Worker {
  return new Worker(new URL('./recording.worker.ts', import.meta.url), { type: 'module', name: 'recording' });
}

export function openFile(file: File): Source {
  return new Source(recordingWorker(), { type: 'open', file, name: file.name });
}

/** `size` in bytes, 0: not known. */
export function openUrl(url: string, name: string, size = 0): Source {
  const absolute = new URL(url, location.href).href; // a worker has an address of its own
  return new Source(recordingWorker(), { type: 'open_url', url: absolute, name, size });
}

export function openLive(run: LiveRequest): Source {
  const worker = new Worker(new URL('./live.worker.ts', import.meta.url), { type: 'module', name: 'live' });
  return new Source(worker, { type: 'open_live', run });
}
