// The ground below a model of the breeding room: a disc that fades at its rim, darker where the model stands near it.
import { BufferAttribute, BufferGeometry, DataTexture, DoubleSide, GLSL3, LinearFilter, Mesh, RawShaderMaterial, RedFormat, UnsignedByteType, Vector3, Vector4 } from "three";
import { contactSquare, kContactCells } from "../view/contact";
import type { Palette } from "../view/palette";
import type { Box } from "../view/vec";

const kVertex = `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec4 uDisc; // middle, radius
in vec2 position;
out vec2 vPlace;
void main() {
  vPlace = position;
  gl_Position = projectionMatrix * viewMatrix * vec4(uDisc.x + position.x * uDisc.w, uDisc.y, uDisc.z + position.y * uDisc.w, 1);
}`;

const kFragment = `
precision highp float;
uniform sampler2D uContact;
uniform vec3 uGround, uRim, uBack;
uniform vec4 uDisc, uPatch; // patch: middle x, z; side; darkness
in vec2 vPlace;
out vec4 outColour;
void main() {
  float away = length(vPlace), soft = max(fwidth(away), 1e-4);
  if (away > 1.0) discard;
  vec2 at = (uDisc.xz + vPlace * uDisc.w - uPatch.xy) / uPatch.z + 0.5;
  float shade = all(greaterThan(at, vec2(0))) && all(lessThan(at, vec2(1))) ? texture(uContact, at).r : 0.0;
  vec3 colour = mix(uGround, uRim, smoothstep(1.0 - 3.0 * soft, 1.0 - 1.5 * soft, away));
  colour *= 1.0 - uPatch.w * shade;
  outColour = vec4(mix(colour, uBack, smoothstep(1.0 - soft, 1.0, away)), 1);
}`;

export class Disc {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly contact = new DataTexture(new Uint8Array(kContactCells ** 2), kContactCells, kContactCells, RedFormat, UnsignedByteType);

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
    geometry.setIndex([0, 2, 1, 0, 3, 2]);
    this.contact.magFilter = this.contact.minFilter = LinearFilter;
    this.mesh = new Mesh(geometry, new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kVertex, fragmentShader: kFragment, side: DoubleSide,
      uniforms: {
        uDisc: { value: new Vector4(0, 0, 0, 1) }, uPatch: { value: new Vector4(0, 0, 1, 0) }, uContact: { value: this.contact },
        uGround: { value: new Vector3() }, uRim: { value: new Vector3() }, uBack: { value: new Vector3() },
      },
    }));
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
  }

  /** To be written before `place`. */
  get bytes(): Uint8Array {
    return this.contact.image.data as Uint8Array;
  }

  place(box: Box, x: number, z: number, radius: number, height: number): void {
    const { uniforms } = this.mesh.material, square = contactSquare(box);
    this.contact.needsUpdate = true;
    (uniforms["uDisc"]!.value as Vector4).set(x, height, z, radius);
    (uniforms["uPatch"]!.value as Vector4).set(square.x, square.z, square.side, 0.55);
  }

  setPalette(p: Palette, dark: boolean): void {
    const { uniforms } = this.mesh.material;
    const lift = (by: number) => p.ground.map((c) => Math.min(1, c + by));
    (uniforms["uGround"]!.value as Vector3).fromArray(lift(dark ? 0.025 : 0.02));
    (uniforms["uRim"]!.value as Vector3).fromArray(lift(dark ? 0.1 : -0.08));
    (uniforms["uBack"]!.value as Vector3).fromArray([...p.background]);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.contact.dispose();
  }
}
