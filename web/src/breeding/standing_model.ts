// A model of the breeding room as it is drawn: its parts, as the view of the studio draws them, and the disc below them. Where the
// processor draws, a small view of it shows fewer parts with fewer sides.
import { Scene, Vector3 } from "three";
import { kForSmall } from "../view/coarse_mesh";
import { contactPatch, kContactCells } from "../view/contact";
import { fewerParts } from "../view/fewer_parts";
import { kInstanceWords, MessageError, type MeshTable, type ModelMessage } from "../view/messages";
import type { Palette } from "../view/palette";
import { boxOfModel } from "../view/part_box";
import { kProxy } from "../view/part_picker";
import { Parts } from "../view/parts";
import { isEmpty } from "../view/vec";
import { Disc } from "./disc";
import { spanOf, type Span } from "./framing";
import { decodeParts } from "./individual_parts";

/** The key light, seen from the camera: from the upper right behind it. */
const kKey = new Vector3(0.5, 0.78, 0.55).normalize();
/** In a small view that the processor draws: it has a few hundred pixels each way. */
const kFewParts = 2000;
const scratch = new Float32Array(kContactCells ** 2);

export class StandingModel {
  readonly scene = new Scene();
  span: Span;
  private readonly parts = new Parts(false, kForSmall);
  /** All parts, where `parts` are fewer; made when they are asked for. */
  private whole: Parts | null = null;
  private wholeOf: { message: ArrayBuffer | null; table: MeshTable | null } = { message: null, table: null };
  private message: ArrayBuffer | null = null;
  private readonly disc = new Disc();
  private table: MeshTable | null = null;
  private readonly key = kKey.clone();
  private brightness = 1;

  /** Of nothing, until it is set. `quick`: small views of it must be. */
  constructor(private readonly quick: boolean) {
    this.scene.matrixAutoUpdate = this.scene.matrixWorldAutoUpdate = false;
    this.scene.add(this.disc.mesh, this.parts.group);
    this.parts.uniform("uKey", this.key);
    this.parts.setQuick(quick);
    this.span = spanOf({ min: [1, 1, 1], max: [0, 0, 0] });
  }

  /** Of an individual's message. Throws MessageError, and stays what it was. */
  set(message: ArrayBuffer, table: MeshTable): void {
    const model = decodeParts(message, table.meshes.length);
    if (model.table !== table.number) throw new MessageError(`ESPI: made with mesh table ${model.table}; the one here is ${table.number}`);
    if (this.table !== table) this.parts.setMeshes(table);
    this.table = table;
    this.message = message;
    const { extents } = this.parts, box = boxOfModel(model, table, extents);
    this.parts.setModel(this.quick ? fewerParts(model, table, extents, kFewParts) : model, table);
    this.span = spanOf(box, (x, z) => this.reach(model, x, z));
    this.disc.mesh.visible = !isEmpty(box);
    if (isEmpty(box)) return;
    contactPatch(model, extents, box, scratch, this.disc.bytes);
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

  /** Whether few parts with few sides will do. */
  setSmall(small: boolean): void {
    if (!this.quick) return;
    const whole = small ? null : this.allParts();
    this.parts.group.visible = whole === null;
    if (this.whole !== null) this.whole.group.visible = whole !== null;
  }

  withoutDisc(draw: () => void): void {
    const { mesh } = this.disc, before = mesh.visible;
    mesh.visible = false;
    draw();
    mesh.visible = before;
  }

  setPalette(palette: Palette, dark: boolean): void {
    this.disc.setPalette(palette, dark);
    this.brightness = dark ? 0.95 : 1.04;
    this.parts.uniform("uLight", this.brightness);
    this.whole?.uniform("uLight", this.brightness);
  }

  /** Null where nothing was set. */
  private allParts(): Parts | null {
    const { message, table } = this;
    if (message === null || table === null) return null;
    if (this.whole === null) {
      this.whole = new Parts(false, kForSmall);
      this.whole.uniform("uKey", this.key);
      this.whole.uniform("uLight", this.brightness);
      this.scene.add(this.whole.group);
    }
    if (this.wholeOf.table !== table) this.whole.setMeshes(table);
    if (this.wholeOf.message !== message) this.whole.setModel(decodeParts(message, table.meshes.length), table);
    this.wholeOf = { message, table };
    return this.whole;
  }

  dispose(): void {
    this.parts.dispose();
    this.whole?.dispose();
    this.disc.dispose();
  }
}
