// SPDX-License-Identifier: MIT
// Keeps the inspector on the robot that is selected: what the frame says at once, what it broadcast when
// the source has answered. At most one question is under way.
import type { Inspector, Said } from './panels/inspector';
import type { Source } from './source/client';
import { wordsOf } from './source/problem';
import type { Stage } from './stage';

export class RobotWatch {
  private source: Source | null = null; // the robot that everything below is about
  private asked = '';
  private busy = false;
  private answer: (Said & { robot: number }) | null = null;

  constructor(private readonly inspector: Inspector) {}

  show(stage: Stage | null, robot: number | null, followed: number | null, live: boolean): void {
    this.attend(stage?.source ?? null);
    const frame = stage?.recordedFrame ?? null;
    if (stage === null || frame === null || robot === null || robot >= frame.robots) return this.inspector.update(null);
    this.ask(stage, robot, frame.tick);
    this.inspector.update({
      frame, robot, live, followed: followed === robot,
      neighbours: stage.facts()?.radio.neighbours(robot) ?? [],
      said: this.answer?.robot === robot ? this.answer : null,
    });
  }

  /** Another run is shown: what was asked and answered was about the last one. */
  private attend(source: Source | null): void {
    if (source === this.source) return;
    this.source = source;
    this.asked = '';
    this.busy = false;
    this.answer = null;
  }

  private ask(stage: Stage, robot: number, tick: number): void {
    const question = `${robot} ${tick}`;
    if (this.busy || question === this.asked) return;
    this.asked = question;
    this.busy = true;
    const take = (said: Said) => {
      if (stage.source !== this.source) return; // too late
      this.busy = false;
      this.answer = { robot, ...said };
      if (said.fields !== null) stage.robotSeries.know(said.fields);
      stage.redraw();
    };
    stage.source.message(robot, tick).then(
      (fields) => take({ tick, fields, problem: '' }),
      (problem: unknown) => take({ tick, fields: null, problem: wordsOf(problem) }),
    );
  }
}
