// A made-up tree from twelve numbers 0..1, in the form of docs/studio-protocol.md: cones for branches, leaves at their ends.
import { DataUtils } from "three";
import type { BredGene } from "../../src/api";

export const kTable = 0x8000_0001;
const kNames = {
  Tree: [["branches", 2, 5, ""], ["length ratio", 0.55, 0.85, ""], ["width ratio", 0.5, 0.8, ""], ["taper", 0.5, 0.9, ""], ["angle", 15, 75, "deg"], ["rise", -0.3, 0.6, ""], ["depth", 3, 5, ""], ["noise", 0, 0.6, ""], ["seed", 0, 1, ""]],
  Leaves: [["size", 0.06, 0.24, "m"], ["tone", 0, 1, ""], ["share", 0, 1, ""]],
} as const;
export const kDraws = kNames.Tree.length + kNames.Leaves.length;
const kMost = 2600;

export function genesOf(quantiles: readonly number[], locked: readonly { path: string; index: number }[]): BredGene[] {
  let at = 0;
  return (["Tree", "Leaves"] as const).map((rule, gene) => {
    const path = gene === 0 ? "Tree" : "Tree/Leaves";
    return {
      gene, rule, path, locked: locked.filter((one) => one.path === path).map((one) => one.index),
      draws: kNames[rule].map(([name, low, high, unit], index) => {
        const quantile = quantiles[at++]!;
        return { name, index, quantile, value: `${Number((low + (high - low) * quantile).toFixed(2))}${unit}`, low: `${low}${unit}`, high: `${high}${unit}` };
      }),
    };
  });
}

/** Place of a draw in the list of numbers. */
export const placeOf = (gene: number, index: number): number => (gene === 0 ? 0 : kNames.Tree.length) + index;
export const pathOf = (place: number): { path: string; index: number } => (place < kNames.Tree.length ? { path: "Tree", index: place } : { path: "Tree/Leaves", index: place - kNames.Tree.length });

type V = [number, number, number];
const add = (a: V, b: V, s: number): V => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const cross = (a: V, b: V): V => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const norm = (a: V): V => {
  const l = Math.hypot(...a) || 1;
  return [a[0] / l, a[1] / l, a[2] / l];
};

