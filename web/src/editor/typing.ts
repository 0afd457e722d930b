// Bursts of typing: what one undo takes back. A new burst begins after a pause, when the cursor was moved elsewhere, and when
// erasing follows writing.
import { uniqueName } from "../base/unique_name";

export const kBurstPause = 900;

export interface Keystroke {
  /** Where the text was changed, and where that ends now. */
  from: number;
  to: number;
  erased: boolean;
  /** Milliseconds on any clock. */
  at: number;
}

export class TypingBursts {
  private name = "";
  private last: Keystroke | null = null;

  /** Name of the gesture that the key belongs to. */
  gesture(key: Keystroke): string {
    const last = this.last;
    const goesOn =
      last !== null && key.at - last.at < kBurstPause && key.erased === last.erased && key.from <= last.to + 1 && key.to >= last.from - 1;
    if (!goesOn) this.name = uniqueName("typing");
    this.last = key;
    return this.name;
  }

  /** The next key begins a new one. */
  end(): void {
    this.last = null;
  }
}
