// The pictures of docs/breeding-room.md, from the real program: npm run pictures.
import { mkdirSync } from "node:fs";
import { resolve } from "node:path";
import type { Page } from "playwright-core";

const folder = resolve(import.meta.dirname, "../../docs/pictures/breeding");

/** In a page that shows the projects. */
export async function takeRoomPictures(page: Page): Promise<void> {
  mkdirSync(folder, { recursive: true });
  const shot = async (name: string) => {
    await page.waitForTimeout(1500);
    await page.screenshot({ path: `${folder}/${name}.png` });
    console.log(`docs/pictures/breeding/${name}.png`);
  };
  const project = async (sample: string) => {
    await page.getByRole("dialog", { name: "Projects" }).locator(".samples button", { hasText: sample }).first().click();
    await page.locator(".project-button", { hasText: sample }).waitFor();
    await page.getByText(/\d+ parts/).waitFor();
  };
  const drawn = () => page.waitForFunction(() => document.querySelector("[data-individual]") !== null && document.querySelector(".cell-words") === null);
  const generation = async (number: number) => {
    await page.getByRole("heading", { name: `Generation ${number}`, exact: true }).waitFor();
    await drawn();
  };
  const breed = async (number: number) => {
    await page.getByRole("button", { name: "Next generation", exact: true }).click();
    await generation(number);
  };
  const press = async (...keys: string[]) => {
    for (const key of keys) await page.keyboard.press(key);
  };
  await project("Arboretum");
  await page.getByRole("button", { name: "Breed", exact: true }).click();
  await shot("start");
  await page.getByRole("button", { name: "Start breeding" }).click();
  await generation(1);
  await press("ArrowRight", "+", "+", "ArrowRight", "-", "ArrowRight", "-", "ArrowDown", "+");
  await shot("grid");
  await breed(2);
  await press("Home", "o");
  await shot("one");
  await press("p");
  await shot("pair");
  await press("Escape", "Home", "x", "ArrowRight", "x", "ArrowRight", "ArrowRight", "x");
  await drawn();
  await shot("blend");
  await press("Escape");
  for (const number of [3, 4]) await breed(number);
  await page.getByRole("button", { name: /^Generation 2:/ }).click();
  await generation(2);
  await page.getByRole("tab", { name: "Settings" }).click();
  await page.getByLabel("Learn my taste").check();
  await breed(5);
  await page.getByRole("tab", { name: "Ancestors" }).click();
  await page.getByRole("gridcell").nth(3).click();
  await page.emulateMedia({ colorScheme: "light" });
  await shot("history");
}
