// SPDX-License-Identifier: MIT
// A recording (docs/file-formats.md): frames by time range, decompressing only the chunks and parsing only
// the messages that are asked for. The worker around it is recording_host.ts.
import type { Frame, RunEvent, Series } from '../frame';
import type { Bytes } from './bytes';
import { Chunks, type Loaded } from './chunks';
import { inOrder, type Mcap, type Stretch } from './contents';
import { Malformed } from './json';
import { lookEveryMs, openMcap, until } from './mcap';
import { messageOf } from './message';
import { noTargets, parseEvent, parseFrame, parseTargets, peekTick } from './parse';
import { Problem, Warnings } from './problem';
import type { FramesReply, Header, MessageFields, SaidAt } from './protocol';
import { readProvenance, readResult, readSettings } from './provenance';
import type { Scanner } from './scan';
import { SeriesBuilder } from './series';
import { type Entry, nanoseconds, Track } from './track';
import type { Decompress } from './zstd';

const mostReplyBytes = 32 << 20; // of frames in one answer

export interface Table {
  series: Series;
  events: RunEvent[];
  whole: boolean; // from the start
}

/** What has become of a file that is being written. */
export type Growth = 'none' | 'more' | 'over' | 'another';

/** Of the channels, over the stretches that there were at one time. */
class Tracks {
  readonly stretches: readonly Stretch[];
  readonly frames: Track | null;
  readonly targets: Track | null;
  readonly messages: Track | null;
  readonly metrics: Track | null;
  readonly events: Track | null;
  readonly settings: Track | null;

  constructor(mcap: Mcap, chunks: Chunks) {
    this.stretches = inOrder(mcap.stretches);
    const of = (topic: string) => {
      const channel = [...mcap.channels.values()].find((c) => c.topic === topic && c.encoding === 'json');
      return channel === undefined ? null : new Track(chunks, channel.id, this.stretches);
    };
    this.frames = of('/banyan/frame');
    this.targets = of('/banyan/targets');
    this.messages = of('/banyan/messages');
    this.metrics = of('/banyan/metrics');
    this.events = of('/banyan/events');
    this.settings = of('/banyan/setting');
  }
}

export class Recording {
  private first!: Frame;
  private last!: Frame;
  private header!: Header;
  /** ns; 0 unless the frames' times are their ticks times this. */
  private tickNs = 0;
  /** So far read from the file, and chunks decompressed. */
  get bytesRead(): number { return this.bytes.taken; }
  get chunksUnpacked(): number { return this.chunks.unpacked; }

  private readonly builder = new SeriesBuilder(); // what the table has told
  private readonly tabled = new Set<Stretch>();

  private constructor(private readonly bytes: Bytes, private readonly mcap: Mcap, private readonly chunks: Chunks,
                      private tracks: Tracks, private readonly warnings: Warnings, private scanner: Scanner | null) {}

  /** Throws a Problem for what cannot be read as a recording. */
  static async open(bytes: Bytes, name: string, decompress: Decompress, cacheBytes?: number): Promise<Recording> {
    const warnings = new Warnings();
    const { mcap, scanner } = await openMcap(bytes, decompress, warnings);
    const chunks = new Chunks(bytes, decompress, warnings, cacheBytes);
    let tracks = new Tracks(mcap, chunks);
    for (; scanner !== null && bytes.growing && (tracks.frames?.stretches.length ?? 0) === 0; tracks = new Tracks(mcap, chunks)) {
      await until(lookEveryMs); // the first moment is still to come
      await bytes.look();
      await scanner.goOn();
    }
    if (tracks.frames === null) throw new Problem(because('is not a recording of Banyan: no channel /banyan/frame', warnings));
    const recording = new Recording(bytes, mcap, chunks, tracks, warnings, scanner);
    await recording.readEnds();
    await recording.readHeader(name);
    return recording;
  }

  /** It is still being written. */
  get following(): boolean { return this.scanner !== null; }

  /** Looks for what has been written since. Throws a Problem if the file cannot be had just now. */
  async grow(): Promise<Growth> {
    const { scanner } = this;
    if (scanner === null) return 'none';
    await this.bytes.look();
    if (!(await scanner.isSame())) return 'another';
    await scanner.goOn();
    const more = this.mcap.stretches.length > this.tracks.stretches.length;
    if (more) await this.takeIn();
    if (this.bytes.growing && !scanner.finished) return more ? 'more' : 'none';
    this.letGo(scanner.finished ? '' : 'whoever wrote this recording has ended without finishing it');
    return 'over';
  }

