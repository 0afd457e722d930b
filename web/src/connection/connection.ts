// The WebSocket to the server: opens it again when it is lost, numbers requests and answers them as promises, and sorts what
// comes by text and binary.
import type { Message, Request } from "../api";
import { backoff } from "./backoff";

/** What of a WebSocket is needed: tests bring their own. */
export interface Socket {
  binaryType: string;
  onopen: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  onclose: (() => void) | null;
  send(text: string): void;
  close(): void;
}

export type Status =
  | { kind: "connecting" }
  | { kind: "open" }
  | { kind: "waiting"; attempt: number; milliseconds: number }
  | { kind: "closed" };

type Unnumbered<T> = T extends Request ? Omit<T, "request"> : never;
/** A request without its number. */
export type Ask = Unnumbered<Request>;

/** Of binary messages, by the letters that they begin with; 1 unless it is said here. */
const kVersions: Readonly<Record<string, number>> = { ESPI: 2 };

/** The server said no; nothing was changed. */
export class RequestFailed extends Error {}
/** Nobody knows whether the request arrived. */
export class ConnectionLost extends Error {
  constructor() {
    super("The connection to the server was lost.");
  }
}

export interface ConnectionOptions {
  open(): Socket;
  onStatus(status: Status): void;
  onMessage(message: Message): void;
  /** `kind`: the four letters that it begins with. */
  onBinary(kind: string, data: ArrayBuffer): void;
  /** Something that is no message of ours. */
  onNonsense(text: string): void;
  later(milliseconds: number, action: () => void): () => void;
  random(): number;
}

interface Waiting {
  resolve(): void;
  reject(error: Error): void;
}

export class Connection {
  private socket: Socket | null = null;
  private ready = false;
  private closed = false;
  private attempt = 0;
  private cancelRetry: (() => void) | null = null;
  private nextRequest = 1;
  private readonly waiting = new Map<number, Waiting>();

  constructor(private readonly options: ConnectionOptions) {}

  connect(): void {
    if (this.closed || this.socket !== null) return;
    this.cancelRetry?.();
    this.cancelRetry = null;
    this.options.onStatus({ kind: "connecting" });
    const socket = this.options.open();
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.ready = true;
      this.attempt = 0;
      this.options.onStatus({ kind: "open" });
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => {
      if (this.socket === socket) this.lost();
    };
  }

  /** Resolves when the server says done. Rejects with RequestFailed or ConnectionLost. */
  request(ask: Ask): Promise<void> {
    if (this.socket === null || !this.ready) return Promise.reject(new ConnectionLost());
    const request = this.nextRequest++;
    const text = JSON.stringify({ ...ask, request });
    return new Promise((resolve, reject) => {
      this.waiting.set(request, { resolve, reject });
      this.socket!.send(text);
    });
  }

  /** For good. */
  close(): void {
    this.closed = true;
    this.cancelRetry?.();
    const socket = this.socket;
    this.socket = null;
    this.ready = false;
    socket?.close();
    this.rejectAll();
    this.options.onStatus({ kind: "closed" });
  }

  private lost(): void {
    this.socket = null;
    this.ready = false;
    if (this.closed) return;
    const milliseconds = backoff(this.attempt, this.options.random());
    this.attempt += 1;
    this.options.onStatus({ kind: "waiting", attempt: this.attempt, milliseconds });
    this.cancelRetry = this.options.later(milliseconds, () => this.connect());
    this.rejectAll();
  }

  private rejectAll(): void {
    const all = [...this.waiting.values()];
    this.waiting.clear();
    for (const one of all) one.reject(new ConnectionLost());
  }

  private receive(data: unknown): void {
    if (data instanceof ArrayBuffer) {
      if (data.byteLength < 8) return this.options.onNonsense("a binary message of less than 8 bytes");
      const kind = String.fromCharCode(...new Uint8Array(data, 0, 4));
      const version = new DataView(data).getUint32(4, true);
      if (version !== (kVersions[kind] ?? 1)) return this.options.onNonsense(`a binary message ${kind} of version ${version}`);
      this.options.onBinary(kind, data);
      return;
    }
    let message: Message;
    try {
      message = JSON.parse(String(data)) as Message;
    } catch {
      return this.options.onNonsense("a text message that is no JSON");
    }
    if (message === null || typeof message !== "object" || typeof message.kind !== "string")
      return this.options.onNonsense("a message without a kind");
    if (message.kind === "done" || message.kind === "failed") this.answer(message);
    else this.options.onMessage(message);
  }

  private answer(message: { kind: "done"; request?: number } | { kind: "failed"; request?: number; text: string }): void {
    const one = message.request === undefined ? undefined : this.waiting.get(message.request);
    if (message.request !== undefined) this.waiting.delete(message.request);
    if (message.kind === "done") one?.resolve();
    else if (one) one.reject(new RequestFailed(message.text));
    else this.options.onMessage({ kind: "log", level: "error", text: message.text });
  }
}
