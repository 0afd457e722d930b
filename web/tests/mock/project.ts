// A project of the mock server: grammar, scene and history, and a checker that knows three rules.
import type { Attribute, Checked, Document, FileInfo, Problem, Scene, Symbol } from "../../src/api";

interface Version {
  label: string;
  gesture: string | undefined;
  grammar: string;
  scene: Scene;
}

export class MockProject {
  readonly id: number;
  name: string;
  changed = Date.now() / 1000;
  revision = 1;
  files: FileInfo[] = [];
  favourites: Document["favourites"] = [];
  /** Of favourites, by their numbers. */
  pictures = new Map<number, Buffer>();
  private versions: Version[];
  private at = 0;

  constructor(id: number, name: string, grammar: string, scene: Scene) {
    this.id = id;
    this.name = name;
    this.versions = [{ label: "", gesture: undefined, grammar, scene }];
  }

  get now(): Version {
    return this.versions[this.at]!;
  }

  edit(label: string, gesture: string | undefined, grammar: string | undefined, scene: Scene | undefined): void {
    const next: Version = { label, gesture, grammar: grammar ?? this.now.grammar, scene: scene ?? this.now.scene };
    this.versions = this.versions.slice(0, this.at + 1);
    if (gesture !== undefined && this.at > 0 && this.now.gesture === gesture) this.versions[this.at] = next;
    else this.at = this.versions.push(next) - 1;
    this.touch();
  }

  undo(): boolean {
    if (this.at === 0) return false;
    this.now.gesture = undefined;
    this.at -= 1;
    this.touch();
    return true;
  }

  redo(): boolean {
    if (this.at + 1 >= this.versions.length) return false;
    this.at += 1;
    this.touch();
    return true;
  }

  touch(): void {
    this.revision += 1;
    this.changed = Date.now() / 1000;
  }

  info() {
    return { id: this.id, name: this.name, changed: this.changed };
  }

  document(): Document {
    const redo = this.versions[this.at + 1]?.label;
    return {
      kind: "document", project: this.info(), revision: this.revision, grammar: this.now.grammar, scene: this.now.scene, files: this.files,
      favourites: this.favourites, ...(this.at > 0 ? { undo: this.now.label } : {}), ...(redo === undefined ? {} : { redo }),
    };
  }

  checked(): Checked {
    const { grammar, scene } = this.now;
    return { kind: "checked", revision: this.revision, problems: problemsOf(grammar), symbols: symbolsOf(grammar), attributes: attributesOf(grammar, scene) };
  }
}

function symbolsOf(text: string): Symbol[] {
  return [...text.matchAll(/((?:^#.*\n)*)^(rule|detail|attr|material|const|fn|mesh)\s+(\w+)([^\n{=]*)/gm)].map((match) => {
    const [all, comment, kind, name, rest] = match as unknown as [string, string, Symbol["kind"], string, string];
    const from = match.index + comment.length;
    const to = kind === "rule" || kind === "detail" ? text.indexOf("\n}", from) + 2 : match.index + all.length;
    const words = comment.replace(/^#\s?/gm, "").replace(/\n/g, " ").trim();
    return { kind, name, signature: `${kind} ${name}${rest.trimEnd()}`, at: { from, to: to > 1 ? to : text.length }, ...(words ? { comment: words } : {}) };
  });
}

function problemsOf(text: string): Problem[] {
  const out: Problem[] = [];
  const code = text.replace(/#.*/g, (comment) => " ".repeat(comment.length));
  const rules = new Set([...code.matchAll(/\brule\s+(\w+)/g)].map((match) => match[1]));
  for (const match of code.matchAll(/\bspawn\s+(\w+)/g))
    if (!rules.has(match[1]))
      out.push({
        severity: "error", code: "E0202", text: `no rule is called "${match[1]}"`, help: `Rules are ${[...rules].join(", ")}.`,
        at: { from: match.index + match[0].length - match[1]!.length, to: match.index + match[0].length },
      });
  const open = [...code].filter((one) => one === "{").length - [...code].filter((one) => one === "}").length;
  if (open > 0) out.push({ severity: "error", code: "E0113", text: "a { without }", at: { from: code.lastIndexOf("{"), to: code.lastIndexOf("{") + 1 } });
  for (const match of code.matchAll(/\b(\w+)\s*~\s*chance\(1\)/g))
    out.push({ severity: "warning", code: "W0301", text: `${match[1]} is always true`, at: { from: match.index, to: match.index + match[0].length } });
  return out;
}

function attributesOf(text: string, scene: Scene): Attribute[] {
  return [...text.matchAll(/^attr\s+(\w+)(?:\s+in\s+([\d.]+?)(deg)?\.\.([\d.]+)(deg)?(?:\s+by\s+([\d.]+))?)?\s*=\s*(true|false|[\d.]+)(deg)?(?:\s+"([^"]*)")?/gm)].map((match): Attribute => {
    const [, name, min, , max, , step, standard, unit, label] = match;
    const common = { name: name!, ...(label ? { label } : {}) };
    const own = scene.attributes?.[name!];
    if (standard === "true" || standard === "false")
      return { ...common, kind: "bool", standard: standard === "true", value: own ?? standard === "true" };
    const value = own === undefined ? Number(standard) : Number.parseFloat(String(own));
    return {
      ...common, kind: "number", standard: Number(standard), value, ...(unit ? { unit } : {}), ...(step ? { step: Number(step) } : {}),
      ...(min === undefined ? {} : { min: Number(min), max: Number(max) }),
    };
  });
}
