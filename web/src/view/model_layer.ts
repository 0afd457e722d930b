// The model as it is drawn: parts, bones, the cloud of a rule, marks of genes, the patch on the ground, and what is
// picked.
import type { CloudMessage, MeshTable, ModelMessage } from "./messages";
import { kGeneWord, kInstanceWords, decodeCloud, decodeMeshes, decodeModel, kBoneWords, MessageError } from "./messages";
import { CloudPoints } from "./cloud_points";
import { contactPatch, contactSquare, kContactCells } from "./contact";
import { markGenes } from "./gene_marks";
import type { Highlight, Look, Portrait } from "./host";
import { eyeOf, framed, type Orbit } from "./orbit";
import { PartPicker, type Hit } from "./part_picker";
import type { Palette } from "./palette";
import { encodePortrait, kPortraitHeight, kPortraitScale, kPortraitWidth } from "./portrait";
import type { Stage } from "./stage";
import { boneStrokes, StrokeBatch } from "./stroke_batch";
import { emptyBox, grow, isEmpty, type Box, type V } from "./vec";

const kNoMeshes: MeshTable = { number: 0, meshes: [] };
const kNoModel: ModelMessage = {
  number: 0, table: 0, instances: 0, floats: new Float32Array(0), words: new Uint32Array(0), bones: 0,
  boneFloats: new Float32Array(0), boneWords: new Uint32Array(0), materials: 0, materialFloats: new Float32Array(0),
  genes: 0, geneWords: new Int32Array(0),
};

export class ModelLayer {
  readonly bones: StrokeBatch;
  readonly cloud = new CloudPoints();
  box: Box = emptyBox();
  private partsBox: Box = emptyBox();
  private table: MeshTable | null = null;
  /** Of the parts that are drawn: a new table counts from the next model on. */
  private drawnTable: MeshTable | null = null;
  private model: ModelMessage | null = null;
  private showBones = false;
  private readonly picker = new PartPicker();
  private readonly scratch = new Float32Array(kContactCells ** 2);
  private boneData = new Float32Array(0);
  private highlight: Highlight = { locked: [] };
  private rules: readonly string[] = [];
  private selected: number | null = null;

  constructor(private readonly stage: Stage) {
    this.bones = new StrokeBatch(boneStrokes(stage.parts.marks, stage.parts.markWidth));
    stage.add(this.bones.mesh, 5);
    stage.add(this.cloud.points, 6);
  }

  /** All three throw MessageError, and leave what is shown as it is. */
  setMeshes(message: ArrayBuffer): void {
    this.table = decodeMeshes(message);
  }

  /** Nothing is drawn any more, and the meshes are forgotten. */
  clear(): void {
    this.table = null;
    this.take(kNoModel, kNoMeshes);
  }

  /** Returns the number of the model. */
  setModel(message: ArrayBuffer): number {
    const { table } = this;
    if (!table) throw new MessageError("ESPM: a model came before the meshes that it is made of");
    const model = decodeModel(message, table.meshes.length);
    if (model.table !== table.number) {
      throw new MessageError(`ESPM: made with mesh table ${model.table}; the one here is ${table.number}`);
    }
    this.take(model, table);
    return model.number;
  }

  private take(model: ModelMessage, table: MeshTable): void {
    const { parts } = this.stage;
    if (this.drawnTable !== table) parts.setMeshes(table);
    this.drawnTable = table;
    this.model = model;
    this.box = parts.setModel(model, table);
    this.partsBox = { min: [...this.box.min], max: [...this.box.max] };
    this.picker.setModel(model, table.meshes, parts.extents);
    this.setBones(model);
    this.stage.setCasters(this.partsBox);
    if (!isEmpty(this.box)) contactPatch(model, parts.extents, this.box, this.scratch, this.stage.ground.bytes);
    this.stage.ground.setPatch(isEmpty(this.box) ? null : contactSquare(this.box));
    this.mark();
  }

