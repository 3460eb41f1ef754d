// SPDX-License-Identifier: MIT
// How fast the clock goes that follows a recording while it is written. What is new comes in pieces, at a pace that is
// not known; the clock stays a little behind, so that it need not stop between two pieces.

const rememberedMs = 12_000;
const mostRemembered = 40;
const behind = 1.5; // pieces
const correction = 0.5; // of the speed, if it is twice as far behind as it should be
const slowestShare = 0.25;
const fastestShare = 4;
const farBehind = 6; // times as far as it should be: not worth catching up with

export class Chase {
  private seen: { atMs: number; endS: number }[] = [];

  forget(): void {
    this.seen = [];
  }

  /** The recording ends there now. Once per picture. */
  note(nowMs: number, endS: number): void {
    if (this.seen.at(-1)?.endS === endS) return;
    this.seen.push({ atMs: nowMs, endS });
    while (this.seen.length > 2 && (this.seen.length > mostRemembered || nowMs - this.seen[0].atMs > rememberedMs)) this.seen.shift();
  }

  /** Seconds of the run per second, and how far behind the end to be; null: nothing is known yet. By medians: a piece
   *  that was late, or a leap, says nothing of the pace. */
  private get pace(): { speed: number; behindS: number } | null {
    const pieces = this.seen.slice(1).map((now, k) => ({ s: now.endS - this.seen[k].endS, ms: now.atMs - this.seen[k].atMs }));
    const sound = pieces.filter(({ s, ms }) => s > 0 && ms > 0);
    if (sound.length === 0) return null;
    return { speed: 1000 * median(sound.map(({ s, ms }) => s / ms)), behindS: behind * median(sound.map(({ s }) => s)) };
  }

  /** Where the clock is to be, after so long. */
  next(timeS: number, endS: number, elapsedS: number): number {
    const { pace } = this;
    if (pace === null) return Math.min(endS, timeS + elapsedS);
    const { speed, behindS } = pace;
    const gapS = endS - timeS;
    if (gapS > farBehind * behindS) return endS - behindS;
    const share = Math.min(fastestShare, Math.max(slowestShare, 1 + correction * (gapS / behindS - 1)));
    return Math.min(endS, timeS + elapsedS * speed * share);
  }

  /** As the player's speed. */
  get speed(): number {
    return this.pace?.speed ?? 1;
  }
}

function median(values: number[]): number {
  return values.sort((a, b) => a - b)[values.length >> 1];
}
