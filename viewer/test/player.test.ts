// SPDX-License-Identifier: MIT
// The clock, with a fake one behind it and sources that are slow, end or go on.
import { describe, expect, it } from 'vitest';
import { fastest, type Playable, Player, slowest, tickAt } from '../src/state/player';
import { random } from './support';

class Fake implements Playable {
  ready = true;
  startS = 0;
  tickS = 0.1;
  /** Frames are here up to there. */
  loadedS = Infinity;
  asked: [number, number, number][] = [];
  constructor(public endS = 20, public growing = false, public following = false) {}
  limit(fromS: number, toS: number): number {
    if (!this.growing && fromS >= this.endS) return toS;
    return Math.max(Math.min(toS, this.loadedS), Math.min(fromS, toS));
  }
  prefetch(timeS: number, speed: number, stride: number): void {
    this.asked.push([timeS, speed, stride]);
    if (this.growing) this.endS = Math.max(this.endS, timeS + 1);
  }
}

function playing(...sources: Fake[]): { player: Player; run: (ms: number) => void } {
  const player = new Player();
  player.attach(sources);
  let now = 1000;
  player.frame(now);
  return { player, run: (ms) => { for (let t = 0; t < ms; t += 16) player.frame((now += Math.min(16, ms - t))); } };
}

describe('the tick of the clock', () => {
  it('is not that of the picture, and one that there is', () => {
    const source = { tickS: 0.1, endS: 12.8 };
    expect([0, 0.05, 3 * 0.1, 9.99, 10.04, 12.8, 50].map((timeS) => tickAt(timeS, source))).toEqual([0, 0, 3, 99, 100, 128, 128]);
    expect(tickAt(3, { tickS: 0.1, endS: 0 })).toBe(0);
  });
});

describe('the newest moment', () => {
  /** A recording that gets a piece of `pieceS` every `everyMs`. */
  function growing(pieceS: number, everyMs: number) {
    const source = new Fake(0, false, true);
    const { player, run } = playing(source);
    const play = (ms: number, see = () => {}) => {
      for (let t = 0; t < ms; t += everyMs) {
        source.endS += pieceS;
        for (let k = 0; k < everyMs; k += 16) { run(16); see(); }
      }
    };
    return { source, player, run, play };
  }

  it.each([[1, 1000], [5, 1000], [0.3, 400]])('that moves on by %s s every %s ms is followed without a stop', (pieceS, everyMs) => {
    const { source, player, play } = growing(pieceS, everyMs);
    player.follow();
    play(8 * everyMs);
    let last = player.timeS;
    play(20 * everyMs, () => {
      expect(player.timeS).toBeGreaterThan(last); // it never stands, nor goes back
      last = player.timeS;
      expect(source.endS - player.timeS).toBeLessThan(4 * pieceS);
    });
    expect(player.newest).toBe(true);
  });

  it('is let go of by going back, and found again at the end', () => {
    const { source, player, run, play } = growing(1, 1000);
    player.follow();
    play(10_000);
    player.seek(2);
    expect(player.newest).toBe(false);
    run(500);
    expect(player.timeS).toBeCloseTo(2.5, 1);
    player.end();
    expect(player.newest && player.playing).toBe(true);
    player.pause();
    expect(player.newest).toBe(false);
    player.seek(source.endS - 0.2);
    player.play();
    run(1000);
    expect(player.newest).toBe(true); // it has caught up
    source.following = false; // the run is over
    run(1000);
    expect(player.newest || player.playing).toBe(false);
    expect(player.timeS).toBe(source.endS);
  });

  it('is caught up with at once after a long absence', () => {
    const { source, player, run, play } = growing(1, 1000);
    player.follow();
    play(5000);
    source.endS += 300;
    run(100);
    expect(source.endS - player.timeS).toBeLessThan(200);
    play(3000);
    expect(source.endS - player.timeS).toBeLessThan(source.endS / 3);
  });
});

