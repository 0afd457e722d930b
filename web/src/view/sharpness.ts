// How sharp frames are drawn. At rest with all pixels of the screen; while something moves, on machines that take long for that,
// with fewer, so that what a hand does is seen at once.

export interface SharpnessClock {
  now(): number;
  /** Calls once after milliseconds; returns how to take it back. */
  later(milliseconds: number, call: () => void): () => void;
}

/** Frames nearer to each other than this, in milliseconds, are a movement. */
const kRest = 180;
/** What a sharp frame may take, in milliseconds, before movements are drawn with fewer pixels. */
const kBearable = 33;
/** Of the pixels on a side; fewer look broken. */
const kLeast = 0.5;

export class Sharpness {
  private cost = 0;
  private last = -Infinity;
  private cancel = () => {};

  /** `rested`: what moved has come to rest before it was drawn sharp, and a frame is due. */
  constructor(private readonly clock: SharpnessClock, private readonly rested: () => void) {}

  /** Of the frame that is drawn now: the share of the screen's pixels on a side, kLeast .. 1. */
  next(): number {
    const now = this.clock.now(), moving = now - this.last < kRest;
    this.last = now;
    this.cancel();
    if (!moving || this.cost <= kBearable) return 1;
    this.cancel = this.clock.later(kRest, this.rested);
    return Math.max(kLeast, Math.round(8 * Math.sqrt(kBearable / this.cost)) / 8);
  }

  /** A sharp frame took so many milliseconds, from its first call to its last pixel. */
  took(milliseconds: number): void {
    this.cost = this.cost === 0 ? milliseconds : 0.5 * (this.cost + milliseconds);
  }

  dispose(): void {
    this.cancel();
  }
}
