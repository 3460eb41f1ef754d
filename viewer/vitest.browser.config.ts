// SPDX-License-Identifier: MIT
// The tests that play the page in a browser; two files at a time, for they share two cores with it. The files of a
// process share its modules and its browser, since to start those takes longer than many a test.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['test/browser/**/*.test.ts'],
    setupFiles: ['test/browser/contexts.setup.ts'],
    pool: 'forks',
    isolate: false,
    poolOptions: { forks: { minForks: 2, maxForks: 2 } },
    retry: 1, // a build machine that stalls for seconds is no fault of the page
    testTimeout: 60_000,
    hookTimeout: 60_000,
  },
});
