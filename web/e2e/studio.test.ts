// The page with the real program behind it: what an artist does in a first quarter of an hour.
import { readFileSync } from "node:fs";
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from "vitest";
import type { Browser, Page } from "playwright-core";
import { cursorAfter, grammarOf, launch, openProgram } from "./browser.ts";
import type { Program } from "./program.ts";

let browser: Browser;
let program: Program;
let page: Page;
let complaints: string[];

beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());
beforeEach(async () => {
  ({ page, program, complaints } = await openProgram(browser));
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
const status = () => page.getByText(/\d+ parts/).innerText();
const idle = () => page.locator(".search-button", { hasText: "Search" }).waitFor();

/** Drags in the view, from and to given in its width and height. */
async function drag(from: [number, number], to: [number, number], modifier?: string): Promise<void> {
  const box = (await page.locator(".view-element canvas").first().boundingBox())!;
  const at = ([x, y]: [number, number]): [number, number] => [box.x + x * box.width, box.y + y * box.height];
  if (modifier !== undefined) await page.keyboard.down(modifier);
  await page.mouse.move(...at(from));
  await page.mouse.down();
  for (let i = 1; i <= 8; ++i) await page.mouse.move(...at([from[0] + ((to[0] - from[0]) * i) / 8, from[1] + ((to[1] - from[1]) * i) / 8]));
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
  await drag([0.35, 0.75], [0.15, 0.45]);
  await page.locator(".targets li").nth(3).waitFor();
  await page.locator(".search-button", { hasText: "Stop" }).waitFor();
  await idle();
  await page.reload();
  await page.locator(".targets li").nth(3).waitFor();
  await page.keyboard.press("Control+z");
  await page.locator(".targets li").nth(3).waitFor({ state: "detached" });
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
  const notice = page.locator(".notice", { has: page.locator("img") });
  await notice.waitFor();
  expect(await notice.innerText()).toContain("4 triangles, 1 × 2 × 3 m");
  expect(await grammarOf(page)).toContain('mesh chip = "chip.obj"');
  const width = (picture: string) => page.locator(picture).evaluate(async (image: HTMLImageElement) => (await image.decode(), image.naturalWidth));
  expect(await width(".notice img")).toBe(128);
  await page.getByRole("tab", { name: "Log" }).click();
  expect(await width(".log img")).toBe(128);
  await page.getByRole("tab", { name: "Files" }).click();
  expect(await width(".files img")).toBe(128);
  expect(complaints).toEqual([]);
});

test("a model is searched, a part locked, and what is exported is a model", async () => {
  await begin("Spaceship");
  await idle();
  const before = await score();
  await page.getByRole("button", { name: "Continue" }).click();
  await idle();
  expect(await score()).toBeGreaterThanOrEqual(before);
  await page.locator(".view-element").focus();
  const box = (await page.locator(".view-element canvas").first().boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await page.getByRole("button", { name: "Lock", exact: true }).click();
  await page.getByRole("button", { name: "Locked" }).waitFor();
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
  await page.getByRole("button", { name: "Undo: Edit grammar" }).waitFor();
  const text = await grammarOf(page);
  const port = program.port;
  await program.kill();
  await page.getByText("Connection lost.", { exact: false }).waitFor();
  await program.start(port);
  await page.locator(".connection").waitFor({ state: "detached" });
  await page.reload();
  await expect.poll(() => grammarOf(page), { timeout: 90_000 }).toBe(text);
});
