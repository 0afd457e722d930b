// Debian's Chromium, and pages with a mock server or a real one of their own.
import { chromium, type Browser, type Page } from "playwright-core";
import type { Message } from "../src/api";
import { MockServer } from "../tests/mock_server.ts";
import { Program } from "./program.ts";

export async function launch(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
    headless: true,
    chromiumSandbox: false,
    args: ["--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
}

export interface Opened {
  page: Page;
  /** What the server said to the page, over reloads and lost connections too. */
  heard: Message[];
  /** Errors and warnings of the browser's console, and what was thrown. */
  complaints: string[];
}

/** A page of its own, that is watched from before it opens `url`. */
export async function openPage(browser: Browser, url: string, size = { width: 1280, height: 800 }, colorScheme: "dark" | "light" = "dark"): Promise<Opened> {
  const context = await browser.newContext({ viewport: size, colorScheme, reducedMotion: "reduce", acceptDownloads: true });
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on("console", (message) => {
    // Drivers that draw in software tell how slow they are.
    if (["error", "warning"].includes(message.type()) && !message.text().includes("GL Driver Message")) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(error.message));
  const heard: Message[] = [];
  page.on("websocket", (socket) => socket.on("framereceived", ({ payload }) => {
    if (typeof payload === "string") heard.push(JSON.parse(payload) as Message);
  }));
  await page.goto(url);
  return { page, heard, complaints };
}

export interface Studio extends Opened {
  server: MockServer;
  url: string;
  close(): Promise<void>;
}

/** The page with a mock server of its own. */
export async function openStudio(browser: Browser, size?: { width: number; height: number }, colorScheme?: "dark" | "light"): Promise<Studio> {
  const server = new MockServer();
  const url = await server.start();
  const { page, heard, complaints } = await openPage(browser, url, size, colorScheme);
  await page.locator(".cm-content").waitFor();
  await page.locator(".project-button", { hasText: /Bonsai|Box/ }).waitFor();
  return {
    page, heard, server, url, complaints,
    close: async () => {
      await page.context().close();
      await server.stop();
    },
  };
}

/** The page with the real program of its own, which shows the projects; nothing was opened yet. */
export async function openProgram(browser: Browser): Promise<Opened & { program: Program }> {
  const program = new Program();
  await program.start();
  const opened = await openPage(browser, program.url);
  opened.page.setDefaultTimeout(90_000);  // machines without a graphics card draw slowly
  return { ...opened, program };
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
