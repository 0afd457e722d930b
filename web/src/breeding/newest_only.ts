// Requests that a hand makes faster than they are answered: one is on its way, and what came meanwhile goes as one.

export class NewestOnly<T> {
  private next: T | null = null;
  private busy = false;

  /** `join` makes one of two that wait; null: they are two, and the first goes at once. `send` says whether it worked: if not, what
   *  waits is dropped. */
  constructor(private readonly send: (what: T) => Promise<boolean>, private readonly join: (before: T, after: T) => T | null = (_, after) => after) {}

  push(what: T): void {
    const joined = this.next === null ? null : this.join(this.next, what);
    if (joined === null) this.flush();
    this.next = joined ?? what;
    if (!this.busy) void this.run();
  }

  /** Sends what waits now, ahead of what must come after it. */
  flush(): void {
    const what = this.next;
    this.next = null;
    if (what !== null) void this.send(what);
  }

  clear(): void {
    this.next = null;
  }

  private async run(): Promise<void> {
    this.busy = true;
    for (let what = this.next; what !== null; what = this.next) {
      this.next = null;
      if (!(await this.send(what))) break;
    }
    this.next = null;
    this.busy = false;
  }
}
