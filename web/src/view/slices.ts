// Work in small steps, so that the page does not stand still meanwhile: a generator pauses wherever it may be interrupted.

export type Steps<T> = Generator<void, T>;

/** Milliseconds without a pause. */
const kSlice = 8;

export async function inSlices<T>(steps: Steps<T>): Promise<T> {
  for (let until = performance.now() + kSlice;;) {
    const step = steps.next();
    if (step.done) return step.value;
    if (performance.now() < until) continue;
    await new Promise((done) => setTimeout(done));
    until = performance.now() + kSlice;
  }
}

export function atOnce<T>(steps: Steps<T>): T {
  for (;;) {
    const step = steps.next();
    if (step.done) return step.value;
  }
}
