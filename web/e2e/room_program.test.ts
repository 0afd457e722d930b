// The breeding room with the real program behind it.
import { readFileSync } from "node:fs";
import { afterAll, afterEach, beforeAll, beforeEach, expect, test } from "vitest";
import type { Browser, Page } from "playwright-core";
import { launch, openProgram } from "./browser.ts";
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

const cell = (id: number) => page.locator(`[data-individual="${id}"]`);
const generation = (number: number) => page.getByRole("heading", { name: `Generation ${number}`, exact: true }).waitFor();

interface Beginning {
  classic?: boolean;
  mode?: string;
}
async function begin(sample: string, { classic, mode }: Beginning = {}): Promise<void> {
  await page.getByRole("dialog", { name: "Projects" }).locator(".samples").getByText(sample, { exact: true }).click();
  await page.locator(".project-button", { hasText: sample }).waitFor();
  await page.getByText(/\d+ parts/).waitFor();
  await page.getByRole("button", { name: "Breed", exact: true }).click();
  if (classic === true) await page.getByRole("radio", { name: /GenTree classic/ }).check();
  if (mode !== undefined) await page.getByLabel("You may").selectOption(mode);
  await page.getByRole("button", { name: "Start breeding" }).click();
  await generation(1);
}

test("a session: rate, breed, edit, lock, blend, branch, undo, export", async () => {
  await begin("Gentree");
  expect(await page.getByRole("gridcell").count()).toBe(12);
  await cell(2).focus();
  for (const key of ["+", "ArrowRight", "-"]) await page.keyboard.press(key);
  await cell(2).and(page.locator("[aria-label*='+1']")).waitFor();
  await page.keyboard.press("n");
  await generation(2);
  // The liked one is copied, with its rating.
  const copy = page.getByRole("gridcell", { name: /\+1, copy/ });
  await copy.waitFor();
  const slider = page.getByRole("slider", { name: "taper" }).first();
  const value = await slider.getAttribute("aria-valuetext");
  await slider.focus();
  await page.keyboard.press("Home");
  await page.getByRole("gridcell", { name: /edited by hand/ }).waitFor();
  await expect.poll(() => slider.getAttribute("aria-valuetext")).not.toBe(value);
  await page.getByRole("button", { name: "Lock taper" }).first().click();
  await page.getByRole("button", { name: "Free taper" }).first().waitFor();
  const shown = page.getByRole("gridcell");
  for (const at of [1, 2, 3]) {
    await shown.nth(at).focus();
    await page.keyboard.press("x");
  }
  await page.getByRole("region", { name: "The blend" }).getByRole("button", { name: "Keep the blend" }).click();
  await page.getByRole("gridcell", { name: /blended/ }).waitFor();
  await page.getByRole("button", { name: /^Generation 1:/ }).click();
  await generation(1);
  await page.getByRole("button", { name: "Next generation", exact: true }).click();
  await generation(3);
  await shown.first().focus();
  await page.keyboard.press("Control+z");
  await generation(1);
  await page.getByRole("button", { name: "As a file" }).click();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("menuitem", { name: /GLB/ }).click()]);
  expect(readFileSync((await file.path())!).subarray(0, 4).toString()).toBe("glTF");
  expect(complaints).toEqual([]);
});

test("a rating is there again after kill -9, and the page comes back into its session", async () => {
  await begin("Guided bonsai");
  await cell(4).getByRole("button", { name: "a point more" }).click();
  await cell(4).and(page.locator("[aria-label*='+1']")).waitFor();
  const { port } = program;
  await program.kill();
  await page.getByText("Connection lost.", { exact: false }).waitFor();
  await program.start(port);
  await page.locator(".connection").waitFor({ state: "detached" });
  await page.reload();
  await generation(1);
  await cell(4).and(page.locator("[aria-label*='+1']")).waitFor();
});

test("GenTree classic breeds twenty", async () => {
  await begin("Gentree", { classic: true });
  expect(await page.getByRole("gridcell").count()).toBe(20);
  await page.keyboard.press("+");
  await page.keyboard.press("n");
  await generation(2);
  expect(await page.getByRole("gridcell").count()).toBe(20);
  expect(complaints).toEqual([]);
});

