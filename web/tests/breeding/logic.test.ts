// What the breeding room computes by itself: grids, ratings, triangles, histories, keys, copied genes.
import { describe, expect, test } from "vitest";
import type { BredGene, GenerationInfo, LineageNode } from "../../src/api";
import { corners, nudged, pointOf, weightsAt } from "../../src/breeding/barycentric";
import { copyGenes, pasteGenes } from "../../src/breeding/copied_genes";
import { commonSpan, frameOf, kElevation, kFov, spanOf } from "../../src/breeding/framing";
import { gridLayout, kGap, stageLayout, stepInGrid, type Rect } from "../../src/breeding/grid_layout";
import { historyGraph, lineageGraph } from "../../src/breeding/history_layout";
import { diversityWords, originSentence } from "../../src/breeding/origin_words";
import { extremes, nextPair, pairKey, ratingOfStars, ratingWords, starsOf, stepped } from "../../src/breeding/rating";
import { ROOM_KEYS, roomKeyFor, type Where } from "../../src/breeding/room_keys";

const overlap = (a: Rect, b: Rect) => a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

describe("the grid", () => {
  test.each([9, 10, 11, 12, 13, 16, 17, 19, 20])("%i models are all there, apart, and inside", (count) => {
    const { cells, columns, rows } = gridLayout(count, { x: 7, y: 3, width: 940, height: 590 });
    expect(cells).toHaveLength(count);
    expect(columns * rows).toBeGreaterThanOrEqual(count);
    for (const cell of cells) {
      expect(cell.x).toBeGreaterThanOrEqual(7);
      expect(cell.x + cell.width).toBeLessThanOrEqual(947);
      expect(cell.y + cell.height).toBeLessThanOrEqual(593);
      expect(cell.width).toBeGreaterThan(140);
      expect(cell.height).toBeGreaterThan(100);
    }
    cells.forEach((a, i) => cells.slice(i + 1).forEach((b) => expect(overlap(a, b)).toBe(false)));
  });

  test("neighbours are a gap apart", () => {
    const { cells } = gridLayout(12, { x: 0, y: 0, width: 941, height: 593 });
    expect(cells[1]!.x - (cells[0]!.x + cells[0]!.width)).toBe(kGap);
    expect(cells[4]!.y - (cells[0]!.y + cells[0]!.height)).toBe(kGap);
  });

  test("narrow places have few columns, wide ones many", () => {
    expect(gridLayout(12, { x: 0, y: 0, width: 300, height: 900 }).columns).toBeLessThan(4);
    expect(gridLayout(12, { x: 0, y: 0, width: 1800, height: 300 }).columns).toBeGreaterThan(5);
  });

  test("one large model stands beside the grid, two instead of it", () => {
    const one = stageLayout(12, 1, 940, 590);
    expect(one.large).toHaveLength(1);
    one.grid.cells.forEach((cell) => expect(overlap(cell, one.large[0]!)).toBe(false));
    const two = stageLayout(12, 2, 940, 590);
    expect(two.grid.cells).toEqual([]);
    expect(overlap(two.large[0]!, two.large[1]!)).toBe(false);
  });

  test("arrows go through it and stop at its border", () => {
    // 0 1 2 3 / 4 5 6 7 / 8 9
    expect(stepInGrid(1, "right", 4, 10)).toBe(2);
    expect(stepInGrid(3, "right", 4, 10)).toBe(4);
    expect(stepInGrid(0, "left", 4, 10)).toBe(0);
    expect(stepInGrid(1, "down", 4, 10)).toBe(5);
    expect(stepInGrid(7, "down", 4, 10)).toBe(9);
    expect(stepInGrid(9, "down", 4, 10)).toBe(9);
    expect(stepInGrid(2, "up", 4, 10)).toBe(2);
    expect(stepInGrid(9, "up", 4, 10)).toBe(5);
    expect(stepInGrid(5, "last", 4, 10)).toBe(9);
    expect(stepInGrid(-1, "right", 4, 10)).toBe(0);
    expect(stepInGrid(0, "right", 4, 0)).toBe(-1);
  });
});

