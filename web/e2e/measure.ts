// How long an artist waits, measured in the real page with the real program: npm run measure [STROKES] (after script/build, on
// a machine that does nothing else). Prints median and 95th percentile of several times each, in milliseconds.
//   stroke         pointer-up on a curve, to the first draw call with a model made for it submitted; sample Guided tree
//   first paint    from opening the link to the first frame with the model of a project that was there
//   long tasks     of the page while a search streams models, more than 50 ms each; without a graphics card these are the browser
//                  drawing by processor, not scripts of ours
//   stop           from the click to the search having ended
//   reach          from the last key of an edit to the cloud of the rule under the cursor
//   frame          script of a frame while the camera turns about a city of tens of thousands of parts, and its draw calls
//   shut down      of the server while pages are open
import type { Page } from "playwright-core";
import { cursorAfter, launch } from "./browser.ts";
import { tell } from "./figures.ts";
import { Program } from "./program.ts";

interface Seen {
  documents: { revision: number; at: number }[];
  shown: Map<number, number>;
  frames: { model: number | null; milliseconds: number; calls: number; at: number }[];
  states: { running: boolean; at: number }[];
  clouds: number[];
  keys: number[];
  ups: number[];
  tasks: number[];
}
declare const seen: Seen;

/** Runs in the page before all else: notes what comes over the socket, what is drawn, and what a person does. */
function watch(): void {
  const noted: Seen = { documents: [], shown: new Map(), frames: [], states: [], clouds: [], keys: [], ups: [], tasks: [] };
  Object.assign(window, { seen: noted });
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(address: string | URL, protocols?: string | string[]) {
      super(address, protocols);
      this.addEventListener("message", ({ data }: MessageEvent) => {
        const at = performance.now();
        if (typeof data !== "string") {
          if (data instanceof ArrayBuffer && new TextDecoder().decode(data.slice(0, 4)) === "ESPC") noted.clouds.push(at);
          return;
        }
        if (data.startsWith('{"kind":"document"')) noted.documents.push({ revision: JSON.parse(data).revision, at });
        else if (data.startsWith('{"kind":"search_state"')) noted.states.push({ running: JSON.parse(data).running, at });
        else if (data.startsWith('{"kind":"shown"')) {
          const { model, revision } = JSON.parse(data);
          noted.shown.set(model, revision);
        }
      });
    }
  };
  addEventListener("viewframe", (event) => noted.frames.push({ ...(event as CustomEvent).detail, at: performance.now() }), true);
  addEventListener("pointerup", () => noted.ups.push(performance.now()), true);
  addEventListener("keydown", () => noted.keys.push(performance.now()), true);
  new PerformanceObserver((list) => noted.tasks.push(...list.getEntries().map((entry) => entry.duration))).observe({ type: "longtask" });
}

