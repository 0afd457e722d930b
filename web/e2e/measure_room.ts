// How much script a frame of the breeding room takes, with 20 turning trees: npm run frames. The machine must be quiet. What is
// measured is the time within the page's frame callbacks, of frames in which all 20 are drawn. Triangles themselves are left out
// (the call that draws a batch does nothing), because a browser without a graphics card draws them with the same processor, and
// waits for it; all else of the drawing is there.
import { launch, openStudio } from "./browser.ts";

const kSeconds = 10, kMost = 4, kTrees = 20;
const browser = await launch();
const studio = await openStudio(browser, { width: 1280, height: 800 });
try {
  const { page } = studio;
  await page.evaluate(() => {
    const { prototype } = WebGL2RenderingContext;
    const counts = ((window as unknown as { counts: object }).counts = { clears: 0, calls: 0 });
    const clear = prototype.clear;
    prototype.clear = function (mask) {
      ++counts.clears;
      clear.call(this, mask);
    };
    prototype.drawElementsInstanced = () => void ++counts.calls;
    const frame = window.requestAnimationFrame.bind(window);
    const taken: { milliseconds: number; clears: number; calls: number }[] = ((window as unknown as { taken: object[] }).taken = []) as never;
    // Frames are told to be 16 ms apart, so that the page never thinks that it should draw fewer trees in each.
    let told = 0;
    window.requestAnimationFrame = (action) => frame(() => {
      const { clears, calls } = counts, begin = performance.now();
      action((told += 16));
      taken.push({ milliseconds: performance.now() - begin, clears: counts.clears - clears, calls: counts.calls - calls });
    });
  });
  await page.getByRole("button", { name: "Breed", exact: true }).click();
  await page.getByRole("radio", { name: /GenTree classic/ }).check();
  await page.getByRole("button", { name: "Start breeding" }).click();
  await page.waitForFunction((trees) => document.querySelectorAll("[data-individual]").length === trees && document.querySelector(".cell-words") === null, kTrees);
  await page.getByRole("button", { name: "Turn", exact: true }).click();
  await page.waitForTimeout(1000 * kSeconds);
  const all = await page.evaluate(() => (window as unknown as { taken: { milliseconds: number; clears: number; calls: number }[] }).taken);
  const session = studio.server.room.open!;
  const parts = session.here.members.map((one) => session.model(one)[1].parts);
  // The first frames compile shaders and copy what is new.
  const steady = all.filter((one) => one.clears === kTrees).slice(5);
  const times = steady.map((one) => one.milliseconds).sort((a, b) => a - b);
  const at = (share: number) => times[Math.min(times.length - 1, Math.floor(share * times.length))] ?? Infinity;
  console.log(`${kTrees} trees of ${Math.min(...parts)} .. ${Math.max(...parts)} parts in ${steady[0]?.calls ?? 0} batches: ${times.length} whole frames of ${all.length} in ${kSeconds} s`);
  console.log(`script per frame: median ${at(0.5).toFixed(2)} ms, 95 % within ${at(0.95).toFixed(2)} ms, most ${at(1).toFixed(2)} ms (to be kept: ${kMost} ms)`);
  process.exitCode = at(0.5) <= kMost ? 0 : 1;
} finally {
  await studio.close();
  await browser.close();
}
