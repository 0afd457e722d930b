// A server that talks like the studio's (docs/studio-protocol.md) but searches nothing: for looking at the page and for its
// tests in a browser. `npm run mock` starts it on port 8137 with the page that `npm run build` made.
import { existsSync, readFileSync } from "node:fs";
import { createServer, type IncomingMessage, type ServerResponse } from "node:http";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";
import type { Document, Gene, Message, Request, SearchState, Shown } from "../src/api";
import { boxMeshes, model } from "./mock/model.ts";
import { MockProject } from "./mock/project.ts";
import { MockRoom, type Voice } from "./mock/room.ts";
import { EMPTY, TREE, TREE_SCENE } from "./mock/samples.ts";
import { MockSocket } from "./mock/socket.ts";

const kPage = fileURLToPath(new URL("../../build/studio-page/", import.meta.url));
const kTypes: Record<string, string> = { ".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css" };
/** The page must live with this: no inline scripts or styles, nothing from elsewhere. */
export const kPolicy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self'; base-uri 'none'; form-action 'none'";

export class MockServer {
  readonly token = "mock";
  readonly received: Request[] = [];
  /** The page opens the newest: always the first. */
  projects: MockProject[] = [new MockProject(1, "Bonsai", TREE, TREE_SCENE), Object.assign(new MockProject(2, "Box", EMPTY, {}), { changed: Date.now() / 1000 - 60 })];
  readonly room = new MockRoom();
  private sockets = new Map<MockSocket, number | null>();
  private voices = new Map<MockSocket, Voice>();
  private server = createServer((request, response) => this.http(request, response));
  private port = 0;
  private models = 0;
  private favourites = 0;
  private readonly dropped: Document["favourites"][number][] = [];
  private locked = new Set<number>();
  private search: SearchState = { kind: "search_state", running: false, engine: "guided", steps: 0, evaluations: 0, seconds: 0, rises: [], onward: false };
  private timer: ReturnType<typeof setInterval> | null = null;

  async start(port = 0): Promise<string> {
    this.server.on("upgrade", (request, stream) => {
      if (new URL(request.url ?? "", "http://x").searchParams.get("token") !== this.token) {
        stream.end("HTTP/1.1 403 Forbidden\r\n\r\n");
        return;
      }
      const socket = new MockSocket(request, stream);
      this.sockets.set(socket, null);
      socket.onText = (text) => this.receive(socket, JSON.parse(text) as Request);
      const voice: Voice = { say: (message) => this.say(socket, message), bytes: (data) => socket.sendBinary(data) };
      this.voices.set(socket, voice);
      socket.onClose = () => {
        this.sockets.delete(socket);
        this.voices.delete(socket);
        this.room.inside.delete(voice);
      };
      this.sendProjects(socket);
    });
    await new Promise<void>((resolve) => this.server.listen(port, "127.0.0.1", resolve));
    const address = this.server.address();
    this.port = typeof address === "object" && address !== null ? address.port : port;
    return `http://127.0.0.1:${this.port}/?token=${this.token}`;
  }

  /** As a crash: sockets are cut, and nobody listens. */
  async stop(): Promise<void> {
    if (this.timer !== null) clearInterval(this.timer);
    for (const socket of this.sockets.keys()) socket.cut();
    this.server.closeAllConnections();
    await new Promise<void>((resolve) => this.server.close(() => resolve()));
  }

  /** After `stop`, at the same port, with the same projects. */
  async startAgain(): Promise<void> {
    const listeners = this.server.listeners("upgrade");
    this.server = createServer((request, response) => this.http(request, response));
    for (const listener of listeners) this.server.on("upgrade", listener as () => void);
    await new Promise<void>((resolve) => this.server.listen(this.port, "127.0.0.1", resolve));
  }