export function randomOf(seed: number): () => number {
  let s = Math.floor(seed * 0x7fff_ffff) | 1;
  return () => {
    s = (s + 0x6d2b79f5) | 0;
    let t = Math.imul(s ^ (s >>> 15), 1 | s);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

interface Part {
  frame: number[];
  top: number;
  mesh: number;
  material: number;
}

export interface Grown {
  parts: Part[];
  triangles: number;
  height: number;
  spread: number;
  low: number;
}

export function grow(quantiles: readonly number[]): Grown {
  const value = (place: number) => {
    const [, low, high] = [...kNames.Tree, ...kNames.Leaves][place]!;
    return low + (high - low) * quantiles[place]!;
  };
  const random = randomOf(quantiles[8]!);
  const count = Math.round(value(0)), depth = Math.round(value(6)), lean = value(4) * Math.PI / 180, noise = value(7);
  const parts: Part[] = [];
  const box = { low: 0, high: 0, wide: 0 };
  const queue: { from: V; way: V; length: number; width: number; level: number }[] = [{ from: [0, 0, 0], way: [0, 1, 0], length: 1.5, width: 0.3, level: 0 }];
  while (queue.length > 0 && parts.length < kMost) {
    const { from, way, length, width, level } = queue.shift()!;
    const side = norm(Math.abs(way[1]) < 0.9 ? cross(way, [0, 1, 0]) : cross(way, [1, 0, 0])), other = cross(side, way);
    const to = add(from, way, length);
    parts.push({ frame: [...side.map((x) => x * width), ...way.map((x) => x * length), ...other.map((x) => x * width), ...add(from, way, length / 2)], top: value(3), mesh: 0, material: 0 });
    box.low = Math.min(box.low, to[1]);
    box.high = Math.max(box.high, to[1]);
    box.wide = Math.max(box.wide, 2 * Math.hypot(to[0], to[2]));
    if (level >= depth) {
      for (let i = 0; i < 3 && random() < 0.3 + 0.7 * quantiles[11]!; ++i) {
        const n = norm([random() - 0.5, random(), random() - 0.5]), u = norm(cross(n, [0.3, 1, 0.2])), v = cross(n, u), size = value(9) * (0.7 + 0.6 * random());
        parts.push({ frame: [...u.map((x) => x * size), ...v.map((x) => x * size * 1.8), ...n.map((x) => x * size), ...add(to, norm([random() - 0.5, random() - 0.5, random() - 0.5]), 0.12)], top: 1, mesh: 1, material: 1 + Math.floor(random() * 2) });
      }
      continue;
    }
    for (let i = 0; i < count; ++i) {
      const turn = 2 * Math.PI * (i + noise * random()) / count + level, angle = lean * (1 + noise * (random() - 0.5));
      const out: V = [0, 1, 2].map((k) => side[k]! * Math.cos(turn) + other[k]! * Math.sin(turn)) as V;
      const next = norm([0, 1, 2].map((k) => way[k]! * Math.cos(angle) + out[k]! * Math.sin(angle) + (k === 1 ? value(5) : 0)) as V);
      queue.push({ from: add(from, way, length * (1 - 0.25 * random() * (i > 0 ? 1 : 0))), way: next, length: length * value(1) * (1 + 0.3 * noise * (random() - 0.5)), width: width * value(2), level: level + 1 });
    }
  }
  return { parts, triangles: parts.reduce((sum, part) => sum + (part.mesh === 0 ? 16 : 2), 0), height: box.high - box.low, spread: box.wide, low: box.low };
}

/** ESPI. */
export function individualMessage(session: number, individual: number, version: number, grown: Grown, tone: number): ArrayBuffer {
  const n = grown.parts.length, materials = 3;
  const out = new ArrayBuffer(64 + n * 32 + materials * 48);
  const view = new DataView(out);
  letters(out, 0, "ESPI");
  [2, session, individual, version, kTable, n, materials].forEach((word, i) => view.setUint32(4 + 4 * i, word, true));
  const longest = Math.max(...grown.parts.flatMap((part) => part.frame.slice(0, 9).map(Math.abs)), 1e-9);
  const box = [0, 1, 2].map((k) => {
    const along = grown.parts.map((part) => part.frame[9 + k]!), low = Math.min(...along, 0);
    return { low, side: Math.max(...along, 0) - low };
  });
  box.forEach(({ low, side }, k) => (view.setFloat32(32 + 4 * k, low, true), view.setFloat32(44 + 4 * k, side, true)));
  view.setFloat32(56, longest, true);
  let at = 64;
  for (const part of grown.parts) {
    const origin = box.map(({ low, side }, k) => side > 0 ? Math.round(65535 * (part.frame[9 + k]! - low) / side) : 0);
    const halves = [...part.frame.slice(0, 9).map((value) => value / longest), part.top].map((value) => DataUtils.toHalfFloat(value));
    [...origin, ...halves, part.mesh, part.material, 0].forEach((value, i) => view.setUint16(at + 2 * i, value, true));
    at += 32;
  }
  const leaf = [0.06 + 0.3 * tone, 0.24 - 0.08 * tone, 0.035];
  for (const colour of [[0.13, 0.085, 0.055], leaf, leaf.map((x) => x * 1.35)]) {
    [...colour, 1, 0, 0, 0, 0, 0.8, 0].forEach((value, i) => view.setFloat32(at + 4 * i, value, true));
    at += 48;
  }
  return out;
}

/** ESPG: a cone of eight sides, a leaf. */
export function treeTable(): ArrayBuffer {
  const cone = { positions: [] as number[], normals: [] as number[], indices: [] as number[], kind: 1 };
  for (let i = 0; i <= 8; ++i) {
    const x = Math.cos(Math.PI * i / 4), z = Math.sin(Math.PI * i / 4);
    cone.positions.push(x / 2, -0.5, z / 2, x / 2, 0.5, z / 2);
    cone.normals.push(x, 0, z, x, 0, z);
    if (i < 8) cone.indices.push(2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3);
  }
  const leaf = { positions: [-0.5, 0, 0, 0, -0.5, 0, 0.5, 0, 0, 0, 0.5, 0], normals: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1], indices: [0, 1, 2, 0, 2, 3], kind: 2 };
  const meshes = [cone, leaf];
  const out = new ArrayBuffer(16 + meshes.reduce((sum, mesh) => sum + 12 + mesh.positions.length * 8 + mesh.indices.length * 4, 0));
  const view = new DataView(out);
  letters(out, 0, "ESPG");
  [1, kTable, meshes.length].forEach((word, i) => view.setUint32(4 + 4 * i, word, true));
  let at = 16;
  for (const mesh of meshes) {
    for (const word of [mesh.positions.length / 3, mesh.indices.length / 3, mesh.kind]) view.setUint32((at += 4) - 4, word, true);
    for (const value of [...mesh.positions, ...mesh.normals]) view.setFloat32((at += 4) - 4, value, true);
    for (const word of mesh.indices) view.setUint32((at += 4) - 4, word, true);
  }
  return out;
}

function letters(out: ArrayBuffer, at: number, text: string): void {
  new Uint8Array(out, at).set([...text].map((letter) => letter.charCodeAt(0)));
}