  setCloud(message: ArrayBuffer | null): void {
    const cloud: CloudMessage | null = message && decodeCloud(message);
    if (!cloud) return this.cloud.set(new Float32Array(0), 0);
    const data = new Float32Array(cloud.floats);
    for (let i = 0; i < cloud.count; ++i) data[4 * i + 3] = cloud.words[4 * i + 3]!;
    this.cloud.set(data, cloud.count);
  }

  setRules(names: readonly string[]): void {
    this.rules = names;
    this.mark();
  }

  setHighlight(highlight: Highlight, selected: number | null): void {
    this.highlight = highlight;
    this.selected = selected;
    this.mark();
  }

  resize(width: number, height: number, ratio: number): void {
    this.bones.resize(width, height, ratio);
    this.cloud.resize(ratio);
  }

  setPalette(p: Palette): void {
    this.bones.uniform("uColour", p.bone);
    this.bones.uniform("uSelected", p.selected);
    this.cloud.uniform("uStart", p.want);
    this.cloud.uniform("uEnd", p.avoid);
    this.cloud.uniform("uMiddle", p.text);
  }

  setLook(look: Look): void {
    this.showBones = look.bones;
    this.bones.mesh.visible = look.bones && this.bones.count > 0;
    this.stage.parts.group.visible = look.parts;
    this.stage.ground.mesh.visible = look.ground;
    this.stage.ground.setPatch(look.parts && !isEmpty(this.box) ? contactSquare(this.box) : null);
    this.stage.setCasters(this.box);
  }

  /** Genes that have parts, in the order of the derivation. */
  genes(): readonly number[] {
    const { model } = this;
    if (model === null || !this.stage.parts.group.visible) return [];
    const genes = new Set<number>();
    for (let i = 0; i < model.instances; ++i) genes.add(model.words[i * kInstanceWords + kGeneWord]!);
    return [...genes].sort((a, b) => a - b);
  }

  /** `direction` has length 1. */
  pick(origin: V, direction: V): Hit | null {
    return this.stage.parts.group.visible ? this.picker.pick(origin, direction) : null;
  }

  /** The parts without marks, seen from where `orbit` looks but framed by themselves; null where there are none. */
  async portrait(orbit: Orbit): Promise<Portrait | null> {
    if (!this.model || isEmpty(this.partsBox)) return null;
    const width = kPortraitScale * kPortraitWidth, height = kPortraitScale * kPortraitHeight;
    const eye = eyeOf(framed(orbit, this.partsBox, width / height), width, height), { parts } = this.stage;
    const model = this.model.number;
    parts.markBytes.fill(0);
    parts.marksChanged();
    parts.uniform("uDim", 0);
    const rgba = this.stage.portrait(eye, this.partsBox);
    this.mark();
    const image = await encodePortrait(rgba, width, height);
    return image && { model, image };
  }

  dispose(): void {
    this.bones.dispose();
    this.cloud.dispose();
  }

  private setBones(model: ModelMessage): void {
    const { bones, boneFloats: f, boneWords: words } = model;
    if (this.boneData.length < bones * kBoneWords) {
      this.boneData = new Float32Array(Math.ceil(bones * 1.3) * kBoneWords);
    }
    const data = this.boneData;
    data.set(f);
    for (let i = 0, w = 6; i < bones; ++i, w += kBoneWords) {
      data[w] = words[w]!;
      data[w + 1] = words[w + 1]! | 0;
      grow(this.box, [f[w - 6]!, f[w - 5]!, f[w - 4]!]);
      grow(this.box, [f[w - 3]!, f[w - 2]!, f[w - 1]!]);
    }
    this.bones.set(data, bones);
    this.bones.mesh.visible = this.showBones && bones > 0;
  }

  private mark(): void {
    const { parts } = this.stage;
    if (!this.model) return;
    const any = markGenes(this.model.geneWords, this.rules, this.highlight, this.selected, parts.markBytes);
    parts.marksChanged();
    parts.uniform("uDim", any ? 1 : 0);
    this.bones.uniform("uDim", any ? 1 : 0);
  }
}
