// Debian's Chromium and a page with a mock server of its own.
import { chromium, type Browser, type Page } from "playwright-core";
import { MockServer } from "../tests/mock_server.ts";

export async function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
    headless: true,
    chromiumSandbox: false,
    args: ["--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
}

export interface Studio {
  page: Page;
  server: MockServer;
  url: string;
  /** Errors and warnings of the browser's console, and what was thrown. */
  complaints: string[];
  close(): Promise<void>;
}

export async function openStudio(browser: Browser, size = { width: 1280, height: 800 }, colorScheme: "dark" | "light" = "dark"): Promise<Studio> {
  const server = new MockServer();
  const url = await server.start();
  const context = await browser.newContext({ viewport: size, colorScheme, reducedMotion: "reduce" });
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on("console", (message) => {
    // Drivers that draw in software tell how slow they are.
    if (["error", "warning"].includes(message.type()) && !message.text().includes("GL Driver Message")) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  await page.goto(url);
  await page.locator(".cm-content").waitFor();
  await page.locator(".project-button", { hasText: /Bonsai|Box/ }).waitFor();
  return {
    page, server, url, complaints,
    close: async () => {
      await context.close();
      await server.stop();
    },
  };
}

/** The grammar as the editor shows it. */
export function grammarOf(page: Page): Promise<string> {
  return page.locator(".cm-content").evaluate((content) => (content as unknown as { cmTile: { view: { state: { doc: { toString(): string } } } } }).cmTile.view.state.doc.toString());
}

/** Puts the cursor behind a text of the grammar, as soon as the editor has it. */
export async function cursorAfter(page: Page, text: string): Promise<void> {
  await page.locator(".cm-content").focus();
  await page.locator(".cm-content").evaluate(async (content, needle) => {
    const { view } = (content as unknown as { cmTile: { view: { state: { doc: { toString(): string } }; dispatch(change: object): void } } }).cmTile;
    const find = () => view.state.doc.toString().indexOf(needle);
    for (let tries = 0; find() < 0 && tries < 200; ++tries) await new Promise((done) => setTimeout(done, 50));
    const at = find();
    if (at < 0) throw new Error(`the grammar has no ${needle}`);
    view.dispatch({ selection: { anchor: at + needle.length }, scrollIntoView: true });
  }, text);
}
