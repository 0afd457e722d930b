// Curves with thickness as translucent tubes: one mesh for all of them.
import { BufferAttribute, BufferGeometry, Mesh, type RawShaderMaterial } from "three";
import type { Curve } from "../api";
import { point, velocity } from "./bezier";
import { glass } from "./ghosts";
import type { Rgb } from "./palette";
import { across, add, along, cross, dot, scale, unit, type V } from "./vec";

interface Tube {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
}

const kRings = 32, kSides = 20;

/** Positions and normals of the tubes of those curves that have a thickness, and their triangles. Frames are carried
 *  along the  curve, so that tubes do not twist; rings lie across it. Ends are open. */
export function tubeArrays(curves: readonly Curve[]): Tube {
  const thick = curves.filter((c) => c.thickness && Math.max(...c.thickness) > 0);
  const positions: number[] = [], normals: number[] = [], indices: number[] = [];
  for (const { points, thickness } of thick) {
    const base = positions.length / 3;
    let side: V = across(velocity(points, 0.01));
    for (let ring = 0; ring <= kRings; ++ring) {
      const t = ring / kRings, direction = unit(velocity(points, Math.min(Math.max(t, 1e-3), 1 - 1e-3)));
      side = unit(along(side, -dot(side, direction), direction), across(direction));
      const other = cross(direction, side), middle = point(points, t);
      const radius = thickness![0] + (thickness![1] - thickness![0]) * t;
      for (let i = 0; i < kSides; ++i) {
        const angle = 2 * Math.PI * i / kSides;
        const out = add(scale(side, Math.cos(angle)), scale(other, Math.sin(angle)));
        positions.push(...along(middle, radius, out));
        normals.push(...out);
        if (ring === kRings) continue;
        const a = base + ring * kSides + i, b = base + ring * kSides + (i + 1) % kSides;
        indices.push(a, a + kSides, b, b, a + kSides, b + kSides);
      }
    }
  }
  return { positions: new Float32Array(positions), normals: new Float32Array(normals),
    indices: new Uint32Array(indices) };
}

export class Tubes {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial> = new Mesh(new BufferGeometry(), glass());

  constructor() {
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  set(curves: readonly Curve[]): void {
    const { positions, normals, indices } = tubeArrays(curves);
    this.mesh.visible = indices.length > 0;
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    if (indices.length === 0) return;
    this.mesh.geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.mesh.geometry.setAttribute("normal", new BufferAttribute(normals, 3));
    this.mesh.geometry.setIndex(new BufferAttribute(indices, 1));
  }

  show(): void {
    this.mesh.visible = this.mesh.geometry.index !== null;
  }

  setColour(colour: Rgb): void {
    this.mesh.material.uniforms["uColour"]!.value = colour;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
