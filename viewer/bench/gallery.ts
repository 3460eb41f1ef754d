// SPDX-License-Identifier: MIT
// Runs in the browser for gallery.mjs: one picture of the scene, as the page would show it.
import type { Frame, Setting } from '../src/frame';
import { fitted } from '../src/scene/camera';
import { Scene } from '../src/scene/picture';
import { themes } from '../src/scene/themes';
import { boundsOf } from '../src/scene/bounds';
import { defaultSwitches, type SceneView } from '../src/scene/view';

interface PlainFrame { tick: number; timeS: number; robots: number; data: number[]; targets: { x: number[]; y: number[]; worker: number[] } }
const frameOf = (f: PlainFrame): Frame => ({
  ...f, data: Float64Array.from(f.data),
  targets: { x: Float64Array.from(f.targets.x), y: Float64Array.from(f.targets.y), worker: Int32Array.from(f.targets.worker) },
});

export interface Wish { setting: Setting; frame: PlainFrame; trails: PlainFrame[]; theme: 'light' | 'dark'; view: Partial<SceneView>; zoom?: number; at?: { x: number; y: number } }

function show(wish: Wish): string {
  document.body.innerHTML = '<div style="position:fixed;inset:0"></div>';
  const scene = new Scene(document.querySelector('div')!, themes[wish.theme]);
  const frame = frameOf(wish.frame);
  let camera = fitted(boundsOf(wish.setting, frame), scene.widthPx, scene.heightPx, 40);
  if (wish.zoom) camera = { ...camera, scale: camera.scale * wish.zoom, xM: wish.at?.x ?? camera.xM, yM: wish.at?.y ?? camera.yM };
  const view: SceneView = {
    frame, recorded: frame, setting: wish.setting, trails: wish.trails.map(frameOf), selection: null, hovered: null,
    switches: defaultSwitches, camera, theme: themes[wish.theme], ...wish.view,
  };
  scene.draw(view);
  return `${scene.radioLinks.drawn} of ${scene.radioLinks.all} links`;
}
Object.assign(window, { show });
