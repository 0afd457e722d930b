import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import type { Browser } from "playwright-core";
import { cursorAfter, grammarOf, launch, openStudio, type Studio } from "./browser.ts";

let browser: Browser;
let studio: Studio;

beforeAll(async () => {
  browser = await launch();
});
afterAll(() => browser.close());
beforeEach(async () => {
  studio = await openStudio(browser);
});
afterEach(() => studio.close());

const problems = () => studio.page.locator(".problems li");

describe("the page", () => {
  test("loads under a strict policy, without a complaint", async () => {
    const { page, complaints } = studio;
    expect(await page.title()).toBe("Bonsai – Espalier studio");
    expect(await grammarOf(page)).toContain("rule Branch when");
    expect(await page.locator(".targets li").count()).toBe(3);
    await page.getByText("15 parts", { exact: false }).waitFor();
    await page.getByText("The grammar is sound.").waitFor();
    expect(complaints).toEqual([]);
    expect(page.url()).toContain("#project=1");
  });

  test("fits 1280 x 800 and keeps room for the view when panes are dragged", async () => {
    const { page } = studio;
    const overflow = () => page.evaluate(() => [document.documentElement.scrollWidth - innerWidth, document.documentElement.scrollHeight - innerHeight]);
    expect(await overflow()).toEqual([0, 0]);
    const line = page.getByRole("separator", { name: "Width of the grammar" });
    const box = (await line.boundingBox())!;
    await page.mouse.move(box.x + 2, 400);
    await page.mouse.down();
    await page.mouse.move(1200, 400, { steps: 5 });
    await page.mouse.up();
    expect((await page.locator(".middle").boundingBox())!.width).toBeGreaterThanOrEqual(340);
    expect(await overflow()).toEqual([0, 0]);
    await line.focus();
    const before = (await page.locator(".left").boundingBox())!.width;
    await page.keyboard.press("ArrowLeft");
    expect((await page.locator(".left").boundingBox())!.width).toBe(before - 16);
  });

  test("stands still while a search runs", async () => {
    const { page } = studio;
    // It is stopped by hand, however long the page takes to see it run.
    await page.getByRole("spinbutton", { name: "Time, number" }).fill("60");
    await page.keyboard.press("Enter");
    await page.evaluate(() => {
      (window as unknown as { shifts: number }).shifts = 0;
      new PerformanceObserver((list) => {
        for (const entry of list.getEntries()) (window as unknown as { shifts: number }).shifts += (entry as unknown as { value: number }).value;
      }).observe({ type: "layout-shift", buffered: false });
    });
    await page.locator(".view-element").focus();
    await page.keyboard.press("Space");
    await page.getByText("running").waitFor();
    await page.waitForFunction(() => document.querySelectorAll(".sparkline polyline")[0]!.getAttribute("points")!.split(" ").length > 20);
    await page.keyboard.press("Space");
    await page.locator(".search-button", { hasText: "Search" }).waitFor();
    expect(await page.evaluate(() => (window as unknown as { shifts: number }).shifts)).toBeLessThan(0.01);
    expect(studio.server.received.map((one) => one.kind)).toContain("stop_search");
  });
});