describe("framing", () => {
  /** Where a point of the model is in the picture, -1..1, seen from azimuth 0. */
  function seen(point: [number, number, number], frame: { height: number; distance: number }, aspect: number): [number, number] {
    const c = Math.cos(kElevation), s = Math.sin(kElevation), y = point[1] - frame.height;
    const up = y * c - point[2] * s, depth = frame.distance - (y * s + point[2] * c), tan = Math.tan(kFov / 2);
    return [point[0] / (depth * tan * aspect), up / (depth * tan)];
  }

  test.each([[1, 1], [0.3, 4], [6, 1], [2, 8]])("a model of radius %f and height %f is in sight as it turns", (radius, height) => {
    const span = { x: 0, z: 0, radius, low: 0, high: height };
    for (const aspect of [0.8, 1.2, 2]) {
      const frame = frameOf(span, aspect);
      // The widest place in the middle, the foot, the top, and the rim in front.
      for (const point of [[radius, height / 2, 0], [-radius, height / 2, 0], [0, 0, 0], [0, height, 0], [0, 0, radius * 0.94]] as const) {
        const [x, y] = seen([...point], frame, aspect);
        expect(Math.abs(x)).toBeLessThan(1.02);
        expect(Math.abs(y)).toBeLessThan(1.02);
      }
    }
  });

  test("the ground belongs to what nearly stands on it", () => {
    expect(spanOf({ min: [-1, 0.2, -1], max: [1, 3, 1] }).low).toBe(0);
    expect(spanOf({ min: [-1, 5, -1], max: [1, 6, 1] }).low).toBe(5);
    expect(spanOf({ min: [-1, -2, -1], max: [1, 3, 1] }).low).toBe(-2);
    expect(spanOf({ min: [-1, 0, -1], max: [1, 3, 1] }, () => 0.5).radius).toBe(0.5);
  });

  test("one scale is that of the largest", () => {
    const spans = [spanOf({ min: [-1, 0, 0], max: [1, 2, 0] }), spanOf({ min: [-0.5, 0, 0], max: [0.5, 5, 0] })];
    expect(commonSpan(spans)).toEqual({ x: 0, z: 0, radius: 1, low: 0, high: 5 });
    expect(commonSpan([])).toBeNull();
  });
});

describe("ratings", () => {
  test("three stars are neither for nor against, and none is something else", () => {
    expect([1, 2, 3, 4, 5].map(ratingOfStars)).toEqual([-2, -1, 0, 1, 2]);
    expect([-9, -2, 0, 1, 7].map(starsOf)).toEqual([1, 1, 3, 4, 5]);
    expect(starsOf(undefined)).toBeNull();
    expect(ratingWords(undefined)).toBe("not rated");
    expect([2, 0, -1.25].map(ratingWords)).toEqual(["+2", "0", "−1.3"]);
  });

  test("points begin at 0", () => {
    expect(stepped(undefined, 1)).toBe(1);
    expect(stepped(undefined, -1)).toBe(-1);
    expect(stepped(1000, 1)).toBe(1000);
  });

  test("there is one best, and asking again takes it back", () => {
    const screen = [{ id: 1, rating: 2 }, { id: 2 }, { id: 3, rating: -2 }];
    expect(extremes(screen, 2, "best")).toEqual([{ individual: 1 }, { individual: 2, rating: 2 }]);
    expect(extremes(screen, 1, "best")).toEqual([{ individual: 1 }]);
    expect(extremes(screen, 1, "worst")).toEqual([{ individual: 3 }, { individual: 1, rating: -2 }]);
  });

  test("no pair is asked twice, all are seen before any is seen often, and at last there is none", () => {
    const screen = [1, 2, 3, 4].map((id) => ({ id }));
    const asked = new Set<string>();
    const pairs: (readonly [number, number])[] = [];
    for (let pair = nextPair(screen, asked); pair !== null; pair = nextPair(screen, asked)) {
      expect(asked.has(pairKey(...pair))).toBe(false);
      asked.add(pairKey(...pair));
      pairs.push(pair);
    }
    expect(pairs).toHaveLength(6);
    expect(new Set(pairs.slice(0, 2).flat()).size).toBe(4);
  });

  test("those that are near each other in rating come first", () => {
    expect(nextPair([{ id: 1, rating: 3 }, { id: 2, rating: -3 }, { id: 3, rating: 2 }], new Set())).toEqual([1, 3]);
  });
});

