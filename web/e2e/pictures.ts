// Takes the pictures of docs/studio.md and docs/breeding-room.md from the real program: npm run pictures (after script/build and npm run build).
import { mkdirSync } from "node:fs";
import { resolve } from "node:path";
import { launch } from "./browser.ts";
import { Program } from "./program.ts";
import { takeRoomPictures } from "./room_pictures.ts";

const folder = resolve(import.meta.dirname, "../../docs/pictures/studio");
mkdirSync(folder, { recursive: true });
const program = new Program();
const browser = await launch();
try {
  await program.start();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "dark", reducedMotion: "reduce" });
  const page = await context.newPage();
  const idle = () => page.locator(".search-button", { hasText: "Search" }).waitFor({ timeout: 60_000 });
  const shot = async (name: string) => {
    await page.waitForTimeout(1500);
    await page.screenshot({ path: `${folder}/${name}.png` });
    console.log(`docs/pictures/studio/${name}.png`);
  };
  const begin = async (sample: string) => {
    await page.getByRole("dialog", { name: "Projects" }).getByText(sample, { exact: true }).click();
    await page.locator(".project-button", { hasText: sample }).waitFor();
    await page.getByText(/\d+ parts/).waitFor();
    await idle();
  };
  await page.goto(program.url);
  await page.getByRole("dialog", { name: "Projects" }).waitFor();
  await shot("projects");
  await begin("Guided bonsai");
  await page.locator(".target-name", { hasText: "Curve 1" }).click();
  await shot("curves");
  await page.keyboard.press("Control+o");
  await begin("Citadel");
  await page.emulateMedia({ colorScheme: "light" });
  const box = (await page.locator(".view-element canvas").first().boundingBox())!;
  await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
  await shot("volume");
  await page.emulateMedia({ colorScheme: "dark" });
  await page.keyboard.press("Control+o");
  await takeRoomPictures(page);
} finally {
  await browser.close();
  await program.end();
}
