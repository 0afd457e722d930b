// The studio's own volumes, each within -0.5..0.5, and the creases of any mesh.
import type { Triangles } from "./rays";
import type { Steps } from "./slices";

export const kShapes = ["box", "sphere", "cylinder"] as const;
export type Shape = (typeof kShapes)[number];

export const shapeFile = (shape: Shape): string => `shapes/${shape}.obj`;
export const shapeOf = (file: string): Shape | undefined => kShapes.find((shape) => shapeFile(shape) === file);

/** Triangles that a profile makes turned about y: points (radius, height) from below to above. */
function lathe(profile: readonly (readonly [number, number])[], sides: number): Triangles {
  const positions: number[] = [], indices: number[] = [];
  for (const [radius, y] of profile) {
    for (let i = 0; i < sides; ++i) {
      const angle = (2 * Math.PI * i) / sides;
      positions.push(radius * Math.cos(angle), y, radius * Math.sin(angle));
    }
  }
  for (let ring = 0; ring + 1 < profile.length; ++ring) {
    for (let i = 0; i < sides; ++i) {
      const a = ring * sides + i, b = ring * sides + (i + 1) % sides;
      if (profile[ring]![0] > 0) indices.push(a, a + sides, b);
      if (profile[ring + 1]![0] > 0) indices.push(b, a + sides, b + sides);
    }
  }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}

function box(): Triangles {
  const positions: number[] = [], indices: number[] = [];
  for (let axis = 0; axis < 3; ++axis) {
    for (const side of [-0.5, 0.5]) {
      const base = positions.length / 3;
      for (const [u, v] of [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] as const) {
        const p = [0, 0, 0];
        p[axis] = side; p[(axis + 1) % 3] = u; p[(axis + 2) % 3] = v;
        positions.push(...p);
      }
      indices.push(...(side > 0 ? [0, 1, 2, 0, 2, 3] : [0, 2, 1, 0, 3, 2]).map((i) => base + i));
    }
  }
  return { positions: new Float32Array(positions), indices: new Uint32Array(indices) };
}

export function shapeTriangles(shape: Shape): Triangles {
  if (shape === "box") return box();
  if (shape === "cylinder") {
    // Rims stand there twice, so that normals do not run round them.
    return lathe([[0, -0.5], [0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [0.5, 0.5], [0, 0.5]], 48);
  }
  const rings = 24;
  return lathe(Array.from({ length: rings + 1 }, (_, i) => {
    const angle = Math.PI * (i / rings - 0.5);
    return [i === 0 || i === rings ? 0 : 0.5 * Math.cos(angle), 0.5 * Math.sin(angle)] as const;
  }), 48);
}

/** Vertices and triangles between two pauses. */
const kPause = 1000;

/** Corner points with a number for each place: vertices that lie together count as one. */
function* welded({ positions }: Triangles): Steps<Uint32Array> {
  const numbers = new Map<string, number>(), result = new Uint32Array(positions.length / 3);
  for (let i = 0; i < result.length; ++i) {
    if (i % kPause === kPause - 1) yield;
    const key = [0, 1, 2].map((k) => positions[3 * i + k]!.toFixed(5)).join();
    let number = numbers.get(key);
    if (number === undefined) numbers.set(key, number = i);
    result[i] = number;
  }
  return result;
}

/** Edges between faces that meet at more than `angle` degrees, and open ones: ends of lines, 6 floats each. */
export function* creases(mesh: Triangles, angle = 35): Steps<Float32Array> {
  const { positions, indices } = mesh, weld = yield* welded(mesh), limit = Math.cos(angle * Math.PI / 180);
  const edges = new Map<number, { a: number; b: number; n: [number, number, number]; count: number; sharp: boolean }>();
  const corner = (i: number, k: number): number => positions[3 * i + k]!;
  for (let t = 0; t < indices.length; t += 3) {
    if (t % (3 * kPause) === 0) yield;
    const v = [weld[indices[t]!]!, weld[indices[t + 1]!]!, weld[indices[t + 2]!]!] as const;
    if (v[0] === v[1] || v[1] === v[2] || v[2] === v[0]) continue;
    const e = [0, 1, 2].map((k) => [corner(v[1], k) - corner(v[0], k), corner(v[2], k) - corner(v[0], k)] as const);
    const n: [number, number, number] = [
      e[1]![0] * e[2]![1] - e[2]![0] * e[1]![1], e[2]![0] * e[0]![1] - e[0]![0] * e[2]![1],
      e[0]![0] * e[1]![1] - e[1]![0] * e[0]![1]];
    const size = Math.hypot(...n);
    if (!(size > 0)) continue;
    n[0] /= size; n[1] /= size; n[2] /= size;
    for (let k = 0; k < 3; ++k) {
      const a = Math.min(v[k]!, v[(k + 1) % 3]!), b = Math.max(v[k]!, v[(k + 1) % 3]!), key = a * 67108864 + b;
      const edge = edges.get(key);
      if (!edge) {
        edges.set(key, { a, b, n, count: 1, sharp: false });
      } else {
        ++edge.count;
        edge.sharp ||= n[0] * edge.n[0] + n[1] * edge.n[1] + n[2] * edge.n[2] < limit;
      }
    }
  }
  const ends: number[] = [];
  for (const { a, b, count, sharp } of edges.values()) {
    if (!sharp && count !== 1) continue;
    for (const i of [a, b]) ends.push(corner(i, 0), corner(i, 1), corner(i, 2));
  }
  return new Float32Array(ends);
}
