// SPDX-License-Identifier: MIT
// Answers the page's requests from a recording.
import { type Bytes, BlobBytes, UrlBytes } from './bytes';
import { Host, idOf, type Post } from './host';
import { Problem, wordsOf } from './problem';
import type { Request } from './protocol';
import { Recording } from './recording';
import type { Decompress } from './zstd';

class Replaced extends Error {}

export class RecordingHost extends Host {
  private recording: Recording | null = null;
  private told = 0; // warnings that the page knows

  constructor(post: Post, private readonly decompress: () => Promise<Decompress>) {
    super(post);
  }

  protected async answer(request: Request): Promise<void> {
    if (request.type === 'open') return await this.open(request.name, async () => new BlobBytes(request.file));
    if (request.type === 'open_url') return await this.open(request.name, () => UrlBytes.open(request.url, request.size));
    const { recording } = this;
    if (recording === null) throw new Problem('no recording is open');
    if (request.type === 'frames') {
      const stride = Math.max(1, Math.floor(request.stride) || 1);
      const reply = await recording.frames(request.fromS, request.toS, stride);
      this.send({ type: 'frames', id: request.id, ...reply });
    } else if (request.type === 'message') {
      this.send({ type: 'message', id: request.id, fields: await recording.message(request.robot, request.tick) });
    } else {
      this.fail(idOf(request), new Problem('a recording cannot be changed'));
    }
    this.tellWarnings(recording);
  }

  private async open(name: string, bytesOf: () => Promise<Bytes>): Promise<void> {
    this.recording = null;
    try {
      this.recording = await Recording.open(await bytesOf(), name, await this.decompress());
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      throw new Problem(`${name}: ${error.message}`);
    }
    this.told = this.recording.warningCount;
    this.send({ type: 'header', header: this.recording.headerNow() });
    void this.sendTable(this.recording);
  }

  private async sendTable(recording: Recording): Promise<void> {
    const pause = async () => {
      await this.pause();
      if (this.recording !== recording) throw new Replaced();
    };
    try {
      const table = await recording.table(pause);
      await pause();
      this.send({ type: 'series', ...table, whole: true });
      this.tellWarnings(recording);
    } catch (error) {
      if (!(error instanceof Replaced)) recording.warn(`the series could not be read: ${wordsOf(error)}`);
      if (!(error instanceof Replaced)) this.tellWarnings(recording);
    }
  }

  private tellWarnings(recording: Recording): void {
    if (recording.warningCount === this.told) return;
    this.told = recording.warningCount;
    this.send({ type: 'header', header: recording.headerNow() });
  }
}
