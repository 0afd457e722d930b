import { describe, expect, test } from "vitest";
import { ConnectionLost, RequestFailed } from "../../src/connection/connection";
import { EditQueue, type DocumentEdit } from "../../src/store/edit_queue";
import { FakeClock, settle } from "../fakes";

function make() {
  const clock = new FakeClock();
  const sent: { edit: DocumentEdit; done(): void; fail(error: Error): void }[] = [];
  const failed: string[] = [];
  const queue = new EditQueue({
    send: (edit) => new Promise((resolve, reject) => sent.push({ edit, done: resolve, fail: reject })),
    onFailed: (edit, text) => failed.push(`${edit.label}: ${text}`),
    later: clock.later,
  });
  queue.resume();
  return { clock, sent, failed, queue };
}

describe("edits on their way", () => {
  test("lie over what the server has until it confirms them", async () => {
    const { queue, sent } = make();
    queue.push({ label: "a", grammar: "1" });
    queue.push({ label: "b", scene: { seed: 2 } });
    queue.push({ label: "c", grammar: "3" });
    expect(queue.overlay.value).toEqual({ grammar: "3", scene: { seed: 2 } });
    expect(sent.map((one) => one.edit.label)).toEqual(["a"]);
    sent[0]!.done();
    await settle();
    expect(sent.map((one) => one.edit.label)).toEqual(["a", "b"]);
    sent[1]!.done();
    await settle();
    sent[2]!.done();
    await settle();
    expect(queue.overlay.value).toEqual({});
    expect(queue.size.value).toBe(0);
  });

  test("of one gesture become one while another is under way", async () => {
    const { queue, sent } = make();
    for (let i = 0; i < 50; ++i) queue.push({ label: "drag", gesture: "g", scene: { seed: i }, search: i === 7 });
    expect(sent).toHaveLength(1);
    sent[0]!.done();
    await settle();
    expect(sent).toHaveLength(2);
    expect(sent[1]!.edit).toEqual({ label: "drag", gesture: "g", scene: { seed: 49 }, search: true });
  });

  test("of different gestures stay apart", async () => {
    const { queue, sent } = make();
    queue.push({ label: "a", gesture: "1", scene: { seed: 1 } });
    queue.push({ label: "b", gesture: "2", scene: { seed: 2 } });
    queue.push({ label: "c", scene: { seed: 3 } });
    queue.push({ label: "d", scene: { seed: 4 } });
    queue.flush();
    expect(sent.map((one) => one.edit.label)).toEqual(["a", "b", "c", "d"]);
  });

  test("are held while typing goes on, and sent when it rests", () => {
    const { queue, sent, clock } = make();
    queue.push({ label: "t", gesture: "typing", grammar: "a" }, 150);
    clock.advance(100);
    queue.push({ label: "t", gesture: "typing", grammar: "ab" }, 150);
    clock.advance(149);
    expect(sent).toHaveLength(0);
    expect(queue.overlay.value.grammar).toBe("ab");
    clock.advance(1);
    expect(sent.map((one) => one.edit.grammar)).toEqual(["ab"]);
  });

  test("that are held go before what comes after them", () => {
    const { queue, sent } = make();
    queue.push({ label: "t", gesture: "typing", grammar: "a" }, 150);
    queue.push({ label: "s", scene: { seed: 1 } });
    queue.flush();
    expect(sent.map((one) => one.edit.label)).toEqual(["t", "s"]);
  });

  test("that are refused are taken back and told of", async () => {
    const { queue, sent, failed } = make();
    queue.push({ label: "a", grammar: "1" });
    sent[0]!.fail(new RequestFailed("too large"));
    await settle();
    expect(failed).toEqual(["a: too large"]);
    expect(queue.overlay.value).toEqual({});
  });

  test("are sent again, in order, after the connection was lost", async () => {
    const { queue, sent, failed } = make();
    queue.push({ label: "a", grammar: "1" });
    queue.push({ label: "b", grammar: "2" });
    queue.pause();
    sent[0]!.fail(new ConnectionLost());
    await settle();
    queue.push({ label: "c", grammar: "3" });
    expect(sent).toHaveLength(1);
    expect(queue.overlay.value.grammar).toBe("3");
    queue.resume();
    expect(sent.map((one) => one.edit.label)).toEqual(["a", "a"]);
    for (let i = 1; i < 4; ++i) {
      sent[i]!.done();
      await settle();
    }
    expect(sent.map((one) => one.edit.label)).toEqual(["a", "a", "b", "c"]);
    expect(failed).toEqual([]);
    expect(queue.size.value).toBe(0);
  });
});
