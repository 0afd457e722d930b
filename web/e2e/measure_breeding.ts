// How long a breeder waits, measured in the real page with the real program: npm run waits [TIMES] (after script/build, on a
// machine that does nothing else). Prints median and 95th percentile in milliseconds, for each of a few samples.
//   first 12       from the click that starts a session to the last of its models over the socket, and drawn on the page
//   next 20        from the key that breeds to the generation's word, to the last of its models, and to all of them drawn
//   alone          the same without the page, whose frames a machine without a graphics card draws by processor: a bare socket in a
//                  page without scripts
//   a rating       from the request to its answer, which comes when the rating is on the disk
import type { Page } from "playwright-core";
import { launch } from "./browser.ts";
import { tell } from "./figures.ts";
import { Program } from "./program.ts";

interface Seen {
  generations: { generation: number; at: number }[];
  models: number[];
  asked: Map<number, number>;
  rated: number[];
}
declare const seen: Seen;

/** Runs in the page before all else: notes what goes over the socket. */
function watch(): void {
  const noted: Seen = { generations: [], models: [], asked: new Map(), rated: [] };
  Object.assign(window, { seen: noted });
  const Socket = window.WebSocket;
  window.WebSocket = class extends Socket {
    constructor(address: string | URL, protocols?: string | string[]) {
      super(address, protocols);
      this.addEventListener("message", ({ data }: MessageEvent) => {
        const at = performance.now();
        if (typeof data !== "string") {
          if (data instanceof ArrayBuffer && new TextDecoder().decode(data.slice(0, 4)) === "ESPI") noted.models.push(at);
        } else if (data.startsWith('{"kind":"breeding"')) noted.generations.push({ generation: JSON.parse(data).generation, at });
        else if (data.startsWith('{"kind":"done"')) {
          const asked = noted.asked.get(JSON.parse(data).request);
          if (asked !== undefined) noted.rated.push(at - asked);
        }
      });
    }
    override send(data: string | ArrayBufferLike | Blob | ArrayBufferView): void {
      if (typeof data === "string" && data.includes('"kind":"rate"')) noted.asked.set(JSON.parse(data).request, performance.now());
      super.send(data as string);
    }
  };
}

/** Milliseconds from `action` to each of: the generation's word, the last of its models, all in their places. */
async function generation(page: Page, number: number, count: number, action: string): Promise<[number, number, number]> {
  return page.evaluate(async ([number, count, action]) => {
    const before = seen.models.length, words = seen.generations.length, began = performance.now();
    if (action === "start") [...document.querySelectorAll("button")].find((one) => one.textContent?.includes("Start breeding"))!.click();
    else (document.activeElement ?? document.body).dispatchEvent(new KeyboardEvent("keydown", { key: action, bubbles: true }));
    const there = () => seen.generations.slice(words).find((one) => one.generation === number);
    while (!there() || seen.models.length < before + count || document.querySelectorAll("[data-individual]").length !== count ||
      document.querySelector(".cell-words") !== null || document.querySelector("canvas[data-undrawn='0']") === null) await new Promise((done) => setTimeout(done, 1));
    const gl = document.querySelector<HTMLCanvasElement>("canvas[data-undrawn]")!.getContext("webgl2")!;
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits until all is drawn
    return [there()!.at - began, seen.models.at(-1)! - began, performance.now() - began] as [number, number, number];
  }, [number, count, action] as const);
}

