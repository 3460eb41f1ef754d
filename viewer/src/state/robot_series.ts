// SPDX-License-Identifier: MIT
// What a robot's reports say over time, for plots: gathered from the frames of its run, as far as it has been seen, and
// kept until another robot is asked for or the run is changed.
import { column, columns, type Frame, type Series } from '../frame';

/** What it needs of a source (source/client.ts). */
export interface FramesOf {
  readonly tickS: number;
  frames(fromS: number, toS: number): Promise<Frame[]>;
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
  { name: 'label_cm', unit: 'cm', help: 'Distance to the root along hops when the epoch began' },
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
  private busy = false;
  private generation = 0;
  private made: Series | null = null;

  constructor(private readonly source: FramesOf) {}

  /** Of the robot asked for last, so far. */
  get value(): Series {
    return (this.made ??= {
      time_s: Float64Array.from(this.times),
      ...Object.fromEntries(robotColumns.map(({ name }, k) => [name, Float64Array.from(this.values[k])])),
    });
  }

  /** What comes after this moment may be different now. */
  cut(timeS: number): void {
    const kept = this.times.findIndex((t) => t > timeS + this.source.tickS / 2);
    if (kept >= 0) for (const list of [this.times, ...this.values]) list.length = kept;
    this.made = null;
    ++this.generation;
    this.busy = false;
  }

  /** Sees to it that this robot's values up to `toS` come; resolves when some have: then there may be more to ask for.
   *  False: there is nothing new. */
  async gather(robot: number, toS: number): Promise<boolean> {
    if (robot !== this.robot) this.begin(robot);
    const fromS = (this.times.at(-1) ?? -this.source.tickS) + this.source.tickS;
    if (this.busy || fromS > toS + this.source.tickS / 2) return false;
    const { generation } = this;
    this.busy = true;
    try {
      const frames = await this.source.frames(Math.max(0, fromS), Math.min(toS, fromS + chunkS));
      return generation === this.generation && this.take(robot, frames, fromS, toS);
    } finally {
      if (generation === this.generation) this.busy = false;
    }
  }

  private begin(robot: number): void {
    this.robot = robot;
    this.cut(-Infinity);
  }

  private take(robot: number, frames: readonly Frame[], fromS: number, toS: number): boolean {
    const slack = this.source.tickS / 2;
    let any = false;
    for (const frame of frames) {
      if (robot >= frame.robots || frame.timeS < fromS - slack || frame.timeS > toS + slack) continue;
      any = true;
      this.times.push(frame.timeS);
      robotColumns.forEach(({ name }, k) => {
        const value = column(frame, name)[robot];
        this.values[k].push(value === -1 && !isTrueValue.has(name) ? NaN : value);
      });
    }
    if (any) this.made = null;
    return any;
  }
}
