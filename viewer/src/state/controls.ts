// SPDX-License-Identifier: MIT
// What the live controls show: what holds at the moment shown; and just after the visitor asked for something
// else, that, until a moment is shown at which it holds.
import type { Intervention } from '../source/protocol';

export interface Settings {
  loss: number; // share of packets
  lineOfSight: boolean;
}

interface Asked {
  fromS: number;
  holdsS: number; // after that, frames decide
  values: Partial<Settings>;
}

const slack = 1e-6; // s

export class Controls {
  private asked: Asked | null = null;

  /** These act in the step after `tick`. */
  ask(events: readonly Intervention[], tick: number, tickS: number): void {
    const fromS = tick * tickS;
    const before = this.asked !== null && this.asked.fromS <= fromS + slack ? this.asked.values : {};
    const values = { ...before };
    for (const event of events) {
      if (event.kind === 'set_loss') values.loss = event.loss;
      if (event.kind === 'set_line_of_sight') values.lineOfSight = event.line_of_sight;
    }
    this.asked = { fromS, holdsS: fromS + tickS, values };
  }

  /** It could not be, or another run is shown. */
  forget(): void { this.asked = null; }

  /** `there`: the frames of this time are, and so is what is known of it. */
  at(timeS: number, there: boolean, known: Settings): Settings {
    if (this.asked === null) return known;
    const { fromS, holdsS, values } = this.asked;
    const told = timeS >= holdsS - slack && there;
    if (told || timeS < fromS - slack) this.asked = null;
    return this.asked === null ? known : { ...known, ...values };
  }
}
