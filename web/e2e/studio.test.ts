// The page with the real program behind it: what an artist does in a first quarter of an hour.
import { readFileSync } from "node:fs";
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from "vitest";
import type { Browser, Page } from "playwright-core";
import type { Message } from "../src/api";
import { showNumber } from "../src/controls/number.ts";
import { cursorAfter, grammarOf, launch, openProgram } from "./browser.ts";
import type { Program } from "./program.ts";

let browser: Browser;
let program: Program;
let page: Page;
let heard: Message[];
let complaints: string[];

beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());
beforeEach(async () => {
  ({ page, program, heard, complaints } = await openProgram(browser));
});
afterEach(async () => {
  await page.context().close();
  await program.end();
});

async function begin(sample: string): Promise<void> {
  await page.getByRole("dialog", { name: "Projects" }).getByText(sample, { exact: true }).click();
  await page.locator(".project-button", { hasText: sample }).waitFor();
  await page.getByText(/\d+ parts/).waitFor();
}

const score = async () => Number((await page.locator(".objective output, .objective .score").first().innerText()).replace(/[^\d.-]/g, ""));
/** What the model consists of, without the milliseconds of its last frame. */
const status = async () => (await page.locator(".view-numbers").innerText()).split(" · ").slice(0, 3).join(" · ");
const idle = () => page.locator(".search-button", { hasText: "Search" }).waitFor();

type Kind = Message["kind"];
const newest = <K extends Kind>(kind: K) => heard.findLast((one): one is Extract<Message, { kind: K }> => one.kind === kind);

/** Until the server has said such a thing after `from` messages; what it said. The page may stall meanwhile, and see less. */
async function hear<K extends Kind>(from: number, kind: K, passes: (message: Extract<Message, { kind: K }>) => boolean = () => true) {
  const find = () => heard.slice(from).find((one): one is Extract<Message, { kind: K }> => one.kind === kind && passes(one as Extract<Message, { kind: K }>));
  await expect.poll(() => find() !== undefined, { timeout: 90_000 }).toBe(true);
  return find()!;
}

/** Until a search that was begun after `from` messages is over, and the page shows it. */
async function searched(from: number): Promise<void> {
  const began = heard.indexOf(await hear(from, "search_state", (state) => state.running));
  const { evaluations } = await hear(began, "search_state", (state) => !state.running);
  await expect.poll(async () => (await page.locator(".search-numbers").innerText()).replace(/\D/g, ""), { timeout: 90_000 }).toContain(String(evaluations));
  await idle();
}

/** Where a place of the view is, given in its width and height. */
async function inView([x, y]: [number, number]): Promise<[number, number]> {
  const box = (await page.locator(".view-element canvas").first().boundingBox())!;
  return [box.x + x * box.width, box.y + y * box.height];
}

/** Drags in the view, from and to given in its width and height. */
async function drag(from: [number, number], to: [number, number], modifier?: string): Promise<void> {
  const [a, b] = [await inView(from), await inView(to)];
  if (modifier !== undefined) await page.keyboard.down(modifier);
  await page.mouse.move(...a);
  await page.mouse.down();
  for (let i = 1; i <= 8; ++i) await page.mouse.move(a[0] + ((b[0] - a[0]) * i) / 8, a[1] + ((b[1] - a[1]) * i) / 8);
  await page.mouse.up();
  if (modifier !== undefined) await page.keyboard.up(modifier);
}

test("a grammar with a mistake is told and mended, and the model stays meanwhile", async () => {
  await begin("Guided bonsai");
  await idle();
  const before = await status();
  await cursorAfter(page, "rule Stem { spawn Branch");
  await page.keyboard.type("x");
  await page.locator(".problems li").first().waitFor();
  expect(await page.locator(".problems li").first().innerText()).toContain("Branchx");
  expect(await status()).toBe(before);
  await page.keyboard.press("Backspace");
  await page.getByText("The grammar is sound.").waitFor();
  expect(complaints).toEqual([]);
});

test("a curve is drawn, the model follows; undo takes it back, a reload keeps it", async () => {
  await begin("Guided bonsai");
  await idle();
  expect(await page.locator(".targets li").count()).toBe(3);
  await page.locator(".view-element").focus();
  await page.keyboard.press("c");
  const before = heard.length;
  await drag([0.35, 0.75], [0.15, 0.45]);
  await page.locator(".targets li").nth(3).waitFor();
  const { revision } = await hear(before, "document", (document) => document.scene.curves?.curve.length === 4);
  await hear(before, "shown", (shown) => (shown.revision ?? 0) >= revision);
  await idle();
  await page.reload();
  await page.locator(".targets li").nth(3).waitFor();
  await page.keyboard.press("Control+z");
  await page.locator(".targets li").nth(3).waitFor({ state: "detached" });
  expect(complaints).toEqual([]);
});

