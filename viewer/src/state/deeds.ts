// SPDX-License-Identifier: MIT
// What was done to a run's radio, by a visitor or by its scenario: a run's configuration lists it, its frames and events
// do not. An event that waits for a condition is not among them: when it happens is not written there.
import type { RunEvent } from '../frame';

const slack = 1e-6; // s

interface ConfiguredEvent {
  kind?: string;
  when?: string;
  time_s?: number;
  loss?: number;
  duration_s?: number;
}

interface Config {
  tick_s?: number;
  radio?: { loss?: number };
  events?: ConfiguredEvent[];
}

/** Packet loss and blackouts over time. */
export class Deeds {
  /** As in /banyan/events, in order of time. */
  readonly events: RunEvent[];
  private readonly losses: { timeS: number; loss: number }[] = [];
  private readonly blackouts: { fromS: number; toS: number }[] = [];
  private readonly first: number;

  constructor(config: string) {
    const { tick_s: tickS = 0.1, radio, events } = parsed(config);
    this.first = radio?.loss ?? 0;
    const timed = (Array.isArray(events) ? events : []).filter((event) => event.time_s !== undefined && (event.when ?? 'time') === 'time')
      .map((event) => ({ ...event, timeS: event.time_s! }))
      .sort((a, b) => a.timeS - b.timeS); // stable: of two at one time the later one holds
    this.events = timed.flatMap(({ timeS, ...event }) => {
      const text = this.take(event, timeS);
      return text === null ? [] : [{ tick: Math.round(timeS / tickS), time_s: timeS, kind: event.kind!, robot: -1, target: -1, text }];
    });
  }

  lossAt(timeS: number): number {
    return this.losses.filter((change) => change.timeS <= timeS + slack).at(-1)?.loss ?? this.first;
  }

  isBlackoutAt(timeS: number): boolean {
    return this.blackouts.some(({ fromS, toS }) => fromS <= timeS + slack && timeS < toS - slack);
  }

  /** Its words; null if it is not about the radio. */
  private take({ kind, loss, duration_s: durationS }: ConfiguredEvent, timeS: number): string | null {
    if (kind === 'set_loss' && typeof loss === 'number') {
      this.losses.push({ timeS, loss });
      return `packet loss is ${Math.round(1000 * loss) / 10} % from now on`;
    }
    if (kind === 'blackout' && typeof durationS === 'number') {
      this.blackouts.push({ fromS: timeS, toS: timeS + durationS });
      return `blackout: nobody hears anything for ${durationS} s`;
    }
    return null;
  }
}

function parsed(config: string): Config {
  try {
    return (JSON.parse(config) as Config | null) ?? {};
  } catch {
    return {}; // damaged or unknown
  }
}
