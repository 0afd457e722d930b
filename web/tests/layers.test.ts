// Holds every import in src/ against src/LAYERS.
import { readFileSync, readdirSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { describe, expect, test } from "vitest";

const root = join(import.meta.dirname, "../src");

interface Import {
  from: string;
  to: string;
  /** Nothing of it is left when the page runs. */
  typesOnly: boolean;
}

const files = readdirSync(root, { recursive: true, encoding: "utf8" }).filter((file) => /\.tsx?$/.test(file));

/** The file that an import means; null: it lies outside of src, or is no script. */
function fileOf(from: string, named: string): string | null {
  const path = normalize(join(dirname(from), named));
  return files.find((file) => [path, `${path}.ts`, `${path}.tsx`].includes(file)) ?? null;
}

const imports = files.flatMap((from): Import[] => {
  const text = readFileSync(join(root, from), "utf8");
  return [...text.matchAll(/^(?:import|export)\s+(type\s)?((?:[^"';]*?)\sfrom\s+)?"(\.[^"]+)"/gm)].flatMap((match) => {
    const to = fileOf(from, match[3]!);
    const names = /\{([^}]*)\}/.exec(match[2] ?? "")?.[1]?.split(",").map((name) => name.trim()).filter((name) => name !== "");
    const typesOnly = match[1] !== undefined || (names !== undefined && names.every((name) => name.startsWith("type ")));
    return to === null ? [] : [{ from, to, typesOnly }];
  });
});

const layers = new Map(
  readFileSync(join(root, "LAYERS"), "utf8").split("\n").filter((line) => line !== "" && !line.startsWith("#")).map((line) => {
    const [folder, may] = line.split(":") as [string, string];
    return [folder, may.trim().split(/\s+/).filter((one) => one !== "")];
  }),
);

const folderOf = (file: string) => dirname(file);

describe("the folders of the page", () => {
  test("are in LAYERS, all of them and no others", () => {
    const folders = new Set(files.map(folderOf).filter((folder) => folder !== "."));
    expect([...layers.keys()].sort()).toEqual([...folders].sort());
    const named = [...layers.values()].flat();
    expect(named.filter((one) => !layers.has(one) && !files.includes(one))).toEqual([]);
  });

  test("are listed above what they may import", () => {
    const order = [...layers.keys()];
    for (const [folder, may] of layers)
      for (const other of may.filter((one) => layers.has(one))) expect(order.indexOf(other), `${folder} -> ${other}`).toBeLessThan(order.indexOf(folder));
  });

  test("import what they may", () => {
    expect(imports.length).toBeGreaterThan(300);
    const wrong = imports.filter(({ from, to }) => {
      const folder = folderOf(from), other = folderOf(to);
      if (folder === "." || folder === other || to === "api.ts") return false;
      return !layers.get(folder)?.some((one) => one === other || one === to);
    });
    expect(wrong.map(({ from, to }) => `${from} -> ${to}`)).toEqual([]);
  });

  test("have no files that import each other in a circle", () => {
    const next = new Map(files.map((file) => [file, imports.filter((one) => one.from === file && !one.typesOnly).map((one) => one.to)]));
    const done = new Set<string>();
    const circleFrom = (file: string, above: readonly string[]): readonly string[] | null => {
      if (above.includes(file)) return [...above.slice(above.indexOf(file)), file];
      if (done.has(file)) return null;
      for (const other of next.get(file)!) {
        const circle = circleFrom(other, [...above, file]);
        if (circle !== null) return circle;
      }
      done.add(file);
      return null;
    };
    expect(files.map((file) => circleFrom(file, [])).find((circle) => circle !== null)).toBeUndefined();
  });
});