  private http(request: IncomingMessage, response: ServerResponse): void {
    const url = new URL(request.url ?? "/", "http://x");
    const file = /^\/projects\/(\d+)\/files\/(.+)$/.exec(url.pathname);
    if (request.method === "POST" && file !== null) {
      let bytes = 0;
      request.on("data", (data: Buffer) => (bytes += data.length));
      request.on("end", () => {
        const project = this.projects.find((one) => one.id === Number(file[1]));
        if (request.headers["x-espalier-token"] !== this.token || project === undefined) return void response.writeHead(403).end("no");
        const path = decodeURIComponent(file[2]!);
        project.files = [...project.files, { path, bytes, ...(/\.(png|jpg)$/.test(path) ? {} : { triangles: 12, size: [1, 1, 1] }) }];
        project.touch();
        this.broadcast(project);
        response.end(path);
      });
      return;
    }
    const bred = /^\/projects\/\d+\/breeding\/\d+\/(export|model\/\d+\/\w+|species\/\d+\/\d+\/\d+)$/.exec(url.pathname);
    if (bred !== null && url.searchParams.get("token") === this.token) {
      const name = bred[1]!.replace(/\//g, "-");
      return void response.writeHead(200, { "Content-Type": "application/octet-stream", "Content-Disposition": `attachment; filename="${name}"` }).end(name);
    }
    const favourite = /^\/projects\/(\d+)\/favourites\/(\d+)$/.exec(url.pathname);
    const picture = favourite && this.projects.find((one) => one.id === Number(favourite[1]))?.pictures.get(Number(favourite[2]));
    if (picture) return void response.writeHead(200, { "Content-Type": "image/webp" }).end(picture);
    if (/^\/projects\/\d+\/meshes\//.test(url.pathname)) return void response.writeHead(200).end(Buffer.from(boxMeshes()));
    if (file !== null || url.pathname.includes("/export/")) return void response.writeHead(404).end();
    const path = normalize(url.pathname === "/" ? "/index.html" : url.pathname);
    const full = join(kPage, path);
    if (!full.startsWith(kPage) || !existsSync(full)) return void response.writeHead(404).end();
    response.writeHead(200, { "Content-Type": kTypes[extname(full)] ?? "application/octet-stream", "Content-Security-Policy": kPolicy });
    response.end(readFileSync(full));
  }

  private say(socket: MockSocket, message: Message): void {
    socket.sendText(JSON.stringify(message));
  }

  private sendProjects(only?: MockSocket): void {
    const message: Message = {
      kind: "projects", version: "mock", projects: this.projects.map((one) => one.info()),
      samples: [
        { name: "bonsai", title: "Bonsai", words: "A tree along three curves." },
        { name: "city", title: "City", words: "Buildings on lots that fill a castle." },
        { name: "spaceship", title: "Spaceship", words: "Boxes that fill a cruiser." },
      ],
    };
    for (const socket of only === undefined ? this.sockets.keys() : [only]) this.say(socket, message);
  }

  private broadcast(project: MockProject): void {
    for (const [socket, id] of this.sockets)
      if (id === project.id) {
        this.say(socket, project.document());
        this.say(socket, project.checked());
      }
  }

  private show(project: MockProject): void {
    const number = ++this.models;
    const count = 14 + (number % 5);
    const hasTargets = project.now.scene.curves !== undefined;
    const shown: Shown = {
      kind: "shown", model: number, genes: count, parts: count, bones: count, words: "all of 2 curves, 81 % of their segments used",
      terms: hasTargets
        ? [
            { target: "curves", name: "utilisation", count: 34, of: 42, unit: "segments", value: 30620 + 100 * (number % 5) },
            { target: "curves", name: "alignment", count: 14, of: 14, unit: "bones", value: 4211 },
            { target: "curves", name: "distance", count: 14, of: 14, unit: "bones", value: -2875.25 },
            { target: "sphere", name: "avoided", count: 12, of: 900, unit: "voxels", value: -24 },
          ]
        : [],
      rules: ["Stem", "Branch", "Fork"], locked: [...this.locked], truncated: false, ...(hasTargets ? { score: 31931.75 + 100 * (number % 5) } : {}),
    };
    for (const [socket, id] of this.sockets)
      if (id === project.id) {
        if (number === 1 || count === 14) socket.sendBinary(boxMeshes());
        socket.sendBinary(model(number, count, (number % 20) / 20));
        this.say(socket, shown);
      }
  }

  private gene(number: number): Gene {
    const text = this.projects[0]!.now.grammar;
    const from = text.indexOf("rule Branch");
    return {
      kind: "gene", model: this.models, gene: number, rule: "Branch", path: `Stem/Branch${"/Fork/Branch".repeat(number)}`, at: { from, to: text.indexOf("\n}", from) + 2 },
      below: 13 - number, locked: this.locked.has(number),
      draws: [
        { name: "grow", index: 0, quantile: 0.25, value: "1", low: "0.9", high: "1.3" },
        { name: "spin", index: 1, quantile: 0.6, value: "216deg", low: "0deg", high: "360deg" },
        { name: "bend", index: 2, quantile: 0.1, value: "8deg", low: "0deg", high: "80deg" },
      ],
    };
  }

  private runSearch(project: MockProject, seconds: number): void {
    if (this.timer !== null) clearInterval(this.timer);
    const begin = Date.now();
    this.search = { ...this.search, running: true, evaluations: 0, seconds: 0, rises: [], onward: false };
    this.timer = setInterval(() => {
      const passed = (Date.now() - begin) / 1000;
      const best = 32000 * (1 - Math.exp(-3 * passed / seconds));
      const over = passed >= seconds;
      this.search = {
        ...this.search, seconds: passed, evaluations: Math.round(passed * 21500), steps: Math.round(passed * 400), best, running: !over, onward: over,
        rises: [...this.search.rises, [passed, best] as [number, number]].slice(-200),
      };
      if (over) clearInterval(this.timer!);
      this.show(project);
      for (const [socket, id] of this.sockets) if (id === project.id) this.say(socket, this.search);
    }, 60);
  }

  private receive(socket: MockSocket, message: Request): void {
    this.received.push(message);
    const request = message.request === undefined ? {} : { request: message.request };
    const done = () => this.say(socket, { kind: "done", ...request });
    const failed = (text: string) => this.say(socket, { kind: "failed", text, ...request });
    const project = this.projects.find((one) => one.id === this.sockets.get(socket));
    const named = "project" in message ? this.projects.find((one) => one.id === message.project) : undefined;
    if ("project" in message && named === undefined) return failed(`there is no project ${message.project}`);
    switch (message.kind) {
      case "list_projects":
        this.sendProjects(socket);
        return done();
      case "open_project":
        this.sockets.set(socket, named!.id);
        this.broadcast(named!);
        this.say(socket, this.search);
        this.show(named!);
        this.say(socket, this.room.list());
        return done();
      case "create_project": {
        const made = new MockProject(Math.max(0, ...this.projects.map((one) => one.id)) + 1, message.name, message.sample ? TREE : EMPTY, message.sample ? TREE_SCENE : {});
        this.projects.push(made);
        this.sendProjects();
        return done();
      }
      case "rename_project":
        named!.name = message.name;
        this.sendProjects();
        this.broadcast(named!);
        return done();
      case "duplicate_project":
        this.projects.push(new MockProject(this.projects.length + 10, `${named!.name} copy`, named!.now.grammar, named!.now.scene));
        this.sendProjects();
        return done();
      case "delete_project":
        this.projects = this.projects.filter((one) => one !== named);
        this.sendProjects();
        return done();
      default:
        break;
    }
    if (project === undefined) return failed("no project is open");
    const bred = this.room.handle(message, this.voices.get(socket)!, (said) => [...this.sockets.keys()].forEach((one) => this.say(one, said)));
    if (bred !== null && bred !== "") return failed(bred);
    if (message.kind === "keep_individual") {
      const id = Date.now(), picture = message.picture !== undefined;
      if (message.picture !== undefined) project.pictures.set(id, Buffer.from(message.picture, "base64"));
      project.favourites = [...project.favourites, { id, score: 0, genes: 2, words: `from the breeding room: ${message.individual}`, picture }];
      project.touch();
      this.broadcast(project);
    }
    if (bred !== null) return done();
    switch (message.kind) {
      case "edit":
        project.edit(message.label, message.gesture, message.grammar, message.scene);
        this.broadcast(project);
        if (message.scene !== undefined && project.checked().problems.length === 0) this.show(project);
        return done();
      case "undo":
      case "redo":
        if (!project[message.kind]()) return failed(`there is nothing to ${message.kind}`);
        this.broadcast(project);
        return done();
      case "format":
        if (project.checked().problems.some((one) => one.severity === "error")) return failed("a grammar with errors is not formatted");
        project.edit("Format", undefined, project.now.grammar.replace(/[ \t]+$/gm, ""), undefined);
        this.broadcast(project);
        return done();
      case "start_search":
        this.runSearch(project, message.seconds);
        return done();
      case "stop_search":
        if (this.timer !== null) clearInterval(this.timer);
        this.search = { ...this.search, running: false, onward: true };
        this.say(socket, this.search);
        return done();
      case "ask_gene":
        this.say(socket, this.gene(message.gene ?? message.path!.split("/Fork/").length - 1));
        return done();
      case "set_draw":
      case "set_lock":
        if (message.kind === "set_lock") this.locked[message.locked ? "add" : "delete"](message.gene);
        this.show(project);
        return done();
      case "keep_favourite":
        project.favourites = [...project.favourites, { id: ++this.favourites, score: 31931.75, genes: 14, words: "all of 2 curves", picture: message.picture !== undefined }];
        if (message.picture !== undefined) project.pictures.set(this.favourites, Buffer.from(message.picture, "base64"));
        project.touch();
        this.broadcast(project);
        return done();
      case "restore_favourite":
        project.favourites = [...project.favourites, this.dropped.find((one) => one.id === message.favourite)!];
        project.touch();
        this.broadcast(project);
        return done();
      case "drop_favourite":
        this.dropped.push(...project.favourites.filter((one) => one.id === message.favourite));
        project.favourites = project.favourites.filter((one) => one.id !== message.favourite);
        project.touch();
        this.broadcast(project);
        return done();
      case "remove_file":
        project.files = project.files.filter((one) => one.path !== message.path);
        project.touch();
        this.broadcast(project);
        return done();
      default:
        return done();
    }
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) console.log(await new MockServer().start(8137));
