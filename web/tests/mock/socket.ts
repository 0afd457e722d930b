// The server's half of a WebSocket (RFC 6455), as far as a mock needs it: text and binary messages in one frame each.
import { createHash } from "node:crypto";
import type { IncomingMessage } from "node:http";
import type { Duplex } from "node:stream";

export class MockSocket {
  onText: (text: string) => void = () => undefined;
  onClose: () => void = () => undefined;
  private buffer = Buffer.alloc(0);
  private parts: Buffer[] = [];
  private readonly stream: Duplex;

  constructor(request: IncomingMessage, stream: Duplex) {
    this.stream = stream;
    const key = request.headers["sec-websocket-key"] ?? "";
    const accept = createHash("sha1").update(`${key}258EAFA5-E914-47DA-95CA-C5AB0DC85B11`).digest("base64");
    stream.write(`HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Accept: ${accept}\r\n\r\n`);
    stream.on("data", (data: Buffer) => {
      this.buffer = Buffer.concat([this.buffer, data]);
      while (this.readFrame());
    });
    stream.on("error", () => undefined);
    stream.on("close", () => this.onClose());
  }

  sendText(text: string): void {
    this.send(1, Buffer.from(text));
  }

  sendBinary(data: ArrayBuffer): void {
    this.send(2, Buffer.from(data));
  }

  /** As a crash would. */
  cut(): void {
    this.stream.destroy();
  }

  private send(kind: number, data: Buffer): void {
    if (this.stream.destroyed) return;
    const long = data.length > 65535 ? 8 : data.length > 125 ? 2 : 0;
    const head = Buffer.alloc(2 + long);
    head[0] = 0x80 | kind;
    head[1] = long === 8 ? 127 : long === 2 ? 126 : data.length;
    if (long === 2) head.writeUInt16BE(data.length, 2);
    if (long === 8) head.writeBigUInt64BE(BigInt(data.length), 2);
    this.stream.write(Buffer.concat([head, data]));
  }

  private readFrame(): boolean {
    const { buffer } = this;
    if (buffer.length < 2) return false;
    let length = buffer[1]! & 127;
    let at = 2;
    if (length === 126) {
      if (buffer.length < 4) return false;
      length = buffer.readUInt16BE(2);
      at = 4;
    } else if (length === 127) {
      if (buffer.length < 10) return false;
      length = Number(buffer.readBigUInt64BE(2));
      at = 10;
    }
    if (buffer.length < at + 4 + length) return false;
    const mask = buffer.subarray(at, at + 4);
    const data = Buffer.from(buffer.subarray(at + 4, at + 4 + length));
    for (let i = 0; i < data.length; ++i) data[i]! ^= mask[i & 3]!;
    this.buffer = buffer.subarray(at + 4 + length);
    const kind = buffer[0]! & 15;
    if (kind === 8) this.stream.end();
    else if (kind <= 2) {
      this.parts.push(data);
      if (buffer[0]! & 0x80) {
        const text = Buffer.concat(this.parts).toString();
        this.parts = [];
        this.onText(text);
      }
    }
    return true;
  }
}
