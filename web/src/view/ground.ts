// The ground: a disc at y = 0 with a grid in steps of ten that fades away, the key light's shadow, and a soft dark
// patch where the model stands near it.
import {
  BufferAttribute, BufferGeometry, DataTexture, DoubleSide, GLSL3, LinearFilter, Matrix4, Mesh, RawShaderMaterial,
  RedFormat,
  UnsignedByteType, Vector2, Vector3, Vector4, type Texture,
} from "three";
import { kContactCells } from "./contact";
import type { Eye } from "./orbit";
import type { Palette } from "./palette";

const kVertex = `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec3 uCentre;
uniform float uReach;
in vec2 position;
out vec2 vPlace;
void main() {
  vPlace = uCentre.xz + position * uReach;
  gl_Position = projectionMatrix * viewMatrix * vec4(vPlace.x, 0, vPlace.y, 1);
}`;

const kFragment = `
precision highp float;
precision highp sampler2DShadow;
uniform vec3 uCentre, uGround, uGrid, uAxisX, uAxisZ, cameraPosition;
uniform float uReach, uStep, uDark;
uniform vec4 uPatch; // middle x, z; side; 1 where there is a model
uniform sampler2D uContact;
#ifdef SHADOWS
uniform sampler2DShadow uShadow;
uniform mat4 uShadowMatrix;
uniform vec2 uShadowSize;
#endif
in vec2 vPlace;
out vec4 outColour;

float noise(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }

float lines(vec2 p, float cell) {
  vec2 width = fwidth(p) / cell, at = abs(fract(p / cell - 0.5) - 0.5);
  vec2 cover = clamp(1.1 - at / max(width, vec2(1e-6)), 0.0, 1.0) * clamp(1.2 - 4.0 * width, 0.0, 1.0);
  return max(cover.x, cover.y);
}

float axis(float p) { return clamp(1.3 - abs(p) / max(fwidth(p), 1e-6), 0.0, 1.0); }

void main() {
  float away = distance(vPlace, uCentre.xz) / uReach;
  float fade = 1.0 - smoothstep(0.12, 0.95, away);
  bool below = cameraPosition.y < 0.0;
  float shade = 0.0;
  vec2 patchAt = (vPlace - uPatch.xy) / uPatch.z + 0.5;
  if (uPatch.w > 0.0 && all(greaterThan(patchAt, vec2(0))) && all(lessThan(patchAt, vec2(1)))) {
    shade = 0.62 * texture(uContact, patchAt).r;
  }
#ifdef SHADOWS
  vec4 p = uShadowMatrix * vec4(vPlace.x, 0, vPlace.y, 1);
  if (uPatch.w > 0.0 && p.z < 1.0 && all(greaterThan(p.xy, vec2(0))) && all(lessThan(p.xy, vec2(1)))) {
    float angle = 6.2831853 * noise(gl_FragCoord.xy), sum = 0.0;
    for (int i = 0; i < 12; ++i) {
      float a = angle + float(i) * 2.399963, r = sqrt((float(i) + 0.5) / 12.0) * 5.0;
      sum += texture(uShadow, vec3(p.xy + vec2(cos(a), sin(a)) * r * uShadowSize.x, p.z));
    }
    shade = max(shade, 0.5 * (1.0 - sum / 12.0));
  }
#endif
  float grid = max(0.32 * lines(vPlace, uStep), 0.75 * lines(vPlace, 10.0 * uStep));
  vec3 colour = mix(uGround, uGrid, grid * fade);
  colour = mix(colour, uAxisX, 0.5 * axis(vPlace.y));
  colour = mix(colour, uAxisZ, 0.5 * axis(vPlace.x));
  colour *= 1.0 - shade * uDark;
  float alpha = fade * (below ? 0.3 : 1.0);
  outColour = vec4(colour, alpha);
}`;

export class Ground {
  readonly mesh: Mesh<BufferGeometry, RawShaderMaterial>;
  private readonly contact = new DataTexture(new Uint8Array(kContactCells ** 2), kContactCells, kContactCells,
    RedFormat, UnsignedByteType);

  constructor(shadows: boolean) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
    geometry.setIndex([0, 2, 1, 0, 3, 2]);
    this.contact.magFilter = this.contact.minFilter = LinearFilter;
    this.contact.needsUpdate = true;
    const colour = (): { value: number[] } => ({ value: [0, 0, 0] });
    this.mesh = new Mesh(geometry, new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kVertex, fragmentShader: kFragment, transparent: true, depthWrite: false,
      side: DoubleSide,
      defines: shadows ? { SHADOWS: 1 } : {},
      uniforms: {
        uCentre: { value: new Vector3() }, uReach: { value: 1 }, uStep: { value: 1 }, uDark: { value: 1 },
        uGround: colour(),
        uGrid: colour(), uAxisX: colour(), uAxisZ: colour(), uPatch: { value: new Vector4(0, 0, 1, 0) },
        uContact: { value: this.contact }, uShadow: { value: null as Texture | null },
        uShadowMatrix: { value: new Matrix4() },
        uShadowSize: { value: new Vector2(1, 1) },
      },
    }));
    this.mesh.frustumCulled = false;
  }

  get bytes(): Uint8Array {
    return this.contact.image.data as Uint8Array;
  }

  /** The patch's bytes were written anew; no patch where there is no model. */
  setPatch(square: { x: number; z: number; side: number } | null): void {
    this.contact.needsUpdate = true;
    const patch = this.uniform("uPatch") as Vector4;
    if (square) patch.set(square.x, square.z, square.side, 1);
    else patch.set(0, 0, 1, 0);
  }

  setPalette(p: Palette, dark: boolean): void {
    Object.assign(this.mesh.material.uniforms, {
      uGround: { value: p.ground }, uGrid: { value: p.grid }, uAxisX: { value: p.axes[0] },
      uAxisZ: { value: p.axes[2] },
      uDark: { value: dark ? 0.95 : 0.75 },
    });
  }

  setShadow(map: Texture, matrix: Matrix4, size: Vector2): void {
    Object.assign(this.mesh.material.uniforms, {
      uShadow: { value: map }, uShadowMatrix: { value: matrix }, uShadowSize: { value: size },
    });
  }

  /** Steps of the grid follow the distance in powers of ten. */
  follow(eye: Eye): void {
    (this.uniform("uCentre") as Vector3).set(eye.target[0], 0, eye.target[2]);
    const far = Math.max(eye.distance, Math.abs(eye.position[1]));
    this.mesh.material.uniforms["uReach"]!.value = 9 * far;
    this.mesh.material.uniforms["uStep"]!.value = 10 ** Math.floor(Math.log10(far / 5));
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
    this.contact.dispose();
  }

  private uniform(name: string): unknown {
    return this.mesh.material.uniforms[name]!.value;
  }
}