const strokes = Number(process.argv[2] ?? 30);
const browser = await launch();
const program = new Program();
try {
  await program.start();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: "reduce" });
  await context.addInitScript(watch);
  const open = async (): Promise<Page> => {
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);
    await page.goto(program.url);
    return page;
  };
  const idle = (page: Page) => page.locator(".search-button", { hasText: "Search" }).waitFor();
  const begin = async (page: Page, sample: string) => {
    const dialog = page.getByRole("dialog", { name: "Projects" });
    if (!(await dialog.isVisible())) await page.keyboard.press("Control+o");
    await dialog.getByText(sample, { exact: true }).click();
    await page.locator(".project-button", { hasText: sample }).waitFor();
    await page.getByText(/[1-9]\S* parts/).waitFor();
    await idle(page);
  };
  const drag = async (page: Page, from: readonly [number, number], to: readonly [number, number], each?: () => Promise<void>) => {
    const box = (await page.locator(".view-element canvas").first().boundingBox())!;
    const place = (k: number) => [0, 1].map((i) => (i === 0 ? box.x : box.y) + (from[i]! + (to[i]! - from[i]!) * k) * (i === 0 ? box.width : box.height)) as [number, number];
    await page.mouse.move(...place(0));
    await page.mouse.down();
    for (let i = 1; i <= 12; ++i) {
      await page.mouse.move(...place(i / 12));
      await each?.();
    }
    await page.mouse.up();
  };

  let page = await open();
  await page.getByRole("dialog", { name: "Projects" }).waitFor();
  await begin(page, "Guided tree");

  const waits: number[] = [];
  for (let i = 0; i < strokes; ++i) {
    await page.locator(".view-element").focus();
    await page.keyboard.press("c");
    const before = await page.evaluate(() => seen.documents.at(-1)!.revision);
    await drag(page, [0.5, 0.75], [0.2 + (0.6 * (i % 7)) / 6, 0.2 + 0.04 * (i % 5)]);
    waits.push(await page.evaluate(async (revision) => {
      const up = seen.ups.at(-1)!;
      for (;;) {
        const drawn = seen.frames.find((frame) => frame.at > up && frame.model !== null && (seen.shown.get(frame.model) ?? 0) > revision);
        if (drawn) return drawn.at - up;
        await new Promise((done) => setTimeout(done, 2));
      }
    }, before));
    await idle(page);
    await page.keyboard.press("Control+z");
    await page.waitForTimeout(300);
    await idle(page);
  }
  tell("stroke", waits, "(100 median, 200 p95 wanted)");

  const time = page.getByRole("slider", { name: "Time", exact: true }), seconds = await time.inputValue();
  await time.focus();
  await page.keyboard.press("End");  // a minute: no search ends by itself before it is stopped
  await page.waitForTimeout(1000);
  const stop = page.locator(".search-button", { hasText: "Stop" });
  if (await stop.isVisible()) await stop.click();
  await idle(page);
  await page.evaluate(() => (seen.tasks.length = 0));
  const stops: number[] = [];
  for (let i = 0; i < 5; ++i) {
    await page.locator(".search-button").click();
    await page.waitForTimeout(1500);
    stops.push(await page.locator(".search-button").evaluate(async (button: HTMLElement) => {
      const began = performance.now();
      button.click();
      for (;;) {
        const ended = seen.states.find((state) => state.at > began && !state.running);
        if (ended) return ended.at - began;
        await new Promise((done) => setTimeout(done, 1));
      }
    }));
    await idle(page);
  }
  const tasks = await page.evaluate(() => seen.tasks);
  tell("long tasks", tasks, `(0 wanted; in ${1.5 * stops.length} s of searching)`);
  tell("stop", stops);
  await page.locator(".view-element").focus();
  while ((await time.inputValue()) !== seconds) {  // searches are steps too
    await page.keyboard.press("Control+z");
    await page.waitForTimeout(500);
  }
  await idle(page);

  const reach: number[] = [];
  await cursorAfter(page, "rule Branch");
  for (let i = 0; i < 10; ++i) {
    await page.waitForTimeout(1000);
    await idle(page);
    const clouds = await page.evaluate(() => seen.clouds.length);
    await cursorAfter(page, "uniform(0deg, 8");
    await page.keyboard.press(i % 2 === 0 ? "5" : "Backspace");
    if (i % 2 === 0) await page.keyboard.press("Delete");
    else await page.keyboard.type("8");
    reach.push(await page.evaluate(async (count) => {
      while (seen.clouds.length <= count) await new Promise((done) => setTimeout(done, 2));
      return seen.clouds.at(-1)! - seen.keys.at(-1)!;
    }, clouds));
  }
  tell("reach", reach, "(300 wanted)");

  const paints: number[] = [];
  for (let i = 0; i < 5; ++i) {
    const other = await open();
    paints.push(await other.evaluate(async () => {
      for (;;) {
        const drawn = seen.frames.find((frame) => frame.model !== null);
        if (drawn) return drawn.at;
        await new Promise((done) => setTimeout(done, 5));
      }
    }));
    await other.close();
  }
  tell("first paint", paints, "(2000 wanted)");

  await begin(page, "City filling");
  const parts = await page.getByText(/[1-9]\S* parts/).innerText();
  await page.evaluate(() => (seen.frames.length = 0));
  await page.locator(".view-element").focus();
  await page.keyboard.press("v");
  await drag(page, [0.9, 0.9], [0.6, 0.85], () => page.evaluate(() => new Promise<void>((done) => requestAnimationFrame(() => done()))));
  const frames = await page.evaluate(() => seen.frames);
  tell("frame", frames.map((frame) => frame.milliseconds), `(4 wanted; ${Math.max(...frames.map((frame) => frame.calls))} draw calls, 20 wanted; ${parts})`);

  const shut: number[] = [await program.interrupt()];
  for (let i = 0; i < 2; ++i) {
    await program.start();
    const other = await open();
    await other.getByText(/[1-9]\S* parts/).waitFor();
    shut.push(await program.interrupt());
    await other.close();
  }
  tell("shut down", shut, "(300 wanted)");
} finally {
  await browser.close();
  await program.end();
}
