// The breeding room in a real browser, with the mock server.
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import type { Browser, Page } from "playwright-core";
import type { Request } from "../src/api.ts";
import { launch, openStudio, type Studio } from "./browser.ts";

let browser: Browser;
let studio: Studio;
let page: Page;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());
beforeEach(async () => {
  studio = await openStudio(browser);
  page = studio.page;
});
afterEach(async () => {
  expect(studio.complaints).toEqual([]);
  await studio.close();
});

const cells = () => page.getByRole("gridcell");
const cell = (id: number) => page.locator(`[data-individual="${id}"]`);
const more = (id: number) => cell(id).getByRole("button", { name: "a point more" });
const less = (id: number) => cell(id).getByRole("button", { name: "a point less" });
const generation = (number: number) => page.getByRole("heading", { name: `Generation ${number}`, exact: true });
const session = () => studio.server.room.open!;
const ratingOf = (id: number) => session().find(id)!.rating;
function sent<K extends Request["kind"]>(kind: K) {
  return studio.server.received.filter((one): one is Extract<Request, { kind: K }> => one.kind === kind);
}

async function start(mode = "Rate and edit", classic = false): Promise<void> {
  await page.getByRole("button", { name: "Breed", exact: true }).click();
  if (classic) await page.getByRole("radio", { name: /GenTree classic/ }).check();
  if (mode !== "Rate and edit") await page.getByLabel("You may").selectOption({ label: mode });
  await page.getByRole("button", { name: "Start breeding" }).click();
  await generation(1).waitFor();
}

/** Pixels of a cell that differ from its corner. */
async function drawnPixels(id: number): Promise<number> {
  const box = (await cell(id).boundingBox())!;
  const png = await page.screenshot({ clip: { x: box.x + 6, y: box.y + 30, width: box.width - 12, height: box.height - 70 } });
  return page.evaluate(async (bytes) => {
    const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
    const paper = new OffscreenCanvas(image.width, image.height).getContext("2d")!;
    paper.drawImage(image, 0, 0);
    const { data } = paper.getImageData(0, 0, image.width, image.height);
    let count = 0;
    for (let i = 0; i < data.length; i += 4) if ([0, 1, 2].some((k) => Math.abs(data[i + k]! - data[k]!) > 16)) ++count;
    return count;
  }, [...png]);
}

describe("the start", () => {
  test("the first bred generation is three clicks away", async () => {
    await page.getByRole("button", { name: "Breed", exact: true }).click();
    await page.getByRole("button", { name: "Start breeding" }).click();
    await page.getByRole("button", { name: "Next generation", exact: true }).click();
    await generation(2).waitFor();
    expect(await cells().count()).toBe(12);
  });

  test("every model is drawn", async () => {
    await start();
    await expect.poll(async () => Math.min(...await Promise.all([1, 6, 12].map(drawnPixels)))).toBeGreaterThan(300);
  });

  test.each(["Rate and edit", "Rate only", "Edit only", "Neither: watch it drift"])("%s", async (mode) => {
    await start(mode);
    const rate = mode.startsWith("Rate"), edit = mode === "Rate and edit" || mode === "Edit only";
    expect(await more(1).count()).toBe(rate ? 1 : 0);
    const slider = page.getByRole("slider", { name: "angle" });
    await slider.waitFor();
    expect(await slider.isEnabled()).toBe(edit);
    await page.keyboard.press("5");
    if (!rate) await page.getByText("bred without ratings").first().waitFor();
    await page.keyboard.press("n");
    await generation(2).waitFor();
    expect(sent("rate").length > 0).toBe(rate);
  });

  test("GenTree classic has 20 models and the knobs of Genesis", async () => {
    await start("Rate and edit", true);
    expect(await cells().count()).toBe(20);
    await page.getByRole("tab", { name: "Settings" }).click();
    await page.getByLabel("Gray code").uncheck();
    await expect.poll(() => session().settings.classic!.gray).toBe(false);
    await page.getByLabel("Crossover").focus();
    await page.keyboard.press("ArrowLeft");
    await expect.poll(() => session().settings.classic!.crossover).toBeCloseTo(0.55);
  });

  test("sessions are listed, renamed, opened and deleted, not without a question", async () => {
    await start();
    await page.getByRole("button", { name: /^Sessions/ }).click();
    await page.getByRole("button", { name: "Rename Session 1" }).click();
    await page.getByLabel("New name").fill("Oaks");
    await page.keyboard.press("Enter");
    await page.getByRole("button", { name: "Start breeding" }).click();
    await generation(1).waitFor();
    await page.getByRole("button", { name: /^Sessions/ }).click();
    expect(await page.getByRole("link", { name: "Export Oaks" }).getAttribute("href")).toBe("/projects/1/breeding/1/export?token=mock");
    await page.getByRole("button", { name: /^Oaks/ }).click();
    await page.getByRole("button", { name: "Sessions; this one is Oaks" }).click();
    await page.getByRole("button", { name: "Delete Oaks" }).click();
    expect(studio.server.room.sessions).toHaveLength(2);
    await page.getByRole("button", { name: "Delete", exact: true }).click();
    await expect.poll(() => studio.server.room.sessions.map((one) => one.name)).toEqual(["Session 2"]);
  });
});

