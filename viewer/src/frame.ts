// SPDX-License-Identifier: MIT
// One instant of a run, as recorded (docs/file-formats.md) and as the live simulation hands it out:
// a matrix with a column per quantity and a row per robot, in the order of the robots' indices.
import type { Cells } from './cells';

/** The arrays of a /banyan/frame message, in this order (record/src/frame_json.cpp). */
export const columns = [
  'x_m', 'y_m', 'heading_rad', 'role', 'phase', 'need', 'spare_state', 'alive', 'connected', 'epoch',
  'label_m', 'depth', 'parent', 'old_parent', 'grant', 'request', 'want_m', 'target', 'raised', 'spent',
] as const;
export type Column = (typeof columns)[number];

export interface Targets {
  x: Float64Array; // m
  y: Float64Array;
  worker: Int32Array; // index of the robot first sent there, -1: nobody, `givenUp`
}

/** In Targets.worker: the target is given up. Stored in that array, so that copies of targets keep it. */
export const givenUp = -2;

export interface Frame {
  tick: number;
  timeS: number;
  robots: number;
  /** Column by column: robot i's `columns[c]` is data[c * robots + i]. "None" and "unknown" are -1. */
  data: Float64Array;
  targets: Targets;
}

/** The values of one column, a view into the frame. */
export function column(frame: Frame, name: Column): Float64Array {
  const first = columns.indexOf(name) * frame.robots;
  return frame.data.subarray(first, first + frame.robots);
}

// The values of `role`, `phase`, `need` and `spare_state`, by number.
export const roles = ['spare', 'connector', 'worker', 'root'] as const;
export const phases = ['init', 'start_tree', 'select_parent', 'grow_tree', 'select_root'] as const;
export const needs = ['no_need', 'need', 'await'] as const;
export const spareStates = ['wait', 'extend_edge', 'adjust_position'] as const;

export type Point = [number, number]; // m
export type Obstacle =
  | { disc: true; center_m: Point; radius_m: number }
  | { box: true; center_m: Point; size_m: Point; angle_rad: number }
  | { wall: true; from_m: Point; to_m: Point }
  | { map: true; origin_m: Point; resolution_m: number; angle_rad: number; cells: Cells };

/** What a picture needs beside a frame: the JSON of `banyan.setting`. Changes when an obstacle is moved
 *  or line of sight is switched. */
export interface Setting {
  name: string;
  algorithm: string;
  reading: string;
  seed: number;
  tick_s: number;
  radius_m: number;
  range_m: number;
  line_of_sight: boolean;
  /** Share of the lines of sight past one body over which packets get through. Missing: 0. */
  sight_leak?: number;
  /** The dead hide what is behind them; false: they vanish. Missing: true. */
  dead_bodies?: boolean;
  target_tolerance_m: number;
  time_limit_s: number;
  obstacles: Obstacle[];
}

/** As in /banyan/events. `robot` and `target`: -1 for none. */
export interface RunEvent {
  tick: number;
  time_s: number;
  kind: string;
  robot: number;
  target: number;
  text: string;
}

/** The columns of the series table (docs/file-formats.md), a number per tick; NaN where it is empty,
 *  0 and 1 for truth values. All arrays have the same length. */
export type Series = Record<string, Float64Array>;
