// SPDX-License-Identifier: MIT
// The page as plain static files: relative addresses, so that any web server, in any folder, can
// serve them. BANYAN_LIVE is the folder with the compiled simulation, BANYAN_LIVE_THREADS that with threads or "none",
// BANYAN_PAGE where to build.
import { readFileSync } from 'node:fs';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { defineConfig, type Plugin } from 'vite';

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));
const live = process.env.BANYAN_LIVE ?? here('../build/wasm/viewer');
const liveThreads = process.env.BANYAN_LIVE_THREADS ?? here('../build/wasm-threads/viewer');

// The page offers the algorithms that the simulation it is built with knows.
const { default: createLive } = await import(pathToFileURL(`${live}/banyan_live.mjs`).href);
const algorithms: string[] = (await createLive({ wasmBinary: readFileSync(`${live}/banyan_live.wasm`) })).algorithms();

/** The simulation with threads, beside the bundle and as it is. */
const threads: Plugin = {
  name: 'threads',
  generateBundle() {
    if (liveThreads === 'none') return;
    for (const ending of ['mjs', 'wasm', 'worker.js']) {
      const file = `banyan_live_threads.${ending}`;
      this.emitFile({ type: 'asset', fileName: `threads/${file}`, source: readFileSync(`${liveThreads}/${file}`) });
    }
  },
};

export default defineConfig({
  plugins: [threads],
  define: { builtInAlgorithms: JSON.stringify(algorithms), builtWithThreads: JSON.stringify(liveThreads !== 'none') },
  base: './',
  root: here('.'),
  publicDir: here('public'),
  cacheDir: here('../build/viewer/cache'),
  resolve: { alias: { '@live': live } },
  server: { fs: { allow: [here('.'), here('../docs'), here('../scenarios'), live] } }, // the simulation lies outside of this folder
  worker: { format: 'es' },
  build: { outDir: process.env.BANYAN_PAGE ?? here('../build/viewer/page'), emptyOutDir: true, target: 'es2022' },
  test: {
    include: ['test/**/*.test.ts'],
    exclude: ['test/browser/**'],
    globalSetup: 'test/recordings.setup.ts',
    testTimeout: 30000, // ms: on a machine that has other things to do
  },
} as Parameters<typeof defineConfig>[0]);