  /** Nothing more will be read of it; why, if that is no good end. */
  letGo(why: string): void {
    if (why !== '') this.warnings.add(why);
    this.scanner = null;
    this.header.result = readResult(this.mcap.metadata);
  }

  private async takeIn(): Promise<void> {
    this.tracks = new Tracks(this.mcap, this.chunks);
    this.last = (await this.nearest(this.frameTrack.backwards(Infinity), 1)) ?? this.last;
    this.header.endS = this.last.timeS;
    this.header.settings = await readSettings(this.tracks.settings, this.mcap.metadata, this.warnings);
  }

  private get frameTrack(): Track { return this.tracks.frames!; } // checked when it was opened

  /** As it is now: reading on may have found more damage. */
  headerNow(): Header {
    return { ...this.header, following: this.following, warnings: this.warnings.list() };
  }
  get warningCount(): number {
    return this.warnings.count;
  }
  warn(text: string): void {
    this.warnings.add(text);
  }

  /** As `frames` in protocol.ts says. */
  async frames(fromS: number, toS: number, stride: number): Promise<FramesReply> {
    const found: Frame[] = [];
    const most = Math.max(1, Math.floor(mostReplyBytes / (8 * this.first.data.length + 1)));
    const before = await this.nearest(this.frameTrack.backwards(nanoseconds(fromS) - 1, this.skipper(stride)), stride);
    if (before !== null) found.push(before);
    let untilS = toS;
    for await (const entry of this.frameTrack.forwards(nanoseconds(fromS), this.skipper(stride))) {
      const frame = this.selected(entry, stride) ? this.parse(entry) : null;
      if (frame === null) continue;
      found.push(frame);
      if (entry.time > nanoseconds(toS)) break; // the one after
      if (found.length > most) {
        untilS = frame.timeS;
        break;
      }
    }
    await this.addTargets(found);
    const { endS } = this.header;
    return { frames: found, untilS: this.following ? Math.min(untilS, endS) : untilS, endS };
  }

  /** What the robot broadcast last, at that tick; null if that is not recorded. */
  async message(robot: number, tick: number): Promise<MessageFields | null> {
    const { messages } = this.tracks;
    if (messages === null) return null;
    const time = nanoseconds((tick + 0.5) * this.header.settings[0].setting.tick_s);
    for await (const entry of messages.backwards(time)) {
      if ((peekTick(entry.head()) ?? 0) > tick) continue;
      const frame = await this.nearest(this.frameTrack.backwards(entry.time), 1);
      return this.attempt('messages', () => messageOf(entry.text(), robot, frame));
    }
    return null;
  }

  /** What the robot broadcast over a stretch of time; of fields that frames have, too, only the frames know. */
  async said(robot: number, fromS: number, toS: number): Promise<SaidAt[]> {
    const { messages } = this.tracks;
    if (messages === null) return [];
    const found: SaidAt[] = [];
    const to = nanoseconds(toS);
    for await (const entry of messages.forwards(nanoseconds(fromS), ({ start }) => start > to)) {
      if (entry.time > to) continue;
      const fields = this.attempt('messages', () => messageOf(entry.text(), robot, null));
      if (fields !== null) found.push({ timeS: entry.time * 1e-9, fields });
    }
    return found;
  }

  /** Reads what it has not told yet of the table, chunk by chunk; between two, `pause` lets others work. */
  async table(pause: () => Promise<void>): Promise<Table> {
    const { metrics, events, stretches } = this.tracks;
    const whole = this.tabled.size === 0;
    const { rows } = this.builder;
    const list: RunEvent[] = [];
    for (const stretch of stretches) {
      const tracks = [metrics, events].filter((track) => track?.mayHold(stretch));
      if (tracks.length === 0 || this.tabled.has(stretch)) continue;
      this.tabled.add(stretch);
      await pause();
      const loaded = await this.chunks.load(stretch, false);
      if (loaded === null) continue;
      this.each(metrics, loaded, 'metrics', (text) => this.builder.add(text));
      this.each(events, loaded, 'events', (text) => list.push(parseEvent(text)));
    }
    return { series: this.builder.take(rows), events: list, whole };
  }

  private each(track: Track | null, loaded: Loaded, name: string, take: (text: string) => void): void {
    for (const entry of track?.entriesIn(loaded) ?? []) this.attempt(name, () => take(entry.text()));
  }

