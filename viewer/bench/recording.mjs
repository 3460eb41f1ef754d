// SPDX-License-Identifier: MIT
// Frames of a recording as plain JSON, for pictures and tests: the setting, and the frames at the given times with
// the trail before each.
import { open } from 'node:fs/promises';
import { McapIndexedReader } from '@mcap/core';
import { loadDecompressHandlers } from '@mcap/support';

/** The columns of src/frame.ts, in its order. */
const columns = ['x_m', 'y_m', 'heading_rad', 'role', 'phase', 'need', 'spare_state', 'alive', 'connected', 'epoch',
  'label_m', 'depth', 'parent', 'old_parent', 'grant', 'request', 'want_m', 'target'];

function readable(file, size) {
  return {
    size: async () => BigInt(size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await file.read(bytes, 0, bytes.length, Number(offset));
      return bytes;
    },
  };
}

export async function readRecording(path) {
  const file = await open(path);
  const { size } = await file.stat();
  const reader = await McapIndexedReader.Initialize({ readable: readable(file, size), decompressHandlers: await loadDecompressHandlers() });
  let setting;
  for await (const record of reader.readMetadata({ name: 'banyan.setting' })) setting = JSON.parse(record.metadata.get('json'));
  const frames = [];
  const metrics = [];
  let targets = { x_m: [], y_m: [], worker: [] };
  for await (const message of reader.readMessages({ topics: ['/banyan/targets', '/banyan/frame', '/banyan/metrics'] })) {
    const value = JSON.parse(new TextDecoder().decode(message.data));
    const topic = reader.channelsById.get(message.channelId).topic;
    if (topic === '/banyan/targets') targets = value;
    else if (topic === '/banyan/metrics') metrics.push(value);
    else frames.push({ tick: value.tick, timeS: value.time_s, robots: value.x_m.length, data: columns.flatMap((c) => value[c]), targets: { x: targets.x_m, y: targets.y_m, worker: targets.worker } });
  }
  await file.close();
  return { setting, frames, metrics };
}
