// SPDX-License-Identifier: MIT
// The inspector is told what the robot said in the run that is shown, not in another one.
import { describe, expect, it } from 'vitest';
import type { Inspected, Inspector } from '../src/panels/inspector';
import { RobotWatch } from '../src/robot_watch';
import { Problem } from '../src/source/problem';
import type { MessageFields } from '../src/source/protocol';
import type { Stage } from '../src/stage';
import { frameOf, settingOf } from './scene_frames';

class Run {
  tick = 4;
  readonly asked: string[] = [];
  private readonly waiting: { resolve(fields: MessageFields | null): void; reject(problem: Error): void }[] = [];
  readonly stage: Stage;

  constructor() {
    const stage = {
      source: {
        settingAt: () => settingOf({ algorithm: 'inwards' }),
        message: (robot: number, tick: number) => {
          this.asked.push(`${robot} ${tick}`);
          return new Promise((resolve, reject) => this.waiting.push({ resolve, reject }));
        },
      },
      facts: () => null, redraw: () => {}, robotSeries: { know: () => {} },
    };
    Object.defineProperty(stage, 'recordedFrame', { get: () => frameOf({ x_m: [0, 1] }, this.tick) });
    this.stage = stage as unknown as Stage;
  }

  async answer(fields: MessageFields | null | Error): Promise<void> {
    const { resolve, reject } = this.waiting.shift()!;
    if (fields instanceof Error) reject(fields);
    else resolve(fields);
    await new Promise((next) => setImmediate(next));
  }
}

function watch() {
  const shown: (Inspected | null)[] = [];
  const robotWatch = new RobotWatch({ update: (what: Inspected | null) => { shown.push(what); } } as unknown as Inspector);
  return (run: Run): Inspected | null => {
    robotWatch.show(run.stage, 1, null, false);
    return shown.at(-1)!;
  };
}

describe('the robot that is looked at', () => {
  it('says what the source answered', async () => {
    const show = watch();
    const run = new Run();
    expect(show(run)).toMatchObject({ robot: 1, said: null });
    await run.answer({ id: 1 });
    expect(show(run)?.said).toMatchObject({ tick: 4, fields: { id: 1 }, problem: '' });
    expect(run.asked).toEqual(['1 4']);
  });

  it('says nothing of another run, and is asked anew there', async () => {
    const show = watch();
    const [one, other] = [new Run(), new Run()];
    show(one);
    await one.answer({ id: 1 });
    expect(show(other)?.said).toBeNull();
    expect(other.asked).toEqual(['1 4']);
  });

  it('is not given an answer of the run before, however late it comes', async () => {
    const show = watch();
    const [one, other] = [new Run(), new Run()];
    show(one);
    show(other);
    await one.answer(null);
    expect(show(other)?.said).toBeNull();
    expect(other.asked).toEqual(['1 4']); // still under way: not asked twice
    await other.answer({ id: 1 });
    expect(show(other)?.said?.fields).toEqual({ id: 1 });
  });

  it('tells why there is no answer', async () => {
    const show = watch();
    const run = new Run();
    show(run);
    await run.answer(new Problem('the file is gone'));
    expect(show(run)?.said).toMatchObject({ fields: null, problem: 'the file is gone' });
  });
});