describe("rating", () => {
  beforeEach(() => start());

  test("by thumbs, up and down from 0", async () => {
    await more(3).click();
    await more(3).click();
    await less(5).click();
    await expect.poll(() => [ratingOf(3), ratingOf(5), ratingOf(1)]).toEqual([2, -1, undefined]);
    await cell(3).getByRole("button", { name: /^3: \+2/ }).click();
    await expect.poll(() => ratingOf(3)).toBeUndefined();
  });

  test("by stars", async () => {
    await page.getByRole("button", { name: "Stars" }).click();
    await cell(2).getByRole("button", { name: "4 of 5 stars" }).click();
    await expect.poll(() => ratingOf(2)).toBe(1);
    expect(await cell(2).getByRole("button", { name: "4 of 5 stars" }).getAttribute("aria-pressed")).toBe("true");
  });

  test("by keys", async () => {
    await cell(1).focus();
    for (const key of ["5", "ArrowRight", "+", "ArrowDown", "1", "End", "-", "Home", "0"]) await page.keyboard.press(key);
    await expect.poll(() => [1, 2, 6, 12].map(ratingOf)).toEqual([undefined, 1, -2, -1]);
    expect(await page.evaluate(() => document.activeElement?.getAttribute("data-individual"))).toBe("1");
  });

  test("by the best and the worst", async () => {
    await page.getByRole("button", { name: "Best & worst" }).click();
    await page.getByRole("button", { name: "4 is the best" }).click();
    await page.getByRole("button", { name: "9 is the worst" }).click();
    await page.getByRole("button", { name: "7 is the best" }).click();
    await expect.poll(() => [4, 7, 9].map(ratingOf)).toEqual([undefined, 2, -2]);
  });

  test("by A against B, never the same two again", async () => {
    await page.getByRole("button", { name: "A or B" }).click();
    await page.getByRole("button", { name: /A is better/ }).click();
    await expect.poll(() => [1, 2].map(ratingOf)).toEqual([1, -1]);
    await page.getByRole("region", { name: "A: model 3" }).waitFor();
    await page.keyboard.press("ArrowRight");
    await expect.poll(() => [3, 4].map(ratingOf)).toEqual([-1, 1]);
    await page.getByRole("button", { name: /Alike/ }).click();
    const pairs = sent("compare").map((one) => [one.better, one.worse].sort().join());
    expect(new Set(pairs).size).toBe(pairs.length);
    await page.keyboard.press("Escape");
    expect(await cells().count()).toBe(12);
  });

  test("one at a time, beside the grid", async () => {
    await page.keyboard.press("o");
    const one = page.getByRole("region", { name: "Model 1", exact: true });
    await one.getByRole("button", { name: "1: a point more" }).click();
    await page.getByRole("button", { name: "Next model" }).click();
    await page.getByRole("region", { name: "Model 2", exact: true }).getByRole("button", { name: "2: a point less" }).click();
    await page.getByRole("button", { name: "Previous model" }).click();
    await one.waitFor();
    await expect.poll(() => [1, 2].map(ratingOf)).toEqual([1, -1]);
    expect(await cells().count()).toBe(12);
  });

  test("undo and redo are the room's own", async () => {
    await more(3).click();
    await expect.poll(() => ratingOf(3)).toBe(1);
    await page.keyboard.press("Control+z");
    await expect.poll(() => ratingOf(3)).toBeUndefined();
    await page.keyboard.press("Control+Shift+z");
    await expect.poll(() => ratingOf(3)).toBe(1);
    for (const keys of ["Control+z", "Control+Shift+z", "Control+z"]) await page.keyboard.press(keys);
    await expect.poll(() => [sent("undo_breeding").length, sent("redo_breeding").length, ratingOf(3)]).toEqual([3, 2, undefined]);
    expect(sent("undo")).toEqual([]);
  });

  test("copies keep their rating", async () => {
    await more(3).click();
    await page.keyboard.press("n");
    await generation(2).waitFor();
    expect(await cells().first().getAttribute("aria-label")).toContain("+1, copy");
  });
});

