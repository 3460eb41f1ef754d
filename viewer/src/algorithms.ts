// SPDX-License-Identifier: MIT
// What a live run can choose from: the names that the compiled simulation knows (vite.config.ts asks it).
declare const builtInAlgorithms: string[];

export const algorithms: readonly string[] = builtInAlgorithms;
