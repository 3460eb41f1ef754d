// SPDX-License-Identifier: MIT
// Makes test/scene.links.json: how many radio links, open and blocked, the program draws in moments of recordings.
//   node viewer/bench/links_fixture.mjs BANYAN RUNS NAME@SECONDS... > viewer/test/scene.links.json
// BANYAN is the program, RUNS has a folder per scenario with its run.mcap.
import { execFileSync } from 'node:child_process';
import { readRecording } from './recording.mjs';

const [banyan, runs, ...moments] = process.argv.slice(2);
const cases = [];
for (const moment of moments) {
  const [name, at] = moment.split('@');
  const file = `${runs}/${name}/run.mcap`;
  const { setting, frames } = await readRecording(file);
  const frame = frames.findLast((f) => f.timeS <= Number(at) + 1e-9);
  const svg = execFileSync(banyan, ['draw', file, '--at', at, '--blocked', '--trail', '0', '--no-legend'], { encoding: 'utf8', maxBuffer: 1 << 28 });
  const count = (color) => {
    const path = svg.split('\n').find((line) => line.startsWith('<path') && line.includes(`stroke="${color}"`));
    return path ? path.split(' d="')[1].split('M').length - 1 : 0;
  };
  const n = frame.robots;
  const part = (c) => frame.data.slice(c * n, (c + 1) * n);
  cases.push({ name: `${name} at ${at} s`, open: count('#b8b8b8'), blocked: count('#56b4e9'), setting, x_m: part(0), y_m: part(1), alive: part(7) });
}
console.log(JSON.stringify(cases).replaceAll('{"name":"', '\n{"name":"'));
