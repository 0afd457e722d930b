// A model of the breeding room as it is drawn: its parts, as the view of the studio draws them, and the disc below them.
import { Scene, Vector3 } from "three";
import { kForSmall } from "../view/coarse_mesh";
import { contactPatch, kContactCells } from "../view/contact";
import { kInstanceWords, MessageError, type MeshTable, type ModelMessage } from "../view/messages";
import type { Palette } from "../view/palette";
import { kProxy } from "../view/part_picker";
import { Parts } from "../view/parts";
import { isEmpty } from "../view/vec";
import { Disc } from "./disc";
import { spanOf, type Span } from "./framing";
import { decodeParts } from "./individual_parts";

/** The key light, seen from the camera: from the upper right behind it. */
const kKey = new Vector3(0.5, 0.78, 0.55).normalize();
const scratch = new Float32Array(kContactCells ** 2);

export class StandingModel {
  readonly scene = new Scene();
  span: Span;
  private readonly parts = new Parts(false, kForSmall);
  private readonly disc = new Disc();
  private table: MeshTable | null = null;
  private readonly key = kKey.clone();

  /** Of nothing, until it is set. */
  constructor() {
    this.scene.matrixAutoUpdate = this.scene.matrixWorldAutoUpdate = false;
    this.scene.add(this.disc.mesh, this.parts.group);
    this.parts.uniform("uKey", this.key);
    this.span = spanOf({ min: [1, 1, 1], max: [0, 0, 0] });
  }

  /** Of an individual's message. Throws MessageError, and stays what it was. */
  set(message: ArrayBuffer, table: MeshTable): void {
    const model = decodeParts(message, table.meshes.length);
    if (model.table !== table.number) throw new MessageError(`ESPI: made with mesh table ${model.table}; the one here is ${table.number}`);
    if (this.table !== table) this.parts.setMeshes(table);
    this.table = table;
    const box = this.parts.setModel(model, table);
    this.span = spanOf(box, (x, z) => this.reach(model, x, z));
    this.disc.mesh.visible = !isEmpty(box);
    if (isEmpty(box)) return;
    contactPatch(model, this.parts.extents, box, scratch, this.disc.bytes);
    const { x, z, radius, low, high } = this.span;
    // What grows into the ground is hidden by it; what floats far above, or lies below, has its disc at its own foot.
    const ground = low <= 0 && high > 0 ? 0 : low;
    this.disc.place(box, x, z, Math.max(radius * 0.94, 0.2 * (high - low)), ground);
  }

  /** How far parts are from an upright axis at most. */
  private reach(model: ModelMessage, x: number, z: number): number {
    const { floats: f, words } = model;
    let most = 0;
    for (let i = 0, w = 0; i < model.instances; ++i, w += kInstanceWords) {
      if (words[w + 15] === kProxy) continue;
      const { half, middle } = this.parts.extents[words[w + 14]! & 0xffff]!;
      let dx = f[w + 9]! - x, dz = f[w + 11]! - z, rx = 0, rz = 0;
      for (let k = 0; k < 3; ++k) {
        const ax = f[w + 3 * k]!, az = f[w + 3 * k + 2]!;
        dx += ax * middle[k]!;
        dz += az * middle[k]!;
        rx += Math.abs(ax) * half[k]!;
        rz += Math.abs(az) * half[k]!;
      }
      const away = Math.hypot(Math.abs(dx) + rx, Math.abs(dz) + rz);
      if (away > most && away < Infinity) most = away;
    }
    return most;
  }

  /** The light goes with the camera, so that models turn in it. */
  light(azimuth: number): void {
    const c = Math.cos(azimuth), s = Math.sin(azimuth);
    this.key.set(kKey.x * c + kKey.z * s, kKey.y, kKey.z * c - kKey.x * s);
  }

  /** Whether few sides will do: it is drawn small, where that takes long. */
  setQuick(quick: boolean): void {
    this.parts.setQuick(quick);
  }

  withoutDisc(draw: () => void): void {
    const { mesh } = this.disc, before = mesh.visible;
    mesh.visible = false;
    draw();
    mesh.visible = before;
  }

  setPalette(palette: Palette, dark: boolean): void {
    this.disc.setPalette(palette, dark);
    this.parts.uniform("uLight", dark ? 0.95 : 1.04);
  }

  dispose(): void {
    this.parts.dispose();
    this.disc.dispose();
  }
}