describe("the triangle", () => {
  const at = corners(3);

  test("its corners are one parent each, its middle all alike", () => {
    at.forEach((corner, i) => weightsAt(corner, at).forEach((weight, k) => expect(weight).toBeCloseTo(i === k ? 1 : 0, 9)));
    const middle = { x: (at[0]!.x + at[1]!.x + at[2]!.x) / 3, y: (at[0]!.y + at[1]!.y + at[2]!.y) / 3 };
    weightsAt(middle, at).forEach((weight) => expect(weight).toBeCloseTo(1 / 3, 9));
  });

  test("weights and points are each other's inverse, and sum to 1", () => {
    for (const weights of [[0.2, 0.3, 0.5], [0.9, 0.05, 0.05], [0, 0.5, 0.5]]) {
      const back = weightsAt(pointOf(weights, at), at);
      back.forEach((weight, i) => expect(weight).toBeCloseTo(weights[i]!, 9));
    }
  });

  test("outside is the nearest point of its border", () => {
    for (const p of [{ x: -3, y: 0.5 }, { x: 0.5, y: 9 }, { x: 4, y: -4 }, { x: 0.5, y: -2 }]) {
      const weights = weightsAt(p, at);
      expect(weights.reduce((a, b) => a + b, 0)).toBeCloseTo(1, 9);
      expect(Math.min(...weights)).toBeGreaterThanOrEqual(0);
      const own = pointOf(weights, at), away = Math.hypot(own.x - p.x, own.y - p.y);
      // No point of the border that is tried is nearer.
      for (let i = 0; i <= 300; ++i) {
        const side = Math.floor(i / 101), t = (i % 101) / 100, a = at[side]!, b = at[(side + 1) % 3]!;
        expect(Math.hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y)).toBeGreaterThan(away - 1e-9);
      }
    }
  });

  test("of two it is a line", () => {
    weightsAt({ x: 0.5, y: 3 }, corners(2)).forEach((weight) => expect(weight).toBeCloseTo(0.5, 9));
    expect(weightsAt({ x: -1, y: 0 }, corners(2))).toEqual([1, 0]);
  });

  test("one weight more leaves the others their proportion", () => {
    const next = nudged([0.2, 0.2, 0.6], 0, 0.4);
    expect(next[0]).toBeCloseTo(0.6);
    expect(next[2]! / next[1]!).toBeCloseTo(3);
    expect(nudged([1, 0, 0], 0, -0.5)).toEqual([0.5, 0.25, 0.25]);
    expect(nudged([0.9, 0.1], 0, 5)).toEqual([1, 0]);
  });
});

describe("histories", () => {
  const made = (number: number, parent: number | undefined, depth: number): GenerationInfo =>
    ({ number, depth, label: "Bred", individuals: 12, rated: 0, edited: 0, seconds: 0, ...(parent === undefined ? {} : { parent }) });

  test("a line is a line", () => {
    const graph = historyGraph([made(1, undefined, 0), made(2, 1, 1), made(3, 2, 2)]);
    expect(graph.nodes.map((one) => [one.generation.number, one.column, one.lane])).toEqual([[1, 0, 0], [2, 1, 0], [3, 2, 0]]);
    expect(graph.edges).toEqual([[0, 1], [1, 2]]);
    expect([graph.columns, graph.lanes]).toEqual([3, 1]);
  });

  test("branches have lanes of their own, and no two nodes one place", () => {
    const all = [made(1, undefined, 0), made(2, 1, 1), made(3, 2, 2), made(4, 2, 2), made(5, 1, 1), made(6, 5, 2), made(7, 3, 3), made(8, 4, 3), made(9, 5, 2)];
    const graph = historyGraph(all);
    expect(graph.nodes).toHaveLength(all.length);
    expect(new Set(graph.nodes.map((one) => `${one.column} ${one.lane}`)).size).toBe(all.length);
    expect(graph.edges).toHaveLength(all.length - 1);
    for (const [from, to] of graph.edges) {
      expect(graph.nodes[to]!.generation.parent).toBe(graph.nodes[from]!.generation.number);
      expect(graph.nodes[to]!.column).toBe(graph.nodes[from]!.column + 1);
    }
    expect(graph.nodes.filter((one) => one.lane === 0).map((one) => one.generation.number)).toEqual([1, 2, 3, 7]);
  });

  const person = (id: number, parents: number[], origin: LineageNode["origin"] = "crossed"): LineageNode => ({ id, generation: 1, origin, parents, edited: false });

  test("ancestors come once each, with copies as one", () => {
    const all = [person(1, [], "sampled"), person(2, [], "sampled"), person(3, [1], "kept"), person(4, [3], "kept"), person(5, [1, 2]), person(6, [4, 5])];
    const graph = lineageGraph(all, 6, 6);
    expect(graph.places.map((place) => [place.node.id, place.level])).toEqual([[6, 0], [1, 1], [5, 1], [2, 2]]);
    expect(graph.edges.map(([child, parent]) => [graph.places[child]!.node.id, graph.places[parent]!.node.id])).toEqual([[6, 1], [6, 5], [5, 1], [5, 2]]);
    expect(graph.more).toBe(false);
  });

  test("long lines end, and say so; rows are not wider than they may be", () => {
    const line = Array.from({ length: 20 }, (_, i) => person(i + 1, i === 0 ? [] : [i], "mutated"));
    expect(lineageGraph(line, 20, 3)).toMatchObject({ levels: 4, more: true });
    const wide = [...Array.from({ length: 12 }, (_, i) => person(i + 1, [])), ...[0, 1, 2, 3].map((i) => person(20 + i, [3 * i + 1, 3 * i + 2, 3 * i + 3])), person(30, [20, 21, 22, 23])];
    const graph = lineageGraph(wide, 30, 6, 8);
    expect(graph.places.filter((place) => place.level === 2)).toHaveLength(8);
    expect(graph.more).toBe(true);
  });

  test("words for them", () => {
    expect(originSentence({ origin: "crossed", parents: [3, 7] })).toBe("Crossed from 3 and 7");
    expect(originSentence({ origin: "kept", parents: [3] })).toBe("Copy of 3");
    expect(originSentence({ origin: "sampled", parents: [] })).toBe("Drawn anew");
    expect(diversityWords(0.02)).toBe("nearly the same");
    expect(diversityWords(1)).toBe("very varied");
  });
});

