// Generations as a strip: time goes right, branches lie below the one that they left.
import type { GenerationInfo, LineageNode } from "../api";

export interface HistoryNode {
  generation: GenerationInfo;
  column: number;
  lane: number;
}

export interface HistoryGraph {
  nodes: HistoryNode[];
  /** Indices of nodes: parent, child. */
  edges: [number, number][];
  columns: number;
  lanes: number;
}

/** Columns are depths. The first child goes on in its parent's lane, later ones begin lanes of their own, as high up as there is
 *  room from there on. */
export function historyGraph(generations: readonly GenerationInfo[]): HistoryGraph {
  const children = new Map<number | undefined, GenerationInfo[]>();
  const known = new Set(generations.map((one) => one.number));
  for (const one of generations) {
    const parent = one.parent !== undefined && known.has(one.parent) ? one.parent : undefined;
    children.set(parent, [...(children.get(parent) ?? []), one]);
  }
  const nodes: HistoryNode[] = [];
  const place = new Map<number, number>();
  const edges: [number, number][] = [];
  const taken: number[] = []; // per lane: the first column that is taken; lanes fill from the right to the left
  const waiting: { generation: GenerationInfo; parent: number | null }[] = (children.get(undefined) ?? []).map((generation) => ({ generation, parent: null }));
  waiting.reverse();
  while (waiting.length > 0) {
    const { generation, parent } = waiting.pop()!;
    // A chain of first children is one line.
    const chain = [generation];
    for (let next = children.get(generation.number)?.[0]; next !== undefined; next = children.get(next.number)?.[0]) chain.push(next);
    const first = generation.depth, last = chain.at(-1)!.depth;
    let lane = parent === null ? 0 : nodes[parent]!.lane + 1;
    while (taken[lane] !== undefined && taken[lane]! <= last + 1) ++lane;
    taken[lane] = Math.min(taken[lane] ?? Infinity, first);
    let before = parent;
    for (const one of chain) {
      const index = nodes.push({ generation: one, column: one.depth, lane }) - 1;
      place.set(one.number, index);
      if (before !== null) edges.push([before, index]);
      before = index;
    }
    // Branches that leave late come first, just below; those that leave earlier go under them.
    for (const one of chain) {
      const others = (children.get(one.number) ?? []).slice(1).reverse();
      for (const other of others) waiting.push({ generation: other, parent: place.get(one.number)! });
    }
  }
  return { nodes, edges, columns: Math.max(0, ...nodes.map((one) => one.column + 1)), lanes: Math.max(0, ...nodes.map((one) => one.lane + 1)) };
}

export interface LineagePlace {
  node: LineageNode;
  /** 0: the individual itself; its parents 1, and so on. */
  level: number;
  /** 0..1 across its level. */
  across: number;
}

export interface LineageGraph {
  places: LineagePlace[];
  /** Indices of places: child, parent. */
  edges: [number, number][];
  levels: number;
  /** There are ancestors beyond. */
  more: boolean;
}

/** The ancestors of an individual, each once, at the nearest level at which it is one. A chain of copies counts as one ancestor: the
 *  earliest of them. */
export function lineageGraph(all: readonly LineageNode[], id: number, levels: number, widest = 8): LineageGraph {
  const byId = new Map(all.map((one) => [one.id, one]));
  const original = (one: LineageNode): LineageNode => {
    let at = one;
    while (at.origin === "kept" && at.parents.length === 1 && byId.has(at.parents[0]!)) at = byId.get(at.parents[0]!)!;
    return at;
  };
  const self = byId.get(id);
  if (self === undefined) return { places: [], edges: [], levels: 0, more: false };
  const index = new Map<number, number>([[self.id, 0]]);
  const places: LineagePlace[] = [{ node: self, level: 0, across: 0.5 }];
  const edges: [number, number][] = [];
  let more = false;
  let row = [0];
  for (let level = 1; level <= levels && row.length > 0; ++level) {
    const next: number[] = [];
    for (const child of row) {
      for (const number of places[child]!.node.parents) {
        const known = byId.get(number);
        if (known === undefined) continue;
        const parent = original(known);
        let at = index.get(parent.id);
        if (at === undefined) {
          if (next.length >= widest) {
            more = true;
            continue;
          }
          at = places.push({ node: parent, level, across: 0.5 }) - 1;
          index.set(parent.id, at);
          next.push(at);
        }
        if (at !== child) edges.push([child, at]);
      }
    }
    next.forEach((at, i) => (places[at]!.across = (i + 0.5) / next.length));
    if (level === levels) more ||= next.some((at) => places[at]!.node.parents.some((parent) => byId.has(parent)));
    row = next;
  }
  return { places, edges, levels: Math.max(...places.map((one) => one.level)) + 1, more };
}
