// Changes of a scene, as new scenes: nothing is changed in place. Lists that become empty are taken out with what is around
// them, because a scene's reader wants at least one of each.
import type { Camera, Curve, Density, Limit, Scene, Silhouette, Volume, VolumeMesh } from "../api";

export type TargetKind = "curve" | "mesh" | "silhouette";

export const CURVE_DEFAULTS: Required<Omit<Curve, "points">> = {
  distance: [0, 0, 100],
  alignment: 400,
  offset: 0.6,
  utilisation: 20,
  segment: 0.2,
  thickness: [0, 0],
};

/** For drawings that shall be followed to their ends (docs/guiding.md): of the first curve of a scene. */
export const FIRST_CURVE: Omit<Curve, "points"> = { distance: [0, 0, 4000], alignment: 3000, offset: 0.9, utilisation: 1000 };

export const DENSITY_DEFAULTS = { cell: 0.5, wanted: 10, cost: 10 };
export const LIMIT_NAMES = ["genes", "depth", "parts", "triangles", "height", "spread", "volume", "balance"] as const;
export type LimitName = (typeof LIMIT_NAMES)[number];

/** `object` with `changes`; those that are undefined are taken out. */
export function patched<T extends object>(object: T, changes: { [K in keyof T]?: T[K] | undefined }): T {
  const out: Record<string, unknown> = { ...(object as Record<string, unknown>) };
  for (const [key, value] of Object.entries(changes))
    if (value === undefined) delete out[key];
    else out[key] = value;
  return out as T;
}

const replaced = <T>(list: readonly T[], index: number, item: T): T[] => list.map((old, i) => (i === index ? item : old));
const removed = <T>(list: readonly T[], index: number): T[] => list.filter((_, i) => i !== index);

export function curvesOf(scene: Scene): readonly Curve[] {
  return scene.curves?.curve ?? [];
}
export function meshesOf(scene: Scene): readonly VolumeMesh[] {
  return scene.volume?.mesh ?? [];
}
export function silhouettesOf(scene: Scene): readonly Silhouette[] {
  return scene.silhouette ?? [];
}
export function hasTargets(scene: Scene): boolean {
  return curvesOf(scene).length + meshesOf(scene).length + silhouettesOf(scene).length > 0;
}

function withCurves(scene: Scene, curve: Curve[]): Scene {
  return patched(scene, { curves: curve.length === 0 ? undefined : { ...scene.curves, curve } });
}
function withMeshes(scene: Scene, mesh: VolumeMesh[]): Scene {
  return patched(scene, { volume: mesh.length === 0 ? undefined : { ...scene.volume, mesh } });
}
function withSilhouettes(scene: Scene, silhouette: Silhouette[]): Scene {
  return patched(scene, { silhouette: silhouette.length === 0 ? undefined : silhouette });
}

type Patch<T> = { [K in keyof T]?: T[K] | undefined };

export function changeCurve(scene: Scene, index: number, changes: Patch<Curve>): Scene {
  const curve = curvesOf(scene)[index];
  return curve === undefined ? scene : withCurves(scene, replaced(curvesOf(scene), index, patched(curve, changes)));
}
export function changeMesh(scene: Scene, index: number, changes: Patch<VolumeMesh>): Scene {
  const mesh = meshesOf(scene)[index];
  return mesh === undefined ? scene : withMeshes(scene, replaced(meshesOf(scene), index, patched(mesh, changes)));
}
export function changeSilhouette(scene: Scene, index: number, changes: Patch<Silhouette>): Scene {
  const silhouette = silhouettesOf(scene)[index];
  return silhouette === undefined
    ? scene
    : withSilhouettes(scene, replaced(silhouettesOf(scene), index, patched(silhouette, changes)));
}
export function changeCurves(scene: Scene, changes: { weight?: number | undefined; blend?: boolean | undefined; density?: Density | undefined }): Scene {
  return scene.curves === undefined ? scene : { ...scene, curves: patched(scene.curves, changes) };
}
export function changeVolume(scene: Scene, changes: Patch<Omit<Volume, "mesh">>): Scene {
  return scene.volume === undefined ? scene : { ...scene, volume: patched(scene.volume, changes) };
}

export function addMesh(scene: Scene, mesh: VolumeMesh): Scene {
  return withMeshes(scene, [...meshesOf(scene), mesh]);
}
export function addSilhouette(scene: Scene, silhouette: Silhouette): Scene {
  return withSilhouettes(scene, [...silhouettesOf(scene), silhouette]);
}

export function countOf(scene: Scene, kind: TargetKind): number {
  return kind === "curve" ? curvesOf(scene).length : kind === "mesh" ? meshesOf(scene).length : silhouettesOf(scene).length;
}

export function removeTarget(scene: Scene, kind: TargetKind, index: number): Scene {
  if (kind === "curve") return withCurves(scene, removed(curvesOf(scene), index));
  if (kind === "mesh") return withMeshes(scene, removed(meshesOf(scene), index));
  return withSilhouettes(scene, removed(silhouettesOf(scene), index));
}

/** The copy stands last, a little aside so that it can be seen. */
export function duplicateTarget(scene: Scene, kind: TargetKind, index: number): Scene {
  const aside = 0.25;
  if (kind === "curve") {
    const curve = curvesOf(scene)[index];
    if (curve === undefined) return scene;
    const points = curve.points.map(([x, y, z]) => [x + aside, y, z] as [number, number, number]) as Curve["points"];
    return withCurves(scene, [...curvesOf(scene), { ...curve, points }]);
  }
  if (kind === "mesh") {
    const mesh = meshesOf(scene)[index];
    if (mesh === undefined) return scene;
    const [x, y, z] = mesh.position ?? [0, 0, 0];
    return addMesh(scene, { ...mesh, position: [x + aside, y, z] });
  }
  const silhouette = silhouettesOf(scene)[index];
  return silhouette === undefined ? scene : addSilhouette(scene, { ...silhouette });
}

/** `limit` undefined: none. */
export function changeLimit(scene: Scene, name: LimitName, limit: Limit | undefined): Scene {
  const limits = patched<Record<string, Limit>>(scene.limits ?? {}, { [name]: limit });
  return patched(scene, { limits: Object.keys(limits).length === 0 ? undefined : limits });
}

export function changeAttribute(scene: Scene, name: string, value: number | boolean | string | undefined): Scene {
  const attributes = patched(scene.attributes ?? {}, { [name]: value });
  return patched(scene, { attributes: Object.keys(attributes).length === 0 ? undefined : attributes });
}

/** A curve that is the first target of a scene wants the engine that is made for curves, unless another was chosen. */
export function withGuidedEngine(before: Scene, after: Scene): Scene {
  if (hasTargets(before) || curvesOf(after).length === 0) return after;
  if (after.search?.["engine"] !== undefined || after.engine?.["guided"] !== undefined) return after;
  return {
    ...after,
    search: { ...after.search, engine: "guided" },
    engine: { ...after.engine, guided: { temperature: 1000 } },
    limits: { ...after.limits, genes: after.limits?.["genes"] ?? { min: 1, max: 2000 } },
  };
}

/** Whether a painted silhouette was painted for this camera. */
export function sameCamera(a: Camera | undefined, b: Camera): boolean {
  if (a === undefined) return false;
  const round = (camera: Camera) => JSON.stringify(Object.entries(camera).sort(), (_, value: unknown) => (typeof value === "number" ? Math.round(value * 1e4) : value));
  return round(a) === round(b);
}