describe("the grammar", () => {
  test("shows a mistake and its mending", async () => {
    const { page } = studio;
    await cursorAfter(page, "spawn Fork");
    await page.keyboard.type("y");
    await problems().first().waitFor();
    expect(await problems().first().innerText()).toContain('no rule is called "Forky"');
    expect(await page.locator(".cm-lintRange-error").innerText()).toBe("Forky");
    await page.locator(".problem").first().click();
    expect(await page.evaluate(() => document.activeElement?.shadowRoot?.activeElement?.className)).toContain("cm-content");
    await cursorAfter(page, "spawn Forky");
    await page.keyboard.press("Backspace");
    await page.getByText("The grammar is sound.").waitFor();
    expect(await page.locator(".cm-lintRange-error").count()).toBe(0);
  });

  test("F8 goes to the next problem, F12 to a definition", async () => {
    const { page } = studio;
    await cursorAfter(page, "spawn Fork");
    await page.keyboard.type("y");
    await problems().first().waitFor();
    await cursorAfter(page, "grammar guided_tree");
    await page.keyboard.press("F8");
    await page.keyboard.type("Q");
    await page.getByText('no rule is called "Q"').waitFor();
    await cursorAfter(page, "  spawn Branc");
    await page.keyboard.press("F12");
    await page.keyboard.type("Bough");
    await page.waitForFunction(() => (document.querySelector(".grammar-editor")!.shadowRoot!.textContent ?? "").includes("rule Bough when"));
  });

  test("undo takes a burst of typing back at once, redo brings it again", async () => {
    const { page } = studio;
    const before = await grammarOf(page);
    await cursorAfter(page, "start Stem");
    await page.keyboard.type("\nconst one = 1");
    await page.getByRole("button", { name: "Undo: Edit grammar" }).waitFor();
    const after = await grammarOf(page);
    expect(after).toContain("start Stem\nconst one = 1\n");
    await page.keyboard.press("Control+z");
    await page.getByRole("button", { name: "Redo: Edit grammar" }).waitFor();
    expect(await grammarOf(page)).toBe(before);
    await page.keyboard.press("Control+Shift+Z");
    await page.getByRole("button", { name: "Undo: Edit grammar" }).waitFor();
    expect(await grammarOf(page)).toBe(after);
  });

  test("undo right after typing, before it was sent, takes it back too", async () => {
    const { page } = studio;
    const before = await grammarOf(page);
    await cursorAfter(page, "start Stem");
    await page.keyboard.type("xyz", { delay: 0 });
    await page.keyboard.press("Control+z");
    await page.getByRole("button", { name: "Redo:" }).waitFor();
    expect(await grammarOf(page)).toBe(before);
  });

  test("one history for all: undo in the grammar takes back what a panel did last", async () => {
    const { page } = studio;
    await page.getByRole("button", { name: "Delete Curve 2" }).click();
    await page.locator(".targets li").nth(2).waitFor({ state: "detached" });
    await page.locator(".cm-content").focus();
    await page.keyboard.press("Control+z");
    await page.locator(".targets li").nth(2).waitFor();
  });

  test("completes with the keyboard", async () => {
    const { page } = studio;
    await cursorAfter(page, "tone + 0.5");
    await page.keyboard.type("\ndetail Le");
    await page.locator(".cm-tooltip-autocomplete li", { hasText: "Leaf" }).waitFor();
    // For a moment after it has come up, a completion takes no keys: whoever types on meant something else.
    await page.waitForTimeout(200);
    await page.keyboard.press("Enter");
    expect(await grammarOf(page)).toContain("tone + 0.5\n  detail Leaf\n");
  });

  test("says which rule the cursor stands in, and asks for its reach", async () => {
    const { page, server } = studio;
    await cursorAfter(page, "rule Fork {");
    await expect.poll(() => server.received.filter((one) => one.kind === "ask_reach").at(-1)).toMatchObject({ rule: "Fork" });
  });

  test("takes a mesh that is dropped, and writes its line", async () => {
    const { page } = studio;
    await page.locator(".grammar").evaluate((pane) => {
      const data = new DataTransfer();
      data.items.add(new File(["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"], "Old Gate.obj"));
      for (const kind of ["dragover", "drop"]) pane.querySelector(".grammar-editor")!.dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true, composed: true }));
    });
    await page.getByText("Old-Gate.obj: 12 triangles, 1 × 1 × 1 m. The grammar calls it old_gate.").first().waitFor();
    expect(await grammarOf(page)).toContain('mesh old_gate = "Old-Gate.obj"\nattr tufts');
    await page.getByRole("tab", { name: /Files/ }).click();
    expect(await page.locator(".files tr").innerText()).toMatch(/Old-Gate\.obj\s+32 B\s+12 triangles, 1 × 1 × 1 m/);
  });
});

