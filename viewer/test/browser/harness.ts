// SPDX-License-Identifier: MIT
// The page as a visitor meets it: served by `banyan view`, shown by Chromium. Everything is real: the
// program that CMake built ($BANYAN), the page that viewer/build made ($BANYAN_PAGE), Debian's browser.
import { spawn, execFileSync, type ChildProcess } from 'node:child_process';
import { mkdtempSync, rmSync, existsSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type BrowserContext, type Page } from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import { waitForRun } from './visitor';

const root = fileURLToPath(new URL('../../..', import.meta.url));
export const program = process.env.BANYAN ?? join(root, 'build/check/bin/banyan');
export const page = process.env.BANYAN_PAGE ?? join(root, 'build/viewer/page');
export const scenario = (name: string) => join(root, 'scenarios', `${name}.toml`);

/** What the program prints; throws with its stderr if it fails. */
export function banyan(...args: string[]): string {
  return execFileSync(program, args, { encoding: 'utf8', maxBuffer: 1 << 28 });
}

export class Folder {
  readonly path = mkdtempSync(join(tmpdir(), 'banyan-page-'));
  /** A recording of a run; the arguments follow `banyan run`. */
  record(name: string, ...args: string[]): string {
    banyan('run', ...args, '--out', join(this.path, name), '--quiet');
    return join(this.path, name, 'run.mcap');
  }
  remove(): void {
    rmSync(this.path, { recursive: true, force: true });
  }
}

export class Server {
  private constructor(private readonly child: ChildProcess, readonly url: string) {}

  static async start(...args: string[]): Promise<Server> {
    const child = spawn(program, ['view', ...args, '--no-open', '--page', page], { stdio: ['ignore', 'pipe', 'pipe'] });
    let said = '';
    const url = await new Promise<string>((resolve, reject) => {
      const listen = (data: Buffer) => {
        said += String(data);
        const found = /http:\/\/\S+/.exec(said);
        if (found) resolve(found[0]);
      };
      child.stdout.on('data', listen);
      child.stderr.on('data', listen);
      child.on('exit', (code) => reject(new Error(`banyan view ended with ${code}: ${said}`)));
    });
    return new Server(child, url);
  }

  stop(): Promise<number | null> {
    return new Promise((resolve) => {
      this.child.on('exit', (code) => resolve(code));
      this.child.kill('SIGTERM');
    });
  }
}

let shared: Promise<Browser> | null = null;

/** The one of this process, which ends with it. */
export function launch(): Promise<Browser> {
  return (shared ??= start());
}

async function start(): Promise<Browser> {
  const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';
  if (!existsSync(executablePath)) throw new Error('the package chromium is not installed');
  return chromium.launch({
    executablePath,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
  });
}

/** They last as long as the test: a run that goes on in a page nobody looks at slows down the tests after it. */
const contexts = new Set<BrowserContext>();

export async function closeContexts(): Promise<void> {
  await Promise.all([...contexts].map((context) => context.close()));
  contexts.clear();
}

/** A page on which any error that nobody caught fails the test that asks for `errors`. */
export async function open(browser: Browser, url: string, size = { width: 1280, height: 720 }): Promise<{ tab: Page; errors: string[] }> {
  const context = await browser.newContext({ viewport: size });
  contexts.add(context);
  const tab = await context.newPage();
  const errors: string[] = [];
  tab.on('pageerror', (error) => errors.push(String(error)));
  tab.on('console', (message) => { if (message.type() === 'error') errors.push(message.text()); });
  await tab.goto(url);
  return { tab, errors };
}

/** `banyan view` of what `given` names and a browser, as long as the tests of a file run. */
export function served(given: (folder: Folder) => string) {
  const folder = new Folder();
  let browser: Browser | undefined;
  let server: Server | undefined;
  beforeAll(async () => {
    server = await Server.start(given(folder));
    browser = await launch();
  }, 120_000);
  afterAll(async () => {
    await server?.stop();
    folder.remove();
  });
  const visit = async () => {
    const visitor = await open(browser!, server!.url);
    await waitForRun(visitor.tab);
    return visitor;
  };
  return { folder, visit };
}