// Section 4.3 of GenTree's paper: who may do what. Whatever it is, the next generation comes.
for (const [mode, mayRate, mayEdit] of [["rate_and_edit", true, true], ["rate", true, false], ["edit", false, true], ["neither", false, false]] as const) {
  test(`GenTree classic in the mode ${mode}`, async () => {
    await begin("Gentree", { classic: true, mode });
    await cell(2).focus();
    await page.keyboard.press("+");
    const rated = cell(2).and(page.locator("[aria-label*='+1']"));
    if (mayRate) await rated.waitFor();
    else await page.getByText("bred without ratings").first().waitFor();
    expect(await rated.count()).toBe(mayRate ? 1 : 0);
    const slider = page.getByRole("slider", { name: "taper" }).first();
    const edited = page.getByRole("gridcell", { name: /edited by hand/ });
    expect(await slider.isDisabled()).toBe(!mayEdit);
    if (mayEdit) {
      await slider.focus();
      await page.keyboard.press("Home");
      await edited.waitFor();
    }
    expect(await edited.count()).toBe(mayEdit ? 1 : 0);
    await cell(2).focus();
    await page.keyboard.press("n");
    await generation(2);
    expect(await page.getByRole("gridcell").count()).toBe(20);
    expect(complaints).toEqual([]);
  });
}

test("kill -9 while a generation is bred loses no rating", async () => {
  await begin("Gentree");
  for (const id of [1, 3, 4]) await cell(id).getByRole("button", { name: "a point more" }).click();
  for (const id of [1, 3, 4]) await cell(id).and(page.locator("[aria-label*='+1']")).waitFor();
  await cell(1).focus();
  await page.keyboard.press("n");
  const { port } = program;
  await program.kill();
  await program.start(port);
  await page.locator(".connection").waitFor({ state: "detached" });
  await page.reload();
  const shown = page.getByRole("gridcell");
  await shown.first().waitFor();
  // The generation is there or it is not; either way one can go back to the first, with all that was said of it.
  await page.getByRole("button", { name: /^Generation 1:/ }).click();
  await generation(1);
  for (const id of [1, 3, 4]) await cell(id).and(page.locator("[aria-label*='+1']")).waitFor();
  await cell(1).focus();
  await page.keyboard.press("n");
  await page.getByRole("heading", { name: /^Generation [23]$/ }).waitFor();
});

test("a session goes out as a file and comes in again, with its history; a file that is none is refused by name", async () => {
  await begin("Gentree");
  await cell(3).focus();
  await page.keyboard.press("+");
  await cell(3).and(page.locator("[aria-label*='+1']")).waitFor();
  await page.keyboard.press("n");
  await generation(2);
  await page.getByRole("button", { name: /^Sessions/ }).click();
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("link", { name: "Export Session 1" }).click()]);
  const bytes = readFileSync((await file.path())!);
  const take = async (name: string, buffer: Buffer) => {
    const [chooser] = await Promise.all([
      page.waitForEvent("filechooser"), page.getByRole("button", { name: "Import a session file" }).click()]);
    await chooser.setFiles({ name, mimeType: "application/json", buffer });
  };
  await take("half.breeding", bytes.subarray(0, bytes.length / 2));
  await page.getByText("half.breeding", { exact: false }).first().waitFor();
  await take(file.suggestedFilename(), bytes);
  await generation(2);
  // All of it: the copy of the one that was liked, the generation before, and its rating there.
  await page.getByRole("gridcell", { name: /\+1, copy/ }).waitFor();
  await page.getByRole("button", { name: /^Generation 1:/ }).click();
  await generation(1);
  await cell(3).and(page.locator("[aria-label*='+1']")).waitFor();
  await page.getByRole("button", { name: /^Sessions|^Session 1/ }).first().click();
  expect(await page.locator(".session-list li").count()).toBe(2);
});