describe("panels", () => {
  test("numbers step with the keys, and one visit of a field is one step of undo", async () => {
    const { page, server } = studio;
    await page.locator(".target-name", { hasText: "Curve 1" }).click();
    await page.getByRole("spinbutton", { name: "Alignment" }).focus();
    for (let i = 0; i < 3; ++i) await page.keyboard.press("ArrowUp");
    await expect.poll(() => server.projects[0]!.now.scene.curves!.curve[0]!.alignment).toBe(3300);
    await page.getByRole("spinbutton", { name: "Alignment" }).blur();
    await page.keyboard.press("Control+z");
    await expect.poll(() => server.projects[0]!.now.scene.curves!.curve[0]!.alignment).toBe(3000);
    await expect.poll(() => page.getByRole("spinbutton", { name: "Alignment" }).inputValue()).toBe("3000");
  });

  test("attributes are sliders in groups, and a double click takes the grammar's value", async () => {
    const { page, server } = studio;
    const group = page.getByRole("group", { name: "Tree" });
    await group.getByLabel("Forks at most", { exact: true }).focus();
    await page.keyboard.press("ArrowLeft");
    await expect.poll(() => server.projects[0]!.now.scene.attributes!["forks"]).toBe(17);
    await group.getByText("Forks at most").dblclick();
    await expect.poll(() => server.projects[0]!.now.scene.attributes!["forks"]).toBeUndefined();
    await group.getByLabel("Leans", { exact: true }).focus();
    await page.keyboard.press("End");
    await expect.poll(() => server.projects[0]!.now.scene.attributes!["lean"]).toBe("40deg");
    await page.getByRole("group", { name: "Leaves" }).getByLabel("In tufts").check();
    await expect.poll(() => server.projects[0]!.now.scene.attributes!["tufts"]).toBe(true);
  });

  test("limits are a table", async () => {
    const { page, server } = studio;
    await page.getByRole("button", { name: "Limits" }).click();
    await page.getByLabel("height max").fill("4,5");
    await page.keyboard.press("Tab");
    await expect.poll(() => server.projects[0]!.now.scene.limits).toEqual({ genes: { min: 1, max: 2000 }, height: { max: 4.5 } });
    await page.getByLabel("height max").fill("");
    await page.keyboard.press("Tab");
    await expect.poll(() => server.projects[0]!.now.scene.limits).toEqual({ genes: { min: 1, max: 2000 } });
  });

  test("projects are made, renamed and deleted, not without a question", async () => {
    const { page, server } = studio;
    await page.keyboard.press("Control+o");
    const dialog = page.getByRole("dialog", { name: "Projects" });
    await dialog.getByLabel("Name", { exact: true }).fill("My own");
    await dialog.getByRole("button", { name: /Bonsai A tree/ }).click();
    await page.locator(".project-button", { hasText: "My own" }).waitFor();
    await dialog.waitFor({ state: "detached" });
    await page.keyboard.press("Control+o");
    await dialog.getByRole("button", { name: "Rename My own" }).click();
    await dialog.getByLabel("New name").fill("Mine");
    await page.keyboard.press("Enter");
    await dialog.getByRole("button", { name: "Delete Box" }).click();
    expect(server.projects).toHaveLength(3);
    await dialog.getByRole("button", { name: "Delete", exact: true }).click();
    await expect.poll(() => server.projects.map((one) => one.name)).toEqual(["Bonsai", "Mine"]);
    await page.keyboard.press("Escape");
    await dialog.waitFor({ state: "detached" });
  });

  test("exports are links of the project, with the token", async () => {
    const { page } = studio;
    const focused = () => page.evaluate(() => document.activeElement?.getAttribute("href"));
    await page.getByRole("button", { name: "Export" }).click();
    await expect.poll(focused).toBe("/projects/1/export/glb?token=mock");
    await page.keyboard.press("ArrowDown");
    await expect.poll(focused).toBe("/projects/1/export/lods?token=mock");
    await page.keyboard.press("Escape");
    expect(await page.getByRole("menu").count()).toBe(0);
  });

  test("favourites are kept, shown and dropped", async () => {
    const { page, server } = studio;
    await page.locator(".view-element").focus();
    await page.keyboard.press("k");
    await page.locator(".favourite").click();
    // The picture is one of parts before nothing.
    const seen = await page.locator(".favourite img").evaluate(async (image: HTMLImageElement) => {
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
      const paper = canvas.getContext("2d")!;
      paper.drawImage(image, 0, 0);
      const alphas = paper.getImageData(0, 0, canvas.width, canvas.height).data.filter((_, i) => i % 4 === 3);
      return { width: canvas.width, height: canvas.height, solid: alphas.filter((a) => a > 250).length / alphas.length, clear: alphas[0] };
    });
    expect(seen).toMatchObject({ width: 192, height: 144, clear: 0 });
    expect(seen.solid).toBeGreaterThan(0.01);
    await page.getByRole("button", { name: /Drop favourite/ }).click();
    await page.locator(".favourite").waitFor({ state: "detached" });
    expect(server.received.map((one) => one.kind)).toEqual(expect.arrayContaining(["keep_favourite", "show_favourite", "drop_favourite"]));
  });
});

