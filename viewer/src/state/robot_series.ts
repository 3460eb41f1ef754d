// SPDX-License-Identifier: MIT
// What a robot's reports say over time, for plots: gathered from the frames of its run, as far as it has been seen, and
// kept until another robot is asked for or the run is changed.
import { column, columns, needs, phases, roles, type Frame, type Series } from '../frame';
import type { MessageFields, SaidAt } from '../source/protocol';

/** What it needs of a source (source/client.ts). */
export interface FramesOf {
  readonly tickS: number;
  frames(fromS: number, toS: number): Promise<Frame[]>;
  messages(robot: number, fromS: number, toS: number): Promise<SaidAt[]>;
}

/** What a field of a message is called among the columns. */
export const saidName = (field: string): string => `says ${field}`;

/** As a plot shows it: enumerators, which live runs have by name, by number. */
function numberOf(field: string, value: number | string | boolean): number {
  if (typeof value !== 'string') return Number(value);
  const names: Record<string, readonly string[]> = { role: roles, phase: phases, need: needs };
  const index = names[field]?.indexOf(value) ?? -1;
  return index < 0 ? NaN : index;
}

/** Numbers of a report that a plot can show, with their units; -1 is "none" in all but the first three. */
export const robotColumns: readonly { name: (typeof columns)[number]; unit: string; help: string }[] = [
  { name: 'x_m', unit: 'm', help: 'True position; the robot does not know it' },
  { name: 'y_m', unit: 'm', help: 'True position; the robot does not know it' },
  { name: 'heading_rad', unit: 'rad', help: 'True heading' },
  { name: 'role', unit: '', help: '0 spare, 1 connector, 2 worker, 3 root' },
  { name: 'phase', unit: '', help: 'Of the reconstruction of the tree, 0 to 4' },
  { name: 'need', unit: '', help: '0 no need, 1 need, 2 await' },
  { name: 'spare_state', unit: '', help: '0 wait, 1 extend edge, 2 adjust position' },
  { name: 'alive', unit: '', help: '1 until it dies' },
  { name: 'connected', unit: '', help: '1 while it is in one radio component with the root' },
  { name: 'epoch', unit: '', help: 'Counts the trees' },
  { name: 'label_m', unit: 'm', help: 'Distance to the root along hops when the epoch began' },
  { name: 'depth', unit: '', help: 'In the tree; the root has 1' },
  { name: 'parent', unit: '', help: 'Number of its parent' },
  { name: 'old_parent', unit: '', help: 'Number of its parent in the tree before' },
  { name: 'grant', unit: '', help: 'Number of the spare that it lets in' },
  { name: 'request', unit: '', help: 'Number of the robot whose edge it wants to join' },
  { name: 'want_m', unit: 'm', help: 'Length of the edge that a spare is wanted for' },
  { name: 'target', unit: '', help: 'Number of the target that it serves' },
];
const isTrueValue: ReadonlySet<string> = new Set(['x_m', 'y_m', 'heading_rad']);

const chunkS = 30; // asked for at a time, so that the picture gets its turn

export class RobotSeries {
  private robot: number | null = null;
  private times: number[] = [];
  private values: number[][] = robotColumns.map(() => []);
  private said = new Map<string, number[]>(); // by field; as long as `times`
  private withSaid = false; // messages are gathered, too
  private busy = false;
  private generation = 0;
  private made: Series | null = null;
  /** Of its messages, as far as they are numbers: what there is to choose from. */
  fields: readonly string[] = [];

  constructor(private readonly source: FramesOf) {}

  /** Of the robot asked for last, so far. */
  get value(): Series {
    return (this.made ??= {
      time_s: Float64Array.from(this.times),
      ...Object.fromEntries(robotColumns.map(({ name }, k) => [name, Float64Array.from(this.values[k])])),
      ...Object.fromEntries([...this.said].map(([field, values]) => [saidName(field), Float64Array.from(values)])),
    });
  }

  /** A message of one of its robots: all have the same fields. */
  know(message: MessageFields): void {
    this.fields = Object.entries(message).filter(([field, value]) => !Number.isNaN(numberOf(field, value))).map(([field]) => field);
  }

  /** What comes after this moment may be different now. */
  cut(timeS: number): void {
    const kept = this.times.findIndex((t) => t > timeS + this.source.tickS / 2);
    if (kept >= 0) for (const list of [this.times, ...this.values, ...this.said.values()]) list.length = kept;
    this.made = null;
    ++this.generation;
    this.busy = false;
  }

  /** Sees to it that this robot's values up to `toS` come, what it said among them if that is wanted; resolves when some
   *  have: then there may be more to ask for. False: there is nothing new. */
  async gather(robot: number, toS: number, said = false): Promise<boolean> {
    if (robot !== this.robot || (said && !this.withSaid)) this.begin(robot, said);
    const fromS = (this.times.at(-1) ?? -this.source.tickS) + this.source.tickS;
    if (this.busy || fromS > toS + this.source.tickS / 2) return false;
    const { generation } = this;
    this.busy = true;
    try {
      const [from, to] = [Math.max(0, fromS), Math.min(toS, fromS + chunkS)];
      const frames = await this.source.frames(from, to);
      const messages = this.withSaid ? await this.source.messages(robot, from, to) : [];
      return generation === this.generation && this.take(robot, frames, messages, fromS, toS);
    } finally {
      if (generation === this.generation) this.busy = false;
    }
  }

  private begin(robot: number, said: boolean): void {
    this.robot = robot;
    this.withSaid = said;
    this.said = new Map();
    this.cut(-Infinity);
  }

  private take(robot: number, frames: readonly Frame[], messages: readonly SaidAt[], fromS: number, toS: number): boolean {
    const slack = this.source.tickS / 2;
    const tickOf = (timeS: number) => Math.round(timeS / this.source.tickS);
    const byTick = new Map(messages.map(({ timeS, fields }) => [tickOf(timeS), fields]));
    let any = false;
    for (const frame of frames) {
      if (robot >= frame.robots || frame.timeS < fromS - slack || frame.timeS > toS + slack) continue;
      any = true;
      this.takeSaid(byTick.get(tickOf(frame.timeS)) ?? {});
      this.times.push(frame.timeS);
      robotColumns.forEach(({ name }, k) => {
        const value = column(frame, name)[robot];
        this.values[k].push(value === -1 && !isTrueValue.has(name) ? NaN : value);
      });
    }
    if (any) this.made = null;
    return any;
  }

  /** A row, before its time is added. */
  private takeSaid(fields: MessageFields): void {
    for (const field of Object.keys(fields)) if (!this.said.has(field)) this.said.set(field, this.times.map(() => NaN));
    for (const [field, values] of this.said) values.push(Object.hasOwn(fields, field) ? numberOf(field, fields[field]) : NaN);
  }
}
