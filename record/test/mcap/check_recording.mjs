// SPDX-License-Identifier: MIT
// Reads Banyan's recordings with the official MCAP library, indexed and streamed, with all CRCs
// validated, and compares them with the CSV export. Usage:
//   node check_recording.mjs DIRECTORY            the files of sample_files.cpp
//   node check_recording.mjs RUN.mcap [RUN.csv]   any recording, and its export
import assert from "node:assert/strict";
import { open, readFile, stat } from "node:fs/promises";
import path from "node:path";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { loadDecompressHandlers } from "@mcap/support";

const decompressHandlers = await loadDecompressHandlers();
const decoder = new TextDecoder("utf-8", { fatal: true });
const parse = (message) => JSON.parse(decoder.decode(message.data));

class FileReadable {
  constructor(handle) { this.handle = handle; }
  async size() { return BigInt((await this.handle.stat()).size); }
  async read(offset, length) {
    const buffer = new Uint8Array(Number(length));
    const { bytesRead } = await this.handle.read(buffer, 0, Number(length), Number(offset));
    assert.equal(bytesRead, Number(length));
    return buffer;
  }
}

// Just enough JSON Schema for what a recording carries; an unknown keyword is an error, so that
// nothing passes unchecked.
function validate(schema, value, where) {
  const known = new Set(["title", "description", "$comment", "type", "properties", "items", "required", "oneOf",
    "const", "minimum", "maximum", "contentEncoding"]);
  for (const key of Object.keys(schema)) assert.ok(known.has(key), `${where}: schema keyword ${key}`);
  if (schema.oneOf) {
    assert.equal(schema.oneOf.filter((s) => s.const === value).length, 1, `${where}: one of the constants`);
  }
  const types = schema.type === undefined ? [] : [schema.type].flat();
  const is = {
    object: (v) => v !== null && typeof v === "object" && !Array.isArray(v), array: Array.isArray,
    string: (v) => typeof v === "string", number: (v) => typeof v === "number", integer: Number.isInteger,
    boolean: (v) => typeof v === "boolean", null: (v) => v === null,
  };
  if (types.length > 0) assert.ok(types.some((t) => is[t](value)), `${where}: ${JSON.stringify(value)} is no ${types}`);
  if (schema.minimum !== undefined) assert.ok(value >= schema.minimum, `${where}: minimum`);
  if (schema.maximum !== undefined) assert.ok(value <= schema.maximum, `${where}: maximum`);
  for (const name of schema.required ?? []) assert.ok(name in value, `${where}: ${name} is missing`);
  if (is.object(value) && schema.properties) {
    for (const [name, member] of Object.entries(value)) {
      assert.ok(schema.properties[name], `${where}: ${name} is not in the schema`);
      validate(schema.properties[name], member, `${where}.${name}`);
    }
  }
  if (Array.isArray(value) && schema.items) value.forEach((v, k) => validate(schema.items, v, `${where}[${k}]`));
}

async function indexed(file, use) {
  const handle = await open(file);
  try {
    return await use(await McapIndexedReader.Initialize({ readable: new FileReadable(handle), decompressHandlers }));
  } finally {
    await handle.close();
  }
}

// Every record in file order; the stream reader checks chunk and data section CRCs.
async function streamed(file) {
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  reader.append(await readFile(file));
  const records = [];
  for (let record; (record = reader.nextRecord()); ) records.push(record);
  return { records, done: reader.done() };
}

async function checkRecording(file) {
  const { records, done } = await streamed(file);
  assert.ok(done, "the file ends with a footer");
  assert.equal(records[0].type, "Header");
  for (const type of ["Footer", "DataEnd"]) assert.ok(records.some((r) => r.type === type), type);
  assert.notEqual(records.find((r) => r.type === "DataEnd").dataSectionCrc, 0);
  assert.notEqual(records.find((r) => r.type === "Footer").summaryCrc, 0);
  const counts = new Map();
  for (const r of records) if (r.type === "Message") counts.set(r.channelId, (counts.get(r.channelId) ?? 0n) + 1n);

  return await indexed(file, async (reader) => {
    const topics = new Map([...reader.channelsById.values()].map((c) => [c.topic, c]));
    for (const topic of ["/banyan/frame", "/banyan/targets", "/banyan/metrics", "/banyan/events"]) {
      assert.ok(topics.has(topic), `channel ${topic}`);
    }
    // Statistics against what was streamed, per channel.
    for (const [id, count] of reader.statistics.channelMessageCounts) assert.equal(counts.get(id) ?? 0n, count);
    assert.equal([...counts.values()].reduce((a, b) => a + b, 0n), reader.statistics.messageCount);
    assert.equal(reader.chunkIndexes.length, reader.statistics.chunkCount);

    // Every message of every channel against the schema it carries, in order of time.
    let last = 0n;
    const frames = [];
    for await (const message of reader.readMessages({ validateCrcs: true })) {
      assert.ok(message.logTime >= last);
      last = message.logTime;
      const channel = reader.channelsById.get(message.channelId);
      const schema = reader.schemasById.get(channel.schemaId);
      assert.equal(channel.messageEncoding, "json");
      assert.equal(schema.encoding, "jsonschema");
      const value = parse(message);
      validate(JSON.parse(decoder.decode(schema.data)), value, channel.topic);
      if (channel.topic === "/banyan/frame") frames.push(value);
    }
    if (topics.has("/scene")) {
      assert.equal(reader.schemasById.get(topics.get("/scene").schemaId).name, "foxglove.SceneUpdate");
    }

    // Metadata through its index.
    const metadata = new Map();
    for await (const record of reader.readMetadata()) metadata.set(record.name, record.metadata);
    JSON.parse(metadata.get("banyan.provenance").get("config"));
    assert.match(metadata.get("banyan.result").get("hash"), /^[0-9a-f]{16}$/);

    await checkSeek(reader, frames);
    return { frames, metadata, reader };
  });
}

