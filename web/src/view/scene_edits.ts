// Changes of a scene, as new scenes that share what did not change.
import type { Curve, Scene, Vec3, VolumeMesh } from "../api";
import { add, tidy3, type V } from "./vec";
import type { Placing } from "./placing";

export const kMostCurves = 64;

export const curvesOf = (scene: Scene): readonly Curve[] => scene.curves?.curve ?? [];
export const meshesOf = (scene: Scene): readonly VolumeMesh[] => scene.volume?.mesh ?? [];

/** Without its last curve a scene has no curves at all: the reader of scenes wants one at least. */
function withCurves(scene: Scene, curve: Curve[]): Scene {
  if (curve.length > 0) return { ...scene, curves: { ...scene.curves, curve } };
  const { curves: _, ...rest } = scene;
  return rest;
}

function withMeshes(scene: Scene, mesh: VolumeMesh[]): Scene {
  if (mesh.length > 0) return { ...scene, volume: { ...scene.volume, mesh } };
  const { volume: _, ...rest } = scene;
  return rest;
}

export const addCurve = (scene: Scene, curve: Curve): Scene => withCurves(scene, [...curvesOf(scene), curve]);
export const removeCurve = (scene: Scene, index: number): Scene =>
  withCurves(scene, curvesOf(scene).filter((_, i) => i !== index));
export const addMesh = (scene: Scene, mesh: VolumeMesh): Scene => withMeshes(scene, [...meshesOf(scene), mesh]);
export const removeMesh = (scene: Scene, index: number): Scene =>
  withMeshes(scene, meshesOf(scene).filter((_, i) => i !== index));

/** All points of a curve of an index; unchanged where there is none. */
export function setPoints(scene: Scene, index: number, points: readonly [V, V, V, V]): Scene {
  return withCurves(scene, curvesOf(scene).map((curve, i) =>
    i === index ? { ...curve, points: points.map(tidy3) as [Vec3, Vec3, Vec3, Vec3] } : curve));
}

/** One point put elsewhere. An end takes its handle along, so that the curve keeps its bend there. */
export function movedPoint(points: readonly [V, V, V, V], point: number, to: V): [V, V, V, V] {
  const by = [0, 1, 2].map((i) => to[i]! - points[point]![i]!) as Vec3;
  const follows = point === 0 ? 1 : point === 3 ? 2 : -1;
  return points.map((p, i) => (i === point ? to : i === follows ? add(p, by) : p)) as unknown as [V, V, V, V];
}

export const movedCurve = (points: readonly [V, V, V, V], by: V): [V, V, V, V] =>
  points.map((p) => add(p, by)) as unknown as [V, V, V, V];

export function setPlacing(scene: Scene, index: number, placing: Placing): Scene {
  return withMeshes(scene, meshesOf(scene).map((mesh, i) => i === index ? {
    ...mesh, position: tidy3(placing.position), scale: tidy3(placing.scale), rotation_deg: tidy3(placing.rotation_deg),
  } : mesh));
}
