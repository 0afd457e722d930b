// Nothing serious that axe-core finds, in the main states, dark and light.
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type { Browser, Page } from "playwright-core";
import { cursorAfter, launch, openStudio } from "./browser.ts";

const axe = readFileSync(fileURLToPath(new URL("../node_modules/axe-core/axe.min.js", import.meta.url)), "utf8");
let browser: Browser;
beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());

interface Found {
  id: string;
  impact: string | null;
  nodes: { target: unknown; failureSummary?: string }[];
}

async function faults(page: Page): Promise<string[]> {
  await page.evaluate(axe);
  const found = await page.evaluate(async () => {
    const result = await (window as unknown as { axe: { run(): Promise<{ violations: Found[]; passes: unknown[] }> } }).axe.run();
    return { violations: result.violations, passes: result.passes.length };
  });
  expect(found.passes).toBeGreaterThan(10);
  return found.violations
    .filter((one) => one.impact === "serious" || one.impact === "critical")
    .flatMap((one) => one.nodes.map((node) => `${one.id} ${JSON.stringify(node.target)} ${node.failureSummary?.split("\n")[1] ?? ""}`));
}

async function breed(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Breed", exact: true }).click();
  await page.getByRole("button", { name: "Start breeding" }).click();
  await page.getByRole("heading", { name: "Generation 1" }).waitFor();
}

const states: readonly [string, (page: Page) => Promise<unknown>][] = [
  ["as it opens", async () => undefined],
  ["with a curve selected, all panels open", async (page) => {
    await page.locator(".target-name").first().click();
    await page.getByRole("button", { name: "Limits" }).click();
    await page.getByRole("button", { name: "Density" }).click();
    await page.getByText("More settings").click();
  }],
  ["with a mesh selected and the brush", async (page) => {
    await page.locator(".target-name").nth(2).click();
    await page.getByRole("button", { name: "Paint a silhouette" }).click();
  }],
  ["with problems and a completion", async (page) => {
    await cursorAfter(page, "spawn Fork");
    await page.keyboard.type("x");
    await page.locator(".problems li").first().waitFor();
    await cursorAfter(page, "tone + 0.5");
    await page.keyboard.type("\n detail Le");
    await page.locator(".cm-tooltip-autocomplete").waitFor();
  }],
  ["with the projects", async (page) => {
    await page.locator(".project-button").click();
    await page.getByRole("button", { name: "Delete Box" }).click();
  }],
  ["with the keys", (page) => page.getByRole("button", { name: "Keys" }).click()],
  ["with the export menu", (page) => page.getByRole("button", { name: "Export" }).click()],
  ["in the breeding room, at its start", (page) => page.getByRole("button", { name: "Breed", exact: true }).click()],
  ["in the breeding room, with taste and ratings", async (page) => {
    await breed(page);
    for (const key of ["5", "ArrowRight", "1"]) await page.keyboard.press(key);
    await page.getByRole("tab", { name: "Settings" }).click();
    await page.getByLabel("Learn my taste").check();
    await page.getByText("You seem to like").waitFor();
    await page.getByRole("tab", { name: /^Model/ }).click();
    await page.getByText("for: a wide crown").waitFor();
  }],
  ["in the breeding room, one at a time, with ancestors", async (page) => {
    await breed(page);
    for (const key of ["5", "n"]) await page.keyboard.press(key);
    await page.getByRole("heading", { name: "Generation 2" }).waitFor();
    await page.getByRole("tab", { name: "Ancestors" }).click();
    await page.keyboard.press("o");
  }],
  ["in the breeding room, between A and B, with stars", async (page) => {
    await breed(page);
    await page.getByRole("button", { name: "Stars" }).click();
    await page.keyboard.press("p");
  }],
  ["in the breeding room, with a blend", async (page) => {
    await breed(page);
    for (const key of ["x", "ArrowRight", "x", "ArrowRight", "x"]) await page.keyboard.press(key);
    await page.getByRole("region", { name: "The blend" }).waitFor();
  }],
  ["with the log", async (page) => {
    await page.getByRole("tab", { name: "Log" }).click();
  }],
];

describe.each(["dark", "light"] as const)("%s", (scheme) => {
  test.each(states)("%s", async (_name, reach) => {
    const studio = await openStudio(browser, { width: 1280, height: 800 }, scheme);
    try {
      await reach(studio.page);
      expect(await faults(studio.page)).toEqual([]);
    } finally {
      await studio.close();
    }
  });
});