describe("keys", () => {
  test("choose tools in the view, and are text in the grammar", async () => {
    const { page } = studio;
    await page.locator(".view-element").focus();
    await page.keyboard.press("c");
    const curve = page.getByRole("button", { name: "Draw a curve" });
    expect(await curve.getAttribute("aria-pressed")).toBe("true");
    await page.keyboard.press("Escape");
    expect(await curve.getAttribute("aria-pressed")).toBe("false");
    await cursorAfter(page, "start Stem");
    await page.keyboard.type("c");
    expect(await curve.getAttribute("aria-pressed")).toBe("false");
    expect(await grammarOf(page)).toContain("start Stemc");
  });

  test("? shows them all, Escape puts the sheet away", async () => {
    const { page } = studio;
    await page.locator(".view-element").focus();
    await page.keyboard.press("?");
    const sheet = page.getByRole("dialog", { name: "Keys" });
    await sheet.waitFor();
    expect(await sheet.locator("dl > div").count()).toBeGreaterThan(30);
    await page.keyboard.press("Escape");
    await sheet.waitFor({ state: "detached" });
  });

  test("Tab reaches everything and never gets caught outside of the grammar", async () => {
    const { page } = studio;
    await page.getByRole("separator", { name: "Width of the grammar" }).focus();
    const seen = new Set<string>();
    for (let i = 0; i < 150; ++i) {
      await page.keyboard.press("Tab");
      const name = await page.evaluate(() => {
        const element = document.activeElement as HTMLElement | null;
        return element === null || element === document.body ? "" : `${element.tagName} ${element.getAttribute("aria-label") ?? element.textContent ?? ""} ${element.id}`;
      });
      if (name === "") break;
      seen.add(name);
    }
    const text = [...seen].join("\n");
    for (const wanted of ["Select and move", "Keep", "Duplicate Curve 1", "Start", "Width of the panels", "Limits"]) expect(text).toContain(wanted);
  });

  test("switch between grammar and view", async () => {
    const { page } = studio;
    await page.locator(".view-element").focus();
    await page.keyboard.press("Control+e");
    expect(await page.evaluate(() => document.activeElement?.className)).toContain("grammar-editor");
    await page.keyboard.press("Control+e");
    expect(await page.evaluate(() => document.activeElement?.className)).toContain("view-element");
  });
});

describe("the theme", () => {
  test("follows the system until another is chosen, and is remembered", async () => {
    const { page } = studio;
    const theme = () => page.evaluate(() => document.documentElement.dataset["theme"]);
    const background = () => page.evaluate(() => getComputedStyle(document.querySelector(".right")!).backgroundColor);
    expect(await theme()).toBe("dark");
    const dark = await background();
    await page.emulateMedia({ colorScheme: "light" });
    await expect.poll(theme).toBe("light");
    expect(await background()).not.toBe(dark);
    await page.getByRole("button", { name: "Theme: system" }).click();
    await page.getByRole("button", { name: "Theme: light" }).click();
    expect(await theme()).toBe("dark");
    await page.reload();
    await page.locator(".cm-content").waitFor();
    expect(await theme()).toBe("dark");
    expect(await page.getByRole("button", { name: "Theme: dark" }).count()).toBe(1);
  });
});

describe("a lost connection", () => {
  test("is told calmly; what is typed meanwhile arrives when the server is back", async () => {
    const { page, server } = studio;
    await server.stop();
    await page.getByText("Connection lost.", { exact: false }).waitFor();
    await cursorAfter(page, "start Stem");
    await page.keyboard.type("\nconst late = 1");
    await page.getByText("One change waits.", { exact: false }).waitFor();
    await server.startAgain();
    await page.locator(".connection").waitFor({ state: "detached", timeout: 20_000 });
    await expect.poll(() => server.projects[0]!.now.grammar).toContain("const late = 1");
    expect(await grammarOf(page)).toContain("const late = 1");
  });
});
