// SPDX-License-Identifier: MIT
// Keeps the inspector on the robot that is selected: what the frame says at once, what it broadcast when
// the source has answered. At most one question is under way.
import type { Inspector } from './panels/inspector';
import type { MessageFields } from './source/protocol';
import type { Stage } from './stage';

export class RobotWatch {
  private asked = '';
  private busy = false;
  private answer: { robot: number; tick: number; fields: MessageFields | null } | null = null;

  constructor(private readonly inspector: Inspector) {}

  show(stage: Stage | null, robot: number | null, followed: number | null, live: boolean): void {
    const frame = stage?.recordedFrame ?? null;
    if (stage === null || frame === null || robot === null || robot >= frame.robots) return this.inspector.update(null);
    this.ask(stage, robot, frame.tick);
    const answer = this.answer?.robot === robot ? this.answer : null;
    this.inspector.update({
      frame, robot, live, followed: followed === robot,
      neighbours: stage.facts()?.radio.neighbours(robot) ?? [],
      message: answer?.fields, messageTick: answer?.tick ?? 0,
    });
  }

  private ask(stage: Stage, robot: number, tick: number): void {
    const question = `${robot} ${tick}`;
    if (this.busy || question === this.asked) return;
    this.asked = question;
    this.busy = true;
    stage.source.message(robot, tick)
      .then((fields) => { this.answer = { robot, tick, fields }; })
      .catch(() => { this.answer = { robot, tick, fields: null }; })
      .finally(() => { this.busy = false; stage.redraw(); });
  }
}