describe("keys", () => {
  const press = (key: string, where: Where = "elsewhere", more: object = {}, pairs = false) =>
    roomKeyFor({ key, code: "", ctrlKey: false, metaKey: false, altKey: false, shiftKey: false, ...more }, where, pairs);

  test("stars, points and steps", () => {
    expect(press("4")).toEqual({ do: "stars", stars: 4 });
    expect(press("+", "elsewhere", { shiftKey: true })).toEqual({ do: "point", by: 1 });
    expect(press("ArrowDown")).toEqual({ do: "step", step: "down" });
    expect(press("N")).toEqual({ do: "breed" });
    expect(press("z", "elsewhere", { ctrlKey: true, shiftKey: true })).toEqual({ do: "redo" });
  });

  test("texts keep their letters, sliders their arrows, buttons their Enter", () => {
    expect(press("n", "text")).toBeNull();
    expect(press("z", "text", { metaKey: true })).toEqual({ do: "undo" });
    expect(press("ArrowLeft", "arrows")).toBeNull();
    expect(press("Enter", "button")).toBeNull();
    expect(press("ArrowLeft", "button")).toEqual({ do: "step", step: "left" });
    expect(press("5", "button")).toEqual({ do: "stars", stars: 5 });
  });

  test("between A and B arrows choose", () => {
    expect(press("ArrowRight", "elsewhere", {}, true)).toEqual({ do: "pick", which: 1 });
    expect(press("a", "elsewhere", {}, true)).toEqual({ do: "pick", which: 0 });
    expect(press("a")).toBeNull();
    expect(press("b")).toEqual({ do: "best" });
  });

  test("Alt is the browser's, and what has no words is not listed", () => {
    expect(press("n", "elsewhere", { altKey: true })).toBeNull();
    for (const one of ROOM_KEYS) expect(one.words !== "" || one.unlisted).toBe(true);
  });
});

describe("copied genes", () => {
  const gene = (number: number, rule: string, path: string, quantiles: number[]): BredGene =>
    ({ gene: number, rule, path, locked: [], draws: quantiles.map((quantile, index) => ({ name: `d${index}`, index, quantile, value: "" })) });
  const from = [gene(0, "Trunk", "Trunk", [0.1, 0.2]), gene(1, "Branch", "Trunk/Branch", [0.3]), gene(2, "Branch", "Trunk/Branch[2]", [0.9])];
  const into = [gene(0, "Trunk", "Trunk", [0.1, 0.5]), gene(4, "Branch", "Trunk/Branch", [0.6]), gene(5, "Leaf", "Trunk/Leaf", [0.6])];

  test("all go where the same place is, and only where they differ", () => {
    expect(pasteGenes(copyGenes(7, from), into)).toEqual([{ gene: 0, index: 1, quantile: 0.2 }, { gene: 4, index: 0, quantile: 0.3 }]);
  });
  test("one goes into any of its rule", () => {
    expect(pasteGenes(copyGenes(7, from, from[2]), into, into[1])).toEqual([{ gene: 4, index: 0, quantile: 0.9 }]);
    expect(pasteGenes(copyGenes(7, from, from[2]), into, into[2])).toEqual([]);
  });
});