describe("editing", () => {
  beforeEach(() => start());

  test("sliders change the model while they move, as one step", async () => {
    const before = session().find(1)!.quantiles[4]!;
    const slider = page.getByRole("slider", { name: "angle" });
    await slider.focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowLeft");
    await expect.poll(() => session().find(1)!.quantiles[4]).toBeCloseTo(before - 0.025, 2);
    expect(new Set(sent("set_genes").map((one) => one.gesture)).size).toBe(1);
    await cell(1).focus();
    await page.keyboard.press("Control+z");
    await expect.poll(() => session().find(1)!.quantiles[4]).toBe(before);
  });

  test("draws and whole genes are locked, and stay locked in the next generation", async () => {
    await page.getByRole("button", { name: "Lock angle" }).click();
    await page.getByRole("button", { name: "Lock Leaves" }).click();
    await expect.poll(() => session().locked).toEqual([{ path: "Tree", index: 4 }, ...[0, 1, 2].map((index) => ({ path: "Tree/Leaves", index }))]);
    await page.keyboard.press("n");
    await generation(2).waitFor();
    await page.getByRole("button", { name: "Free angle" }).waitFor();
    await page.getByRole("button", { name: "Free angle" }).click();
    await expect.poll(() => session().locked).toHaveLength(3);
  });

  test("genes are copied from one and pasted into another", async () => {
    await page.getByRole("slider", { name: "angle" }).waitFor();
    await page.keyboard.press("c");
    await cell(2).click();
    await page.getByRole("button", { name: "Paste genes of 1" }).waitFor();
    await page.getByRole("slider", { name: "angle" }).waitFor();
    await page.keyboard.press("v");
    await expect.poll(() => session().find(2)!.quantiles).toEqual(session().find(1)!.quantiles);
  });

  test("more like this, keep, show in the editor", async () => {
    await cell(4).click();
    await page.getByRole("button", { name: "More like this" }).click();
    await generation(2).waitFor();
    await page.getByRole("group", { name: /What to do/ }).getByRole("button", { name: "Keep" }).click();
    await page.locator(".room-foot .favourite").waitFor();
    expect(sent("keep_individual")[0]!.picture!.length).toBeGreaterThan(200);
    await page.getByRole("button", { name: "In the editor" }).click();
    await page.getByRole("button", { name: "Select and move" }).waitFor();
    expect(sent("show_individual")).toHaveLength(1);
  });

  test("three parents are blended on a triangle, and the blend is kept", async () => {
    for (const id of [1, 2, 3]) {
      await cell(id).focus();
      await page.keyboard.press("x");
    }
    const triangle = page.getByRole("slider", { name: "How much of each parent" });
    const box = (await triangle.boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2, box.y + 4, { steps: 4 });
    await page.mouse.up();
    await expect.poll(() => sent("blend").at(-1)!.weights[0]).toBeGreaterThan(0.95);
    await triangle.focus();
    for (let i = 0; i < 4; ++i) await page.keyboard.press("ArrowDown");
    await expect.poll(() => sent("blend").at(-1)!.weights[0]).toBeLessThan(0.95);
    await page.getByRole("region", { name: "The blend" }).getByRole("button", { name: "Keep the blend" }).click();
    await expect.poll(() => cells().count()).toBe(13);
    expect(await cells().last().getAttribute("aria-label")).toContain("blended");
  });

  test("files of a model, and a species pack, are links with the token", async () => {
    await cell(5).click();
    await page.getByRole("button", { name: "As a file" }).click();
    expect(await page.getByRole("menuitem", { name: /GLB/ }).getAttribute("href")).toBe("/projects/1/breeding/1/model/5/glb?token=mock");
    await page.keyboard.press("Escape");
    await page.getByLabel("Relatives").fill("40");
    await page.keyboard.press("Tab");
    const pack = page.getByRole("link", { name: "Species pack of 40" });
    expect(await pack.getAttribute("href")).toBe("/projects/1/breeding/1/species/5/40/5000?token=mock");
    const [download] = await Promise.all([page.waitForEvent("download"), pack.click()]);
    expect(download.suggestedFilename()).toBe("species-5-40-5000");
  });
});

