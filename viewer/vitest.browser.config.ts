// SPDX-License-Identifier: MIT
// The tests that play the page in a browser; one after the other, for they share two cores with it.
import { defineConfig } from 'vitest/config';

export default defineConfig({
  test: {
    include: ['test/browser/**/*.test.ts'],
    fileParallelism: false,
    retry: 1, // a build machine that stalls for seconds is no fault of the page
    testTimeout: 60_000,
    hookTimeout: 60_000,
  },
});