/** Milliseconds, first of a session of 12 and then of a generation of 20: to the word, to the last model. */
async function alone(page: Page, url: string): Promise<{ first: number; word: number; next: number }[]> {
  await page.route("**/*.js", (route) => route.abort());
  await page.goto(url);
  return page.evaluate(async (times) => {
    const token = new URL(location.href).searchParams.get("token")!;
    const socket = new WebSocket(`ws://${location.host}/socket?token=${token}`);
    socket.binaryType = "arraybuffer";
    let models = 0, asked = 0, last = 0;
    const heard = new Map<number, number>();
    const ids: number[] = [];
    const words: { generation: number; at: number }[] = [];
    socket.addEventListener("message", ({ data }) => {
      if (typeof data !== "string") {
        if (new TextDecoder().decode(data.slice(0, 4)) === "ESPI") ++models, (last = performance.now());
        return;
      }
      const message = JSON.parse(data);
      if (message.kind === "projects") ids.splice(0, ids.length, ...message.projects.map((one: { id: number }) => one.id));
      if (message.kind === "breeding") words.push({ generation: message.generation, at: performance.now() });
      if (message.kind === "failed") throw new Error(message.text);
      if (message.request !== undefined) heard.set(message.request, performance.now());
    });
    const until = async (there: () => boolean) => {
      while (!there()) await new Promise((done) => setTimeout(done, 1));
    };
    await until(() => ids.length > 0);
    const ask = async (what: object) => {
      const request = ++asked;
      socket.send(JSON.stringify({ ...what, request }));
      await until(() => heard.has(request));
    };
    await ask({ kind: "open_project", project: ids[0] });
    const out: { first: number; word: number; next: number }[] = [];
    for (let i = 0; i < times; ++i) {
      const timed = async (what: object, count: number, generation: number): Promise<[number, number]> => {
        await new Promise((done) => setTimeout(done, 700));
        const began = performance.now(), before = models, said = words.length;
        await ask(what);
        await until(() => models >= before + count);
        return [words.slice(said).find((one) => one.generation === generation)!.at - began, last - began];
      };
      const [, first] = await timed({ kind: "start_breeding", settings: { population: 12 }, from: "nothing", seed: i }, 12, 1);
      await timed({ kind: "start_breeding", settings: { population: 20 }, from: "nothing", seed: 100 + i }, 20, 1);
      const [word, next] = await timed({ kind: "breed" }, 19, 2);  // the best stays, and may be a twin
      out.push({ first, word, next });
    }
    return out;
  }, times);
}

const times = Number(process.argv[2] ?? 5);
const browser = await launch();
try {
  for (const sample of (process.argv[3] ?? "Gentree,Gentree natural,Arboretum").split(",")) {
    const program = new Program();
    try {
      await program.start();
      const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: "reduce" });
      await context.addInitScript(watch);
      const page = await context.newPage();
      page.setDefaultTimeout(120_000);
      await page.goto(program.url);
      await page.getByRole("dialog", { name: "Projects" }).getByText(sample, { exact: true }).click();
      await page.locator(".project-button", { hasText: sample }).waitFor();
      await page.getByText(/[1-9]\S* parts/).waitFor();
      await page.getByRole("button", { name: "Breed", exact: true }).click();
      const start = async (count: number): Promise<[number, number, number]> => {
        if ((await page.getByRole("button", { name: /^Sessions/ }).count()) > 0) await page.getByRole("button", { name: /^Sessions/ }).click();
        await page.getByLabel("Models", { exact: true }).last().fill(String(count));
        await page.keyboard.press("Tab");
        return generation(page, 1, count, "start");
      };
      console.log(`== ${sample}`);
      const first: [number, number, number][] = [], next: [number, number, number][] = [], quick: number[] = [];
      for (let i = 0; i < times; ++i) {
        first.push(await start(12));
        await page.waitForTimeout(500);
      }
      tell("first 12, over the socket", first.map((one) => one[1]));
      tell("first 12, drawn", first.map((one) => one[2]), "(2000 wanted)");
      await start(20);
      for (let i = 0; i < times; ++i) {
        await page.waitForTimeout(1000);
        const cells = await page.locator("[data-individual]").all();
        for (const k of [1, 4, 9]) {
          await cells[k]!.getByRole("button", { name: "a point more" }).click();
          await page.waitForTimeout(150);
        }
        await cells[0]!.focus();
        next.push(await generation(page, i + 2, 20, "n"));
      }
      quick.push(...(await page.evaluate(() => seen.rated)));
      tell("next 20, its word", next.map((one) => one[0]));
      tell("next 20, over the socket", next.map((one) => one[1]), "(200 wanted)");
      tell("next 20, drawn", next.map((one) => one[2]));
      tell("a rating", quick, "(50 wanted)");
      await page.close();
      const bare = await alone(await context.newPage(), program.url);
      tell("first 12, alone", bare.map((one) => one.first), "(2000 wanted)");
      tell("next 20, alone, its word", bare.map((one) => one.word), "(200 wanted)");
      tell("next 20, alone, models", bare.map((one) => one.next), "(200 wanted)");
      await context.close();
    } finally {
      await program.end();
    }
  }
} finally {
  await browser.close();
}
