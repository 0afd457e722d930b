import { describe, expect, test } from "vitest";
import type { Message } from "../../src/api";
import { backoff } from "../../src/connection/backoff";
import { Connection, ConnectionLost, RequestFailed, type Status } from "../../src/connection/connection";
import { freeName } from "../../src/connection/files";
import { placeOf, projectOf, sessionOf, socketAddress, tokenOf } from "../../src/connection/link";
import { FakeClock, FakeSocket, settle } from "../fakes";

function make() {
  const clock = new FakeClock();
  const sockets: FakeSocket[] = [];
  const statuses: Status[] = [];
  const messages: Message[] = [];
  const binary: string[] = [];
  const nonsense: string[] = [];
  const connection = new Connection({
    open: () => {
      const socket = new FakeSocket();
      sockets.push(socket);
      return socket;
    },
    onStatus: (status) => statuses.push(status),
    onMessage: (message) => messages.push(message),
    onBinary: (kind, data) => binary.push(`${kind} ${data.byteLength}`),
    onNonsense: (text) => nonsense.push(text),
    later: clock.later,
    random: () => 1,
  });
  return { clock, sockets, statuses, messages, binary, nonsense, connection };
}

function binaryOf(letters: string, version: number, more = 0): ArrayBuffer {
  const data = new ArrayBuffer(8 + more);
  new Uint8Array(data).set([...letters].map((letter) => letter.charCodeAt(0)));
  new DataView(data).setUint32(4, version, true);
  return data;
}

describe("the link", () => {
  test("holds the token, the socket's address and the project", () => {
    expect(tokenOf("http://127.0.0.1:8137/?token=abc")).toBe("abc");
    expect(tokenOf("http://127.0.0.1:8137/")).toBe("");
    expect(socketAddress("http://127.0.0.1:8137/?token=a%20b&x=1#project=3", "a b")).toBe("ws://127.0.0.1:8137/socket?token=a+b");
    expect(socketAddress("https://localhost/", "t")).toBe("wss://localhost/socket?token=t");
    expect(projectOf("http://h/?token=1#project=12")).toBe(12);
    expect(projectOf("http://h/?token=1&project=4")).toBe(4);
    expect(projectOf("http://h/?token=1&project=4#project=5")).toBe(5);
    expect(projectOf("http://h/#project=1e9")).toBeNull();
    expect(projectOf("http://h/")).toBeNull();
    expect(sessionOf(`http://h/?token=1${placeOf(12, 7)}`)).toBe(7);
    expect(projectOf(`http://h/?token=1${placeOf(12, 7)}`)).toBe(12);
    expect(sessionOf(`http://h/${placeOf(12, null)}`)).toBeNull();
  });
});

describe("backoff", () => {
  test("doubles up to a limit and spreads over the upper half", () => {
    expect([0, 1, 2, 3].map((n) => backoff(n, 1))).toEqual([250, 500, 1000, 2000]);
    expect(backoff(100, 1)).toBe(8000);
    expect(backoff(100, 0)).toBe(4000);
  });
});

describe("the connection", () => {
  test("numbers requests and settles each by its own answer", async () => {
    const { connection, sockets } = make();
    connection.connect();
    sockets[0]!.onopen!();
    const first = connection.request({ kind: "undo" });
    const second = connection.request({ kind: "open_project", project: 9 });
    expect(sockets[0]!.sent).toEqual([{ kind: "undo", request: 1 }, { kind: "open_project", project: 9, request: 2 }]);
    sockets[0]!.say({ kind: "failed", request: 2, text: "there is no project 9" });
    sockets[0]!.say({ kind: "done", request: 1 });
    await expect(second).rejects.toThrow("there is no project 9");
    await expect(second).rejects.toBeInstanceOf(RequestFailed);
    await expect(first).resolves.toBeUndefined();
  });

  test("sorts text and binary, and survives nonsense", () => {
    const { connection, sockets, messages, binary, nonsense } = make();
    connection.connect();
    const socket = sockets[0]!;
    socket.onopen!();
    expect(socket.binaryType).toBe("arraybuffer");
    socket.say({ kind: "log", level: "info", text: "hello" });
    socket.sayBinary(binaryOf("ESPM", 1, 24));
    socket.sayBinary(binaryOf("ESPM", 2));
    socket.sayBinary(new ArrayBuffer(3));
    socket.onmessage!({ data: "{" });
    socket.onmessage!({ data: "[]" });
    socket.onmessage!({ data: "null" });
    expect(messages).toEqual([{ kind: "log", level: "info", text: "hello" }]);
    expect(binary).toEqual(["ESPM 32"]);
    expect(nonsense).toHaveLength(5);
  });

  test("a failure that nobody asked about is logged", () => {
    const { connection, sockets, messages } = make();
    connection.connect();
    sockets[0]!.onopen!();
    sockets[0]!.say({ kind: "failed", text: "what?" });
    expect(messages).toEqual([{ kind: "log", level: "error", text: "what?" }]);
  });

  test("opens again after a loss, later and later, and says so", async () => {
    const { connection, sockets, statuses, clock } = make();
    connection.connect();
    sockets[0]!.onopen!();
    const lost = connection.request({ kind: "undo" });
    sockets[0]!.onclose!();
    await expect(lost).rejects.toBeInstanceOf(ConnectionLost);
    await expect(connection.request({ kind: "redo" })).rejects.toBeInstanceOf(ConnectionLost);
    expect(statuses.at(-1)).toEqual({ kind: "waiting", attempt: 1, milliseconds: 250 });
    clock.advance(249);
    expect(sockets).toHaveLength(1);
    clock.advance(1);
    expect(sockets).toHaveLength(2);
    sockets[1]!.onclose!();
    expect(statuses.at(-1)).toEqual({ kind: "waiting", attempt: 2, milliseconds: 500 });
    clock.advance(500);
    sockets[2]!.onopen!();
    expect(statuses.at(-1)).toEqual({ kind: "open" });
    sockets[2]!.onclose!();
    expect(statuses.at(-1)).toEqual({ kind: "waiting", attempt: 1, milliseconds: 250 });
  });

  test("closed for good it stays closed", async () => {
    const { connection, sockets, clock, statuses } = make();
    connection.connect();
    sockets[0]!.onopen!();
    connection.close();
    await settle();
    clock.advance(1e6);
    expect(sockets).toHaveLength(1);
    expect(statuses.at(-1)).toEqual({ kind: "closed" });
  });
});

test("names of files are plain and free", () => {
  expect(freeName("My tree.OBJ", [])).toBe("My-tree.obj");
  expect(freeName("a.obj", ["a.obj", "a-2.obj"])).toBe("a-3.obj");
  expect(freeName("../../etc/passwd", [])).toBe("etc-passwd");
  expect(freeName("..", [])).toBe("file");
  expect(freeName("日本.glb", [])).toBe("file.glb");
  expect(freeName(`${"x".repeat(500)}.stl`, []).length).toBe(64);
});
