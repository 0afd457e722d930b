// What the view says in words: complaints, seen by all, and what happened, for those who do not see the view.
import type { Camera } from "../api";
import type { StudioView } from "./host";
import { MessageError } from "./messages";
import type { Palette, Rgb } from "./palette";

const css = (c: Rgb): string => `rgb(${c.map((x) => Math.round(255 * x)).join(" ")})`;

export class Notices {
  private readonly box = document.createElement("div");
  private timer = 0;
  private readonly live = document.createElement("div");

  constructor(parent: HTMLElement) {
    this.box.className = "view-notice";
    this.box.setAttribute("role", "status");
    this.box.style.cssText = "position:absolute;left:50%;bottom:16px;transform:translateX(-50%);" +
      "max-width:70%;padding:6px 12px;" +
      "border-radius:6px;font:13px/1.4 system-ui,sans-serif;pointer-events:none;display:none";
    this.live.setAttribute("aria-live", "polite");
    this.live.style.cssText =
      "position:absolute;width:1px;height:1px;overflow:hidden;clip-path:inset(50%);white-space:nowrap";
    parent.append(this.box, this.live);
  }

  /** Stays until something works again, or for a while (milliseconds); "" takes it back. */
  complain(words: string, brief = 0): void {
    clearTimeout(this.timer);
    if (brief > 0) this.timer = window.setTimeout(() => this.complain(""), brief);
    this.box.textContent = words;
    this.box.style.display = words ? "block" : "none";
  }

  say(words: string): void {
    this.live.textContent = words;
  }

  /** Runs what reads a message of the server: one that cannot be read is said, and nothing else happens. */
  guard(call: () => void): void {
    try {
      call();
      if (this.box.textContent?.startsWith("ESP")) this.complain("");
    } catch (error) {
      if (!(error instanceof MessageError)) throw error;
      this.complain(error.message);
    }
  }

  dispose(): void {
    clearTimeout(this.timer);
  }

  setPalette(p: Palette): void {
    this.box.style.background = css(p.text);
    this.box.style.color = css(p.background);
  }
}

/** Stands in where there is no WebGL 2. */
export class NoView implements StudioView {
  readonly painting = false;
  constructor(private readonly element: HTMLElement) {
    const words = document.createElement("p");
    words.className = "view-none";
    words.style.cssText = "padding:24px;font:14px/1.5 system-ui,sans-serif";
    words.textContent = "The model cannot be drawn: this browser has no WebGL 2, or it is switched off.";
    element.replaceChildren(words);
  }

  setMeshes(): void {}
  setModel(): void {}
  setCloud(): void {}
  setRules(): void {}
  setScene(): void {}
  setHidden(): void {}
  setSelection(): void {}
  setTool(): void {}
  setBrush(): void {}
  setLook(): void {}
  setHighlight(): void {}
  snap(): void {}
  frame(): void {}
  picture(): Promise<null> {
    return Promise.resolve(null);
  }
  camera(): Camera {
    return {};
  }
  dispose(): void {
    this.element.replaceChildren();
  }
}
