// SPDX-License-Identifier: MIT
// After each test of a file; here, because the files share their modules, and those are set up only once.
import { afterEach } from 'vitest';
import { closeContexts } from './harness';

afterEach(closeContexts);
