// SPDX-License-Identifier: MIT
// Pointers and what they are taken for, on an element that is none.
import { beforeEach, describe, expect, it } from 'vitest';
import { Input, type Intentions } from '../src/scene/input';
import type { Item } from '../src/scene/view';

class Pad extends EventTarget {
  style = { touchAction: '' };
  clientHeight = 600;
  getBoundingClientRect() { return { left: 10, top: 20 }; }
  setPointerCapture() {}
  fire(type: string, x: number, y: number, more: object = {}) {
    const event = new Event(type, { cancelable: true });
    // In the browser timeStamp is read-only too.
    const { timeStamp, ...rest } = more as { timeStamp?: number };
    Object.assign(event, { clientX: x + 10, clientY: y + 20, pointerId: 1, pointerType: 'mouse', button: 0, shiftKey: false, deltaMode: 0, ...rest });
    Object.defineProperty(event, 'timeStamp', { value: timeStamp ?? 0 });
    this.dispatchEvent(event);
    return event;
  }
}

const robot: Item = { kind: 'robot', index: 1 };
const target: Item = { kind: 'target', index: 0 };
let pad: Pad;
let input: Input;
let said: string[];

/** x < 100: a robot, x < 200: a target, else ground. */
beforeEach(() => {
  pad = new Pad();
  said = [];
  const name = (item: Item | null) => item?.kind ?? 'ground';
  const at = (p: { x: number; y: number }) => `${Math.round(p.x)},${Math.round(p.y)}`;
  const say: Intentions = {
    itemAt: ({ x }) => (x < 100 ? robot : x < 200 ? target : null),
    // A target lies under the robots' right edge, too.
    gripAt: ({ x }) => (x >= 90 && x < 200 ? target : null),
    pan: (dx, dy) => said.push(`pan ${dx},${dy}`),
    zoom: (factor, p) => said.push(`zoom ${factor.toFixed(3)} ${at(p)}`),
    hover: (item, p) => said.push(`hover ${name(item)} ${p ? at(p) : 'away'}`),
    pick: (item) => said.push(`pick ${name(item)}`),
    dragStart: (item, p) => said.push(`start ${name(item)} ${at(p)}`),
    dragMove: (_, p) => said.push(`move ${at(p)}`),
    dragEnd: (_, p, dropped) => said.push(`${dropped ? 'drop' : 'call off'} ${at(p)}`),
    areaMove: (a, b) => said.push(`area ${at(a)} ${at(b)}`),
    areaEnd: (a, b, taken) => said.push(`${taken ? 'take' : 'leave'} ${at(a)} ${at(b)}`),
    add: (p) => said.push(`add ${at(p)}`),
  };
  input = new Input(pad as unknown as HTMLElement, say);
});

const down = (x: number, y: number, more = {}) => pad.fire('pointerdown', x, y, more);
const move = (x: number, y: number, more = {}) => pad.fire('pointermove', x, y, more);
const up = (x: number, y: number, more = {}) => pad.fire('pointerup', x, y, more);

describe('input', () => {
  it('hovers, and picks with a click that trembles', () => {
    move(50, 5);
    down(50, 5); move(52, 6); up(52, 6);
    expect(said).toEqual(['hover robot 50,5', 'pick robot']);
  });
  it('pans on the ground, and on what cannot be dragged', () => {
    down(300, 50); move(310, 50); move(311, 52); up(311, 52);
    down(50, 50); move(50, 60); up(50, 60);
    expect(said).toEqual(['pan 10,0', 'pan 1,2', 'pan 0,10']);
  });
  it('drags a target that lies under a robot, which a click picks', () => {
    down(95, 50); up(95, 50);
    down(95, 50); move(120, 50); up(130, 50);
    expect(said).toEqual(['pick robot', 'start target 95,50', 'move 120,50', 'drop 130,50']);
  });
  it('drags a target, and calls it off', () => {
    down(150, 50); move(160, 50); move(300, 50); up(300, 51);
    expect(said).toEqual(['start target 150,50', 'move 160,50', 'move 300,50', 'drop 300,51']);
    said.length = 0;
    down(150, 50); move(160, 50);
    expect(input.cancel()).toBe(true);
    move(170, 50); up(170, 50);
    expect(said.slice(2)).toEqual(['call off 160,50']);
    expect(input.cancel()).toBe(false);
  });
  it('draws a rectangle with shift, and in its mode without', () => {
    down(150, 50, { shiftKey: true }); move(250, 90); up(251, 91);
    input.mode = 'area';
    down(300, 50); move(320, 70); pad.fire('pointercancel', 0, 0);
    expect(said).toEqual(['area 150,50 250,90', 'take 150,50 251,91', 'area 300,50 320,70', 'leave 300,50 320,70']);
  });
  it('adds a target by double click on the ground, or by a click in its mode', () => {
    down(300, 50, { timeStamp: 1000 }); up(300, 50, { timeStamp: 1050 });
    down(301, 50, { timeStamp: 1200 }); up(301, 50, { timeStamp: 1250 });
    down(301, 50, { timeStamp: 1300 }); up(301, 50, { timeStamp: 1350 });
    input.mode = 'add';
    down(50, 7); up(50, 7);
    expect(said).toEqual(['pick ground', 'add 301,50', 'pick ground', 'add 50,7']);
  });
  it('zooms with the wheel, finer with a touchpad, and keeps the page where it is', () => {
    const event = pad.fire('wheel', 40, 50, { deltaY: -100 });
    expect(event.defaultPrevented).toBe(true);
    pad.fire('wheel', 40, 50, { deltaY: 3, deltaMode: 1 });
    pad.fire('wheel', 40, 50, { deltaY: 5, ctrlKey: true });
    expect(said).toEqual(['zoom 1.174 40,50', 'zoom 0.926 40,50', 'zoom 0.951 40,50']);
  });
  it('pinches with two fingers, and picks nothing when they leave', () => {
    const finger = (pointerId: number) => ({ pointerId, pointerType: 'touch' });
    down(300, 100, finger(1)); down(400, 100, finger(2));
    move(500, 100, finger(2));
    up(500, 100, finger(2)); move(310, 140, finger(1)); up(310, 140, finger(1));
    expect(said).toEqual(['pan 50,0', 'zoom 2.000 400,100']);
    down(50, 5, finger(3)); up(50, 5, finger(3));
    expect(said.at(-1)).toBe('pick robot');
  });
  it('calls a drag off when a second finger comes', () => {
    const finger = (pointerId: number) => ({ pointerId, pointerType: 'touch' });
    down(150, 50, finger(1)); move(165, 50, finger(1)); down(300, 50, finger(2));
    expect(said.at(-1)).toMatch(/^call off/);
  });
  it('pans with the middle button, leaves the right one alone, and ends with dispose', () => {
    down(150, 50, { button: 1 }); move(160, 50); up(160, 50);
    down(150, 50, { button: 2 }); up(150, 50);
    input.dispose();
    down(50, 50); up(50, 50);
    expect(said).toEqual(['pan 10,0']);
  });
});