describe('the player', () => {
  it('goes on to where something is seen only if it stands still before', () => {
    const { player, run } = playing(new Fake(20, true));
    player.seek(0.5);
    player.goOnTo(0.6);
    expect(player.timeS).toBe(0.6);
    player.goOnTo(0.6);
    player.goOnTo(0.2);
    expect(player.timeS).toBe(0.6);
    player.play();
    player.goOnTo(0.9);
    expect(player.timeS).toBe(0.6);
    run(100);
    expect(player.playing).toBe(true);
  });

  it('plays a stretch again and again', () => {
    const { player, run } = playing(new Fake(20));
    player.seek(2);
    player.nextLoop();
    player.nextLoop(); // here is no stretch yet: let go
    expect(player.loop).toBeNull();
    player.nextLoop();
    player.seek(3);
    player.nextLoop();
    expect(player.loop).toEqual({ fromS: 2, toS: 3 });
    player.seek(2.5);
    player.play();
    run(1000);
    expect(player.timeS).toBeGreaterThan(2);
    expect(player.timeS).toBeLessThan(3);
    player.nextLoop();
    run(1000);
    expect(player.timeS).toBeGreaterThan(3);
  });

  it('plays at its speed and stops at the end', () => {
    const { player, run } = playing(new Fake(20));
    player.play();
    run(1000);
    expect(player.timeS).toBeCloseTo(1);
    player.setSpeed(16);
    run(500);
    expect(player.timeS).toBeCloseTo(9);
    run(5000);
    expect(player.timeS).toBe(20);
    expect(player.playing).toBe(false);
    player.play();
    expect(player.timeS).toBe(0);
  });

  it('waits for frames, and then does not leap', () => {
    const source = new Fake(20);
    const { player, run } = playing(source);
    source.loadedS = 2;
    player.play();
    run(5000);
    expect(player.timeS).toBeCloseTo(2);
    expect(player.waiting).toBe(true);
    expect(player.playing).toBe(true);
    source.loadedS = Infinity;
    run(100);
    expect(player.waiting).toBe(false);
    expect(player.timeS).toBeCloseTo(2.1);
  });

  it('slows down where a live run does not keep up, instead of stopping again and again', () => {
    const source = new Fake(0, true);
    source.prefetch = () => {};
    source.limit = (fromS, toS) => Math.max(fromS, Math.min(toS, source.endS));
    const { player, run } = playing(source);
    player.play();
    const steps: number[] = [];
    for (let k = 0; k < 300; ++k) { // a tick each 200 ms: half as fast as it is played
      if (k % 12 === 0) source.endS += 0.1;
      const before = player.timeS;
      run(16);
      if (k > 60) steps.push(player.timeS - before);
    }
    expect(Math.min(...steps)).toBeGreaterThan(0); // it never stands
    expect(player.timeS).toBeGreaterThan(0.9 * (source.endS - 0.2)); // and shows what there is
    expect(player.keptSpeed).toBeGreaterThan(0.3);
    expect(player.keptSpeed).toBeLessThan(0.8);
    player.pause();
    expect(player.keptSpeed).toBe(1);
  });
  it('goes on with a live run, for ever', () => {
    const { player, run } = playing(new Fake(0, true));
    player.play();
    player.setSpeed(64);
    run(10000);
    expect(player.timeS).toBeCloseTo(640);
    expect(player.playing).toBe(true);
    player.end();
    expect(player.playing).toBe(true);
  });

  it('does not leap after a while in the background', () => {
    const { player } = playing(new Fake(100));
    player.play();
    player.frame(2000);
    const { timeS } = player;
    player.frame(60000);
    expect(player.timeS - timeS).toBeCloseTo(0.25);
  });

  it('steps from tick to tick', () => {
    const { player } = playing(new Fake(20));
    player.seek(3.14);
    player.step(1);
    expect(player.timeS).toBeCloseTo(3.2);
    player.step(1);
    expect(player.timeS).toBeCloseTo(3.3);
    player.seek(3.14);
    player.step(-1);
    expect(player.timeS).toBeCloseTo(3.1);
    player.home();
    player.step(-1);
    expect(player.timeS).toBe(0);
    player.end();
    player.step(1);
    expect(player.timeS).toBe(20);
  });

  it('suits the length of a mission until somebody chooses a speed', () => {
    const player = new Player();
    const suited = [0, 150, 450, 900, 3636, 1e9].map((limitS) => { player.suit(limitS); return player.speed; });
    expect(suited).toEqual([1, 1, 1, 2, 8, 64]);
    player.setSpeed(4);
    player.suit(3636);
    expect(player.speed).toBe(4);
  });

  it('has speeds that are powers of two, and strides that follow', () => {
    const { player } = playing(new Fake(1000));
    const speeds: number[] = [];
    player.setSpeed(0.01);
    for (let k = 0; k < 12; ++k, player.faster()) speeds.push(player.speed);
    expect(speeds).toEqual([0.25, 0.5, 1, 2, 4, 8, 16, 32, 64, 64, 64, 64]);
    player.setSpeed(NaN);
    expect(player.speed).toBe(64);
    expect(player.stride).toBe(1);
    player.play();
    expect(player.stride).toBe(32);
    player.setSpeed(1);
    expect(player.stride).toBe(1);
  });

  it('shows two sources with one clock: the shorter one ends earlier', () => {
    const short = new Fake(3);
    const long = new Fake(6);
    const { player, run } = playing(short, long);
    long.loadedS = 4;
    player.play();
    run(8000);
    expect(player.timeS).toBeCloseTo(4);
    long.loadedS = Infinity;
    run(8000);
    expect(player.timeS).toBe(6);
  });

  it('fetches in the direction of the visitor', () => {
    const source = new Fake(20);
    const { player, run } = playing(source);
    player.seek(10);
    run(16);
    player.seek(8);
    run(16);
    expect(source.asked.at(-1)).toEqual([8, -1, 1]);
    player.setSpeed(4);
    player.play();
    run(16);
    expect(source.asked.at(-1)!.slice(1)).toEqual([4, 2]);
  });

  it('keeps its promises whatever happens', () => {
    const next = random(42);
    for (let round = 0; round < 60; ++round) {
      const source = new Fake(5 + 20 * next(), next() < 0.3);
      const { player, run } = playing(source);
      for (let k = 0; k < 120; ++k) {
        source.loadedS = next() < 0.5 ? Infinity : 25 * next();
        const actions = [() => player.play(), () => player.pause(), () => player.toggle(), () => player.faster(),
          () => player.slower(), () => player.seek(30 * next() - 3), () => player.step(Math.round(6 * next()) - 3),
          () => player.home(), () => player.end(), () => player.setSpeed(100 * next()), () => player.seek(NaN)];
        actions[Math.floor(actions.length * next())]();
        const before = player.timeS;
        run(16 + 100 * next());
        const elapsed = player.timeS - before;
        expect(elapsed).toBeGreaterThanOrEqual(0);
        expect(elapsed).toBeLessThanOrEqual(0.12 * player.speed + 1e-9);
        expect(player.timeS).toBeGreaterThanOrEqual(0);
        if (!source.growing) expect(player.timeS).toBeLessThanOrEqual(source.endS);
        if (elapsed > 0) expect(player.timeS).toBeLessThanOrEqual(source.loadedS);
        expect(player.speed >= slowest && player.speed <= fastest && Number.isInteger(Math.log2(player.speed))).toBe(true);
        if (!player.playing) expect(elapsed > 0 && !player.atEnd).toBe(false);
      }
    }
  });
});
