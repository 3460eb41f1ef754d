// SPDX-License-Identifier: MIT
// Everything a picture depends on. The scene has no state that is seen: the same view, the same picture.
import type { Frame, Setting } from '../frame';
import type { Bounds, Camera, Insets, Spot } from './camera';
import type { Theme } from './themes';

/** Something that can be pointed at: an index into the frame's robots or targets, or the setting's obstacles. */
export interface Item { kind: 'robot' | 'target' | 'obstacle'; index: number }

export interface Switches {
  links: boolean;
  blocked: boolean;
  oldTree: boolean;
  trails: boolean;
  /** Distance to the root along hops and depth, as the robot believes. */
  labels: boolean;
  ids: boolean;
}

export interface SceneView {
  /** With positions between two ticks, if the page interpolates. */
  frame: Frame;
  /** The recorded frame that `frame` starts from: links and whether edges are whole are those of this instant, and
   *  are computed once for this object. Without it, once for each `frame.tick`. */
  recorded?: Frame;
  setting: Setting;
  /** Earlier frames, oldest first, for trails that end at `frame`; half a second apart is plenty. */
  trails: readonly Frame[];
  selection: Item | null;
  hovered: Item | null;
  switches: Switches;
  camera: Camera;
  theme: Theme;
  /** Covered by panels: the scale bar keeps out of it. */
  insets?: Insets;
  /** Something that is being dragged and where it would be put, m. */
  dragged?: { item: Item; toM: Spot } | null;
  /** A rectangle that is being drawn, m; the living robots in it are marked. */
  area?: Bounds | null;
  /** An obstacle that is being drawn, m. */
  disc?: { at: Spot; radiusM: number } | null;
  /** So small that there is no room for numbers and scale. */
  bare?: boolean;
  /** A place that is being chosen by keys, m. */
  cursor?: Spot | null;
}

export const defaultSwitches: Switches = {
  links: true, blocked: false, oldTree: true, trails: true, labels: false, ids: false,
};

export const sameItem = (a: Item | null, b: Item | null): boolean =>
  a === b || (a !== null && b !== null && a.kind === b.kind && a.index === b.index);
