// SPDX-License-Identifier: MIT
// A recording from a server: by ranges, without ranges, and when the server fails.
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { UrlBytes } from '../src/source/bytes';
import { Recording } from '../src/source/recording';
import { bytesOf, open, zstd } from './support';

let server: Server;
let base: string;
let requests = 0;
let gone = false;

beforeAll(async () => {
  const file = bytesOf('large');
  server = createServer((request, response) => {
    ++requests;
    const range = /^bytes=(\d+)-(\d+)$/.exec(request.headers.range ?? '');
    if (gone || request.url === '/none') return void response.writeHead(404).end();
    if (request.url === '/empty') return void response.writeHead(416).end();
    if (request.url === '/plain' || range === null) return void response.writeHead(200).end(file);
    const [from, to] = [Number(range[1]), Math.min(Number(range[2]), file.length - 1)];
    response.writeHead(206, { 'Content-Range': `bytes ${from}-${to}/${file.length}` }).end(file.subarray(from, to + 1));
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  base = `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
});
afterAll(() => void server.close());

const openAt = async (path: string, size = 0) => Recording.open(await UrlBytes.open(base + path, size), 'x', await zstd);

describe('a recording at a URL', () => {
  it.each(['/run.mcap', '/plain'])('%s is the same as the file', async (path) => {
    const file = await open(bytesOf('large'));
    const url = await openAt(path);
    expect(await url.frames(30, 31, 1)).toEqual(await file.frames(30, 31, 1));
    expect(url.headerNow()).toEqual({ ...file.headerNow(), name: 'x' });
  });

  it('is read in part, with few requests', async () => {
    requests = 0;
    const recording = await openAt('/run.mcap', bytesOf('large').length);
    await recording.frames(0, 0, 1);
    expect(requests).toBeLessThan(12);
    expect(recording.bytesRead).toBeLessThan(bytesOf('large').length / 2);
  });

  it('that is not there, empty, or goes away, is told in words', async () => {
    await expect(openAt('/none')).rejects.toThrow('cannot be loaded: the server answers 404');
    await expect(openAt('/empty')).rejects.toThrow('is empty');
    const recording = await openAt('/run.mcap');
    gone = true;
    await expect(recording.frames(50, 51, 1)).rejects.toThrow('cannot be loaded');
    gone = false;
    expect((await recording.frames(50, 51, 1)).frames.length).toBeGreaterThan(10); // and it is there again
    const port = (server.address() as AddressInfo).port;
    await expect(UrlBytes.open(`http://127.0.0.1:${port === 1 ? 2 : 1}/x`)).rejects.toThrow('the server does not answer');
  });
});
