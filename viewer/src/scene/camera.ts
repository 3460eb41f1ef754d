// SPDX-License-Identifier: MIT
// Where the picture looks: the world point in its middle and the pixels per metre. World y points up, pixel y
// down; pixels are CSS pixels from the picture's upper left corner. Every change makes a new camera.

export interface Camera {
  /** The world point in the middle, m. */
  readonly xM: number;
  readonly yM: number;
  /** Pixels per metre. */
  readonly scale: number;
  readonly widthPx: number;
  readonly heightPx: number;
}

export interface Spot { x: number; y: number }
export interface Bounds { minX: number; minY: number; maxX: number; maxY: number }
/** Space along the sides that is covered by panels, px. */
export interface Insets { top: number; right: number; bottom: number; left: number }

export const noInsets: Insets = { top: 0, right: 0, bottom: 0, left: 0 };
export const smallestScale = 0.0005; // px/m: a world of 2,000 km in a window
export const largestScale = 40000;

const clampScale = (scale: number) => Math.min(largestScale, Math.max(smallestScale, scale));

export const toPxX = (camera: Camera, xM: number) => camera.widthPx / 2 + (xM - camera.xM) * camera.scale;
export const toPxY = (camera: Camera, yM: number) => camera.heightPx / 2 - (yM - camera.yM) * camera.scale;

export function toPx(camera: Camera, atM: Spot): Spot {
  return { x: toPxX(camera, atM.x), y: toPxY(camera, atM.y) };
}

export function toWorld(camera: Camera, atPx: Spot): Spot {
  return {
    x: camera.xM + (atPx.x - camera.widthPx / 2) / camera.scale,
    y: camera.yM - (atPx.y - camera.heightPx / 2) / camera.scale,
  };
}

/** What was under the pointer stays under it when it moves by (dx, dy) pixels. */
export function panned(camera: Camera, dxPx: number, dyPx: number): Camera {
  return { ...camera, xM: camera.xM - dxPx / camera.scale, yM: camera.yM + dyPx / camera.scale };
}

/** `factor` > 1 is nearer; the world point under `atPx` stays there. */
export function zoomedAt(camera: Camera, factor: number, atPx: Spot): Camera {
  const scale = clampScale(camera.scale * factor);
  const fixed = toWorld(camera, atPx);
  return {
    ...camera,
    scale,
    xM: fixed.x - (atPx.x - camera.widthPx / 2) / scale,
    yM: fixed.y + (atPx.y - camera.heightPx / 2) / scale,
  };
}

/** In a picture of another size, the same point in the middle. */
export function resized(camera: Camera, widthPx: number, heightPx: number): Camera {
  return { ...camera, widthPx, heightPx };
}

/** All of `bounds` is seen, with `marginPx` around, in the part that no panel covers. */
export function fitted(
  bounds: Bounds, widthPx: number, heightPx: number, marginPx = 32, insets: Insets = noInsets,
): Camera {
  const width = bounds.maxX - bounds.minX;
  const height = bounds.maxY - bounds.minY;
  const freeX = Math.max(1, widthPx - insets.left - insets.right - 2 * marginPx);
  const freeY = Math.max(1, heightPx - insets.top - insets.bottom - 2 * marginPx);
  const scale = clampScale(Math.min(freeX / width, freeY / height));
  const camera = {
    xM: (bounds.minX + bounds.maxX) / 2, yM: (bounds.minY + bounds.maxY) / 2, scale, widthPx, heightPx,
  };
  return panned(camera, (insets.left - insets.right) / 2, (insets.top - insets.bottom) / 2);
}

/** `share` of the way towards having `atM` in the middle; 1 is there at once. With a share below 1 at every
 *  animation frame a followed robot is caught up with smoothly. */
export function following(camera: Camera, atM: Spot, share = 1): Camera {
  return { ...camera, xM: camera.xM + share * (atM.x - camera.xM), yM: camera.yM + share * (atM.y - camera.yM) };
}

/** The share for `following` so that the way left halves every `halfLifeS`, however long a frame takes. */
export function followShare(elapsedS: number, halfLifeS = 0.12): number {
  return 1 - Math.pow(0.5, elapsedS / halfLifeS);
}

/** What is seen, m. */
export function seen(camera: Camera): Bounds {
  const halfX = camera.widthPx / 2 / camera.scale;
  const halfY = camera.heightPx / 2 / camera.scale;
  return { minX: camera.xM - halfX, minY: camera.yM - halfY, maxX: camera.xM + halfX, maxY: camera.yM + halfY };
}

/** The largest of 1, 2, 5 times a power of ten that is not above `most`: for grids and scale bars. */
export function niceLength(most: number): number {
  const unit = Math.pow(10, Math.floor(Math.log10(most) + 1e-9));
  return most >= 5 * unit ? 5 * unit : most >= 2 * unit ? 2 * unit : unit;
}
