// The camera's place, and its short turns from one place to another.
import { between, kStart, type Orbit } from "./orbit";

const kMilliseconds = 240;

export class Motion {
  orbit: Orbit = kStart;
  private turn: { from: Orbit; to: Orbit; start: number | null } | null = null;

  get moving(): boolean {
    return this.turn !== null;
  }

  /** Where a turn under way will end. */
  get goal(): Orbit {
    return this.turn?.to ?? this.orbit;
  }

  set(orbit: Orbit): void {
    this.turn = null;
    this.orbit = orbit;
  }

  /** At once for those who asked their system for less movement. */
  go(to: Orbit, calm: boolean): void {
    if (calm) this.set(to);
    else this.turn = { from: this.orbit, to, start: null };
  }

  /** To where it is at a time, milliseconds; the first step starts the clock. */
  step(now: number): void {
    if (!this.turn) return;
    this.turn.start ??= now;
    const t = (now - this.turn.start) / kMilliseconds;
    this.orbit = t >= 1 ? this.turn.to : between(this.turn.from, this.turn.to, t);
    if (t >= 1) this.turn = null;
  }
}