// A range in the middle gives exactly the frames of that range.
async function checkSeek(reader, frames) {
  if (frames.length < 3) return;
  const low = frames[Math.floor(frames.length / 3)].time_s;
  const high = frames[Math.floor((2 * frames.length) / 3)].time_s;
  const ns = (seconds) => BigInt(Math.round(seconds * 1e9));
  const got = [];
  const range = { topics: ["/banyan/frame"], startTime: ns(low), endTime: ns(high) };
  for await (const message of reader.readMessages(range)) got.push(parse(message).tick);
  assert.deepEqual(got, frames.filter((f) => f.time_s >= low && f.time_s <= high).map((f) => f.tick));
}

async function checkExport(frames, file) {
  const roles = ["spare", "connector", "worker", "root"];
  const phases = ["init", "start_tree", "select_parent", "grow_tree", "select_root"];
  const lines = (await readFile(file, "utf8")).trimEnd().split("\n").map((line) => line.split(","));
  const header = lines.shift();
  let row = 0;
  for (const frame of frames) {
    for (let robot = 0; robot < frame.x_m.length; ++robot) {
      const cell = Object.fromEntries(header.map((name, k) => [name, lines[row][k]]));
      ++row;
      assert.equal(Number(cell.tick), frame.tick);
      assert.equal(Number(cell.robot), robot);
      for (const name of ["x_m", "y_m", "heading_rad"]) assert.equal(Number(cell[name]), frame[name][robot]);
      for (const name of ["alive", "connected"]) assert.equal(Number(cell[name]), frame[name][robot]);
      for (const name of ["parent", "old_parent", "target"]) {
        assert.equal(cell[name] === "" ? -1 : Number(cell[name]), frame[name][robot]);
      }
      assert.equal(roles.indexOf(cell.role), frame.role[robot]);
      assert.equal(phases.indexOf(cell.phase), frame.phase[robot]);
    }
  }
  assert.equal(row, lines.length, "as many rows as robots times frames");
}

async function checkSamples(directory) {
  const file = (name) => path.join(directory, name);
  const { frames, reader } = await checkRecording(file("sample.mcap"));
  assert.deepEqual(frames.map((f) => f.tick), Array.from({ length: 300 }, (_, k) => k));
  assert.ok(reader.chunkIndexes.length > 3);
  assert.ok(reader.chunkIndexes.every((c) => c.compression === "zstd"));
  await checkExport(frames, file("sample.csv"));

  const world = await checkRecording(file("world.mcap"));
  const messages = world.reader.statistics.channelMessageCounts;
  const channel = (topic) => [...world.reader.channelsById.values()].find((c) => c.topic === topic).id;
  assert.equal(messages.get(channel("/banyan/messages")), BigInt(world.frames.length));
  // Plots and events can be read without what is large: no chunk holds both.
  const large = ["/banyan/frame", "/banyan/messages", "/scene"].map(channel);
  for (const chunk of world.reader.chunkIndexes) {
    const inside = [...chunk.messageIndexOffsets.keys()];
    const count = inside.filter((id) => large.includes(id)).length;
    assert.ok(count === 0 || count === inside.length, `chunk with ${inside}`);
  }

  const plain = await checkRecording(file("plain.mcap"));
  assert.deepEqual(plain.frames.map((f) => f.tick), Array.from({ length: 21 }, (_, k) => 5 * k));

  const empty = await checkRecording(file("empty.mcap"));
  assert.equal(empty.frames.length, 0);
  assert.equal(empty.metadata.get("banyan.result").get("interrupted"), "true");

  // Cut short: no index, but the stream reader finds all that was flushed.
  await assert.rejects(indexed(file("cut.mcap.part"), async () => {}));
  const cut = await streamed(file("cut.mcap.part"));
  const id = cut.records.find((r) => r.type === "Channel" && r.topic === "/banyan/frame").id;
  assert.equal(cut.records.filter((r) => r.type === "Message" && r.channelId === id).length, 50);

  // The checks can fail: one flipped byte in a chunk is found.
  const bytes = await readFile(file("plain.mcap"));
  bytes[bytes.indexOf('"heading_rad":[') + 1] ^= 1;
  const damaged = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  damaged.append(bytes);
  assert.throws(() => { while (damaged.nextRecord()); }, /CRC/i);
}

const [first, csv] = process.argv.slice(2);
if (first === undefined) throw new Error("usage: check_recording.mjs DIRECTORY | RUN.mcap [RUN.csv]");
if ((await stat(first)).isDirectory()) {
  await checkSamples(first);
} else {
  const { frames } = await checkRecording(first);
  if (csv !== undefined) await checkExport(frames, csv);
  console.log(`${frames.length} frames`);
}
console.log("ok");
