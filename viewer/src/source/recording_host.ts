// SPDX-License-Identifier: MIT
// Answers the page's requests from a recording.
import { type Bytes, BlobBytes, UrlBytes } from './bytes';
import { Host, idOf, type Post } from './host';
import { lookEveryMs, until } from './mcap';
import { Problem, wordsOf } from './problem';
import type { Request } from './protocol';
import { type Growth, Recording } from './recording';
import type { Decompress } from './zstd';

class Replaced extends Error {}

/** `size` in bytes, if it is known to be another than when it was opened; 0: not known. */
type BytesOf = (size?: number) => Promise<Bytes>;

const mostUnanswered = 5; // looks at a server that is gone

export class RecordingHost extends Host {
  private recording: Recording | null = null;
  private told = 0; // warnings that the page knows
  private take = 0;

  constructor(post: Post, private readonly decompress: () => Promise<Decompress>) {
    super(post);
  }

  protected async answer(request: Request): Promise<void> {
    if (request.type === 'open') return await this.open(request.name, async () => new BlobBytes(request.file));
    if (request.type === 'open_url') return await this.open(request.name, (size = request.size) => UrlBytes.open(request.url, size));
    const { recording } = this;
    if (recording === null) throw new Problem('no recording is open');
    if (request.type === 'frames') {
      const stride = Math.max(1, Math.floor(request.stride) || 1);
      const reply = await recording.frames(request.fromS, request.toS, stride);
      this.send({ type: 'frames', id: request.id, ...reply });
    } else if (request.type === 'message') {
      this.send({ type: 'message', id: request.id, fields: await recording.message(request.robot, request.tick) });
    } else if (request.type === 'messages') {
      const { id, robot, fromS, toS } = request;
      this.send({ type: 'messages', id, said: await recording.said(robot, fromS, toS) });
    } else {
      this.fail(idOf(request), new Problem('a recording cannot be changed'));
    }
    this.tellWarnings(recording);
  }

  private async open(name: string, bytesOf: BytesOf): Promise<void> {
    this.recording = null;
    try {
      this.show(await Recording.open(await bytesOf(), name, await this.decompress()), name, bytesOf);
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      throw new Problem(`${name}: ${error.message}`);
    }
  }

  private show(recording: Recording, name: string, bytesOf: BytesOf): void {
    this.recording = recording;
    this.sendHeader(recording);
    void this.sendRest(recording, name, bytesOf);
  }

  private sendHeader(recording: Recording): void {
    this.told = recording.warningCount;
    this.send({ type: 'header', header: { ...recording.headerNow(), take: this.take } });
  }

  private async sendRest(recording: Recording, name: string, bytesOf: BytesOf): Promise<void> {
    await this.sendTable(recording);
    if (!recording.following || await this.follow(recording) !== 'another') return;
    try {
      const anew = await Recording.open(await bytesOf(0), name, await this.decompress());
      if (this.recording !== recording) return;
      ++this.take;
      this.show(anew, name, bytesOf);
    } catch (error) {
      this.letGo(recording, `it has begun anew, and cannot be read: ${wordsOf(error)}`);
    }
  }

  private letGo(recording: Recording, why: string): void {
    recording.letGo(why);
    this.sendHeader(recording);
  }

  /** Until it is finished, or another one, or cannot be had any more. */
  private async follow(recording: Recording): Promise<Growth> {
    for (let unanswered = 0; ; ) {
      await until(lookEveryMs);
      await this.pause();
      if (this.recording !== recording) return 'over';
      try {
        const growth = await recording.grow();
        unanswered = 0;
        if (growth === 'another') return growth;
        if (growth !== 'none') this.sendHeader(recording);
        if (growth !== 'none') await this.sendTable(recording);
        if (growth === 'over') return growth;
      } catch (error) {
        if (++unanswered < mostUnanswered) continue;
        this.letGo(recording, `it is not followed any more: ${wordsOf(error)}`);
        return 'over';
      }
    }
  }

  private async sendTable(recording: Recording): Promise<void> {
    const pause = async () => {
      await this.pause();
      if (this.recording !== recording) throw new Replaced();
    };
    try {
      const table = await recording.table(pause);
      await pause();
      this.send({ type: 'series', ...table });
      this.tellWarnings(recording);
    } catch (error) {
      if (!(error instanceof Replaced)) recording.warn(`the series could not be read: ${wordsOf(error)}`);
      if (!(error instanceof Replaced)) this.tellWarnings(recording);
    }
  }

  private tellWarnings(recording: Recording): void {
    if (recording.warningCount !== this.told) this.sendHeader(recording);
  }
}