  private attempt<T>(name: string, parse: () => T, kind = `damaged ${name}`): T | null {
    try {
      return parse();
    } catch (error) {
      if (!(error instanceof Malformed)) throw error;
      this.warnings.add(`${name}: ${error.message}`, kind);
      return null;
    }
  }

  private parse(entry: Entry): Frame | null {
    const timeS = entry.time * 1e-9;
    const frame = this.attempt(`the frame at ${Number(timeS.toFixed(4))} s was skipped`, () => parseFrame(entry.text()), 'a damaged frame');
    // Everything goes by log times; a frame must not claim another one.
    if (frame !== null && Math.abs(frame.timeS - timeS) > 1e-3) frame.timeS = timeS;
    return frame;
  }

  private async readEnds(): Promise<void> {
    const first = await this.nearest(this.frameTrack.forwards(0), 1);
    const last = first === null ? null : await this.nearest(this.frameTrack.backwards(Infinity), 1);
    if (first === null || last === null) throw new Problem(because('holds no frame', this.warnings));
    this.first = first;
    this.last = last;
  }

  private async readHeader(name: string): Promise<void> {
    const { metadata } = this.mcap;
    const provenance = readProvenance(metadata, this.warnings);
    const settings = await readSettings(this.tracks.settings, metadata, this.warnings);
    if (this.tracks.targets === null) this.warnings.add('it has no /banyan/targets channel');
    const tickS = settings[0].setting.tick_s;
    const regular = [this.first, this.last].every((f) => Math.abs(f.tick * tickS - f.timeS) < 0.1 * tickS);
    this.tickNs = regular ? tickS * 1e9 : 0;
    this.header = {
      kind: 'recording', name, settings, robots: this.first.robots, startS: this.first.timeS, endS: this.last.timeS, growing: false,
      following: this.following, take: 0,
      ...provenance, result: readResult(metadata), warnings: [],
    };
  }

  private async nearest(entries: AsyncGenerator<Entry>, stride: number): Promise<Frame | null> {
    for await (const entry of entries) {
      const frame = this.selected(entry, stride) ? this.parse(entry) : null;
      if (frame !== null) return frame;
    }
    return null;
  }

  private selected(entry: Entry, stride: number): boolean {
    if (stride <= 1) return true;
    const tick = peekTick(entry.head()) ?? this.parse(entry)?.tick ?? 0;
    return tick % stride === 0 || tick === this.first.tick || tick === this.last.tick;
  }

  /** At high speed most chunks of a large swarm hold no frame that is shown. */
  private skipper(stride: number): ((stretch: Stretch) => boolean) | undefined {
    const step = stride * this.tickNs;
    if (stride <= 1 || step === 0) return undefined;
    const ends = [this.first.timeS * 1e9, this.last.timeS * 1e9];
    const slack = 0.5 * this.tickNs;
    return ({ start, end }) => {
      const low = start - slack;
      const high = end + slack;
      return Math.ceil(low / step) * step > high && !ends.some((time) => time >= low && time <= high);
    };
  }

  /** The targets are those of the last message at or before a frame. */
  private async addTargets(frames: Frame[]): Promise<void> {
    const { targets } = this.tracks;
    if (targets === null || frames.length === 0) return;
    const changes = await between(targets, nanoseconds(frames[0].timeS), nanoseconds(frames.at(-1)!.timeS));
    let next = 0;
    let now = noTargets;
    for (const frame of frames) {
      const time = nanoseconds(frame.timeS);
      let latest: Entry | null = null;
      while (next < changes.length && changes[next].time <= time) latest = changes[next++];
      if (latest !== null) now = this.attempt('targets', () => parseTargets(latest.text())) ?? now;
      frame.targets = { x: now.x.slice(), y: now.y.slice(), worker: now.worker.slice() };
    }
  }
}

/** The messages from `from` to `to` (ns) and the last one before. */
async function between(track: Track, from: number, to: number): Promise<Entry[]> {
  const found: Entry[] = [];
  for await (const entry of track.backwards(from)) {
    found.push(entry);
    break;
  }
  for await (const entry of track.forwards(from + 1, (stretch) => stretch.start > to)) {
    if (entry.time <= to) found.push(entry);
  }
  return found;
}

function because(text: string, warnings: Warnings): string {
  return [text, ...warnings.list()].join('; ');
}