describe("history", () => {
  test("goes anywhere, branches, and knows ancestors", async () => {
    await start();
    await more(2).click();
    for (const number of [2, 3, 4]) {
      await page.getByRole("button", { name: "Next generation", exact: true }).click();
      await generation(number).waitFor();
    }
    await page.getByRole("button", { name: /^Generation 2:/ }).click();
    await generation(2).waitFor();
    await page.getByRole("button", { name: "Next generation", exact: true }).click();
    await generation(5).waitFor();
    expect(session().generations[4]!.parent).toBe(2);
    const [main, branch] = await Promise.all([3, 5].map((number) => page.getByRole("button", { name: new RegExp(`^Generation ${number}:`) }).boundingBox()));
    expect(branch!.y).toBeGreaterThan(main!.y);
    expect(branch!.x).toBeCloseTo(main!.x);
    await page.getByRole("tab", { name: "Ancestors" }).click();
    await page.getByRole("button", { name: /^2: Drawn anew/ }).click();
    await page.getByRole("region", { name: "Model 2", exact: true }).waitFor();
    await page.getByRole("button", { name: /Go to its generation, 1/ }).click();
    await generation(1).waitFor();
    await cell(1).focus();
    await page.keyboard.press("Control+z");
    await generation(5).waitFor();
  });

  test("a reload comes back into the session, and so does a lost connection", async () => {
    await start();
    await studio.server.stop();
    await page.getByText("Connection lost.", { exact: false }).waitFor();
    await studio.server.startAgain();
    await expect.poll(() => sent("open_breeding").length, { timeout: 20_000 }).toBe(1);
    await more(1).click();
    await expect.poll(() => ratingOf(1)).toBe(1);
    studio.complaints.length = 0; // browsers complain of refused connections
    await page.reload();
    await generation(1).waitFor();
    expect(sent("open_breeding")).toHaveLength(2);
    await page.getByRole("button", { name: "Model", exact: true }).click();
    await page.reload();
    await page.getByRole("button", { name: "Select and move" }).waitFor();
  });
});

describe("taste", () => {
  test("says what it is, why, and what it thinks of each", async () => {
    await start();
    await page.getByRole("tab", { name: "Settings" }).click();
    await page.getByLabel("Learn my taste").check();
    await page.getByText("wide crowns").waitFor();
    await page.getByRole("tab", { name: "Model 1" }).click();
    await page.getByText("for: a wide crown").waitFor();
    expect(await cell(4).getAttribute("aria-label")).toContain("Different");
  });
});

describe("movement", () => {
  test("rests for people who want less of it, and turns when they ask", async () => {
    await start();
    const frames = () => page.evaluate(() => new Promise<number>((done) => {
      const canvas = document.querySelector<HTMLCanvasElement>(".room-canvas canvas")!;
      const context = canvas.getContext("webgl2")!;
      const clear = context.clear.bind(context);
      let count = 0;
      context.clear = (mask) => {
        ++count;
        clear(mask);
      };
      setTimeout(() => {
        context.clear = clear;
        done(count);
      }, 600);
    }));
    await expect.poll(frames).toBe(0);
    await page.getByRole("button", { name: "Turn", exact: true }).click();
    expect(await frames()).toBeGreaterThan(2);
    await page.getByRole("button", { name: "Stand still" }).click();
    await expect.poll(frames).toBe(0);
  });
});
