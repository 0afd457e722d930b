// The real server: the program that was built, with projects in a folder of its own.
import { spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const root = resolve(import.meta.dirname, "../..");

export class Program {
  readonly folder = mkdtempSync(join(tmpdir(), "espalier-e2e-"));
  private process: ChildProcess | null = null;
  url = "";

  /** Starts it on a free port, or again on `port`; the link that it prints is in `url`. */
  async start(port = 0): Promise<void> {
    const program = join(root, "build/espalier");
    if (!existsSync(program)) throw new Error(`${program} is not there: script/build espalier`);
    const child = spawn(program, ["studio", "--no-open", "--port", String(port), "--data", join(this.folder, "data.sqlite"), "--page", join(root, "build/studio-page")]);
    this.process = child;
    this.url = await new Promise((done, fail) => {
      let said = "";
      const hear = (bytes: Buffer) => {
        said += bytes.toString();
        const link = /http:\/\/\S+/.exec(said);
        if (link !== null) done(link[0]);
      };
      child.stdout.on("data", hear);
      child.stderr.on("data", hear);
      child.on("exit", (code) => fail(new Error(`espalier studio ended with ${code}: ${said}`)));
    });
  }

  get port(): number {
    return Number(new URL(this.url).port);
  }

  /** As if the machine had lost power. */
  async kill(): Promise<void> {
    const child = this.process!;
    if (child.exitCode !== null || child.signalCode !== null) return;
    const gone = new Promise((done) => child.once("exit", done));
    child.kill("SIGKILL");
    await gone;
  }

  /** As by Ctrl-C: milliseconds until it has ended. */
  async interrupt(): Promise<number> {
    const child = this.process!;
    const gone = new Promise((done) => child.once("exit", done));
    const began = performance.now();
    child.kill("SIGINT");
    await gone;
    return performance.now() - began;
  }

  async end(): Promise<void> {
    await this.kill();
    rmSync(this.folder, { recursive: true, force: true });
  }
}