test("a handle of a curve is dragged, and the model follows before it is let go of", async () => {
  await begin("Guided bonsai");
  await idle();
  await page.locator(".view-element").focus();
  await page.keyboard.press("c");
  const end: [number, number] = [0.15, 0.45];
  let from = heard.length;
  await drag([0.35, 0.75], end, "Shift");
  const drawn = await hear(from, "document", (document) => document.scene.curves?.curve.length === 4);
  await searched(from);
  const before = await score();
  await page.keyboard.press("v");
  from = heard.length;
  await page.mouse.move(...(await inView(end)));
  await page.mouse.down();
  await page.mouse.move(...(await inView([0.2, 0.35])), { steps: 6 });
  // The button is still down.
  const points = (document: Extract<Message, { kind: "document" }>) => document.scene.curves!.curve[3]!.points;
  const moved = await hear(from, "document", (document) => points(document)[3][1] !== points(drawn)[3][1]);
  expect(points(moved)[0]).toEqual(points(drawn)[0]);
  await hear(from, "shown", (shown) => (shown.revision ?? 0) >= moved.revision && shown.score !== undefined);
  await expect.poll(score, { timeout: 90_000 }).not.toBe(before);
  await page.mouse.up();
  await expect.poll(async () => (await score()) === Number(showNumber(newest("shown")!.score!)), { timeout: 90_000 }).toBe(true);
  // All of it is one step.
  await page.keyboard.press("Control+z");
  await hear(from, "document", (document) => document.revision > moved.revision && points(document)[3][1] === points(drawn)[3][1]);
  expect(complaints).toEqual([]);
});

test("a silhouette is painted and becomes a target", async () => {
  await begin("Guided bonsai");
  await idle();
  await page.locator(".view-element").focus();
  await page.getByRole("button", { name: /Paint/ }).click();
  await drag([0.3, 0.3], [0.7, 0.3]);
  await drag([0.3, 0.4], [0.7, 0.4]);
  await page.locator(".view-element").focus();
  await page.keyboard.press("Enter");
  await page.locator(".targets li").nth(3).waitFor();
  await expect.poll(() => page.locator(".objective").innerText(), { timeout: 90_000 }).toContain("silhouette");
  // Seen from elsewhere, it is painted on from where it was painted, and stays one.
  const pixels = () => page.locator(".silhouette-cards img").evaluate(async (image: HTMLImageElement) => {
    await image.decode();
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
    const paper = canvas.getContext("2d")!;
    paper.drawImage(image, 0, 0);
    return paper.getImageData(0, 0, canvas.width, canvas.height).data.filter((a, i) => i % 4 === 3 && a > 128).length;
  });
  const before = await pixels();
  const first = await page.locator(".silhouette-cards img").getAttribute("src");
  await page.locator(".view-element").focus();
  await page.keyboard.press("3");
  await page.keyboard.press("p");
  await drag([0.5, 0.55], [0.5, 0.8]);
  await page.locator(".view-element").focus();
  await page.keyboard.press("Enter");
  await expect.poll(() => page.locator(".silhouette-cards img").getAttribute("src"), { timeout: 90_000 }).not.toBe(first);
  expect(await pixels()).toBeGreaterThan(1.2 * before);
  expect(await page.locator(".targets li").count()).toBe(4);
  await page.getByRole("button", { name: /Hide painted/ }).click();
  expect(await page.locator(".silhouette-cards li").count()).toBe(0);
});

test("a mesh dropped on the grammar tells its size and triangles, and how it looks", async () => {
  await begin("Guided bonsai");
  await idle();
  await page.locator(".grammar").evaluate((grammar) => {
    const files = new DataTransfer();
    files.items.add(new File(["v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"], "chip.obj"));
    grammar.dispatchEvent(new DragEvent("drop", { dataTransfer: files, bubbles: true }));
  });
  // The notice goes by itself: what it said stands in the log.
  await page.getByRole("tab", { name: "Log" }).click();
  const line = page.locator(".log li", { has: page.locator("img") });
  await line.waitFor();
  expect(await line.innerText()).toContain("4 triangles, 1 × 2 × 3 m");
  expect(await grammarOf(page)).toContain('mesh chip = "chip.obj"');
  const width = (picture: string) => page.locator(picture).evaluate(async (image: HTMLImageElement) => (await image.decode(), image.naturalWidth));
  expect(await width(".log img")).toBe(128);
  await page.getByRole("tab", { name: "Files" }).click();
  expect(await width(".files img")).toBe(128);
  expect(complaints).toEqual([]);
});

test("a model is searched, a part locked, and what is exported is a model", async () => {
  await begin("Spaceship");
  await idle();
  const before = await score();
  const from = heard.length;
  await page.getByRole("button", { name: "Continue" }).click();
  await searched(from);
  expect(await score()).toBeGreaterThanOrEqual(before);
  await page.locator(".view-element").focus();
  const box = (await page.locator(".view-element canvas").first().boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.getByRole("button", { name: "Lock", exact: true }).click();
  await page.getByRole("button", { name: "Lock", exact: true, pressed: true }).waitFor();
  await page.getByRole("button", { name: "Export" }).click();
  const download = page.waitForEvent("download");
  await page.getByRole("menuitem", { name: /GLB/ }).click();
  const file = readFileSync(await (await download).path());
  expect(file.subarray(0, 4).toString()).toBe("glTF");
  expect(file.readUInt32LE(8)).toBe(file.length);
});

test("after kill -9 the page finds its server again, and nothing is lost", async () => {
  await begin("Guided bonsai");
  await idle();
  await cursorAfter(page, "start Stem");
  await page.keyboard.type("\nconst kept = 1");
  const text = await grammarOf(page);
  expect(text).toContain("\nconst kept = 1");
  await hear(0, "document", (document) => document.grammar === text);
  const port = program.port;
  await program.kill();
  await page.getByText("Connection lost.", { exact: false }).waitFor();
  await program.start(port);
  await page.locator(".connection").waitFor({ state: "detached" });
  await page.reload();
  await expect.poll(() => grammarOf(page), { timeout: 90_000 }).toBe(text);
});
