// Draws strokes: those of the overlay, given in pixels, and long lists of lines in space (bones, field), whose
// widths in pixels follow from a rule in the shader. Instances of one quad, one draw call each.
import {
  BufferAttribute, DynamicDrawUsage, GLSL3, InstancedBufferGeometry, InstancedInterleavedBuffer,
  InterleavedBufferAttribute, Mesh,
  NormalBlending, RawShaderMaterial, Vector2, type Texture,
} from "three";

/** How the words of an instance are read, and what its shader makes of them. */
export interface StrokeKind {
  /** Attributes in order: name and number of floats. */
  attributes: readonly (readonly [string, number])[];
  /** GLSL: sets a, b (clip space), wa, wb (pixels), colour and dash from the attributes; keep = false leaves the
   *  stroke out. */
  vertex: string;
  uniforms?: Record<string, { value: unknown }>;
  depthTest: boolean;
}

const kVertex = (kind: StrokeKind): string => `
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec2 uSize;
in vec2 position;
${kind.attributes.map(([name, size]) => `in ${size === 1 ? "float" : `vec${size}`} ${name};`).join("\n")}
out vec4 vColour;
out vec2 vAt;
flat out vec4 vShape;
${kind.vertex}
void main() {
  vec4 a, b, colour;
  float wa, wb, dash = 0.0;
  bool keep = true;
  stroke(a, b, wa, wb, colour, dash, keep);
  float near = 1e-5;
  if (a.w < near && b.w < near) keep = false;
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  if (!keep) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec2 pa = a.xy / a.w * 0.5 * uSize, pb = b.xy / b.w * 0.5 * uSize;
  float l = distance(pa, pb);
  vec2 along = l > 1e-3 ? (pb - pa) / l : vec2(1, 0), aside = vec2(-along.y, along.x);
  float reach = 0.5 * max(wa, wb) + 1.0;
  vec2 at = vec2(position.x < 0.0 ? -reach : l + reach, position.y * reach);
  vec4 end = position.x < 0.0 ? a : b;
  gl_Position = vec4((pa + along * at.x + aside * at.y) / (0.5 * uSize) * end.w, end.z, end.w);
  vAt = at;
  vShape = vec4(l, 0.5 * wa, 0.5 * wb, dash);
  vColour = colour;
}`;

const kFragment = `
precision highp float;
uniform float uRatio; // pixels of the screen per pixel of the page
in vec4 vColour;
in vec2 vAt;
flat in vec4 vShape;
out vec4 outColour;
void main() {
  float s = clamp(vAt.x, 0.0, vShape.x);
  float radius = mix(vShape.y, vShape.z, vShape.x > 0.0 ? s / vShape.x : 0.0);
  // A head that ends in a point has a flat back, everything else a round cap.
  bool back = vShape.z == 0.0 && vAt.x < 0.0;
  float off = back ? max(abs(vAt.y) - radius, -vAt.x) : length(vec2(vAt.x - s, vAt.y)) - radius;
  float cover = clamp(0.5 - off * uRatio, 0.0, 1.0) * min(1.0, 2.0 * radius + 0.35);
  if (vShape.w > 0.0 && mod(vAt.x, 2.0 * vShape.w) > vShape.w) discard;
  if (cover <= 0.003) discard;
  outColour = vec4(vColour.rgb, vColour.a * cover);
}`;

export class StrokeBatch {
  readonly mesh: Mesh<InstancedBufferGeometry, RawShaderMaterial>;
  private buffer: InstancedInterleavedBuffer;
  private readonly stride: number;

  constructor(private readonly kind: StrokeKind) {
    this.stride = kind.attributes.reduce((sum, [, size]) => sum + size, 0);
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kVertex(kind), fragmentShader: kFragment, transparent: true,
      blending: NormalBlending,
      depthTest: kind.depthTest, depthWrite: false, uniforms: { uSize: { value: new Vector2(1, 1) },
      uRatio: { value: 1 }, ...kind.uniforms },
    });
    this.buffer = this.makeBuffer(64);
    this.mesh = new Mesh(this.makeGeometry(), material);
    this.mesh.frustumCulled = false;
    this.mesh.visible = false;
  }

  /** The first `count` strokes of `data`; copied. */
  set(data: Float32Array, count: number): void {
    const room = this.buffer.count;
    if (count > room) {
      this.mesh.geometry.dispose();
      this.buffer = this.makeBuffer(Math.ceil(count * 1.5));
      this.mesh.geometry = this.makeGeometry();
    }
    if (count > 0) {
      (this.buffer.array as Float32Array).set(data.subarray(0, count * this.stride));
      this.buffer.clearUpdateRanges();
      this.buffer.addUpdateRange(0, count * this.stride);
      this.buffer.needsUpdate = true;
    }
    this.mesh.geometry.instanceCount = count;
    this.mesh.visible = count > 0;
  }

  get count(): number {
    return this.mesh.geometry.instanceCount;
  }

  resize(width: number, height: number, ratio: number): void {
    this.uniform("uRatio", ratio);
    (this.mesh.material.uniforms["uSize"]!.value as Vector2).set(width, height);
  }

  uniform(name: string, value: unknown): void {
    this.mesh.material.uniforms[name]!.value = value;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }

  private makeBuffer(count: number): InstancedInterleavedBuffer {
    const buffer = new InstancedInterleavedBuffer(new Float32Array(count * this.stride), this.stride);
    buffer.setUsage(DynamicDrawUsage);
    return buffer;
  }

  private makeGeometry(): InstancedBufferGeometry {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 1, -1, 1, 1, -1, 1]), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    let offset = 0;
    for (const [name, size] of this.kind.attributes) {
      geometry.setAttribute(name, new InterleavedBufferAttribute(this.buffer, size, offset));
      offset += size;
    }
    geometry.instanceCount = 0;
    return geometry;
  }
}

/** Strokes of the overlay: pixels from the upper left, as `Strokes` keeps them. */
export const kOverlay: StrokeKind = {
  attributes: [["ends", 4], ["widths", 4], ["tint", 4]],
  depthTest: false,
  vertex: `
void stroke(out vec4 a, out vec4 b, out float wa, out float wb, out vec4 colour, inout float dash, inout bool keep) {
  a = vec4(ends.xy / uSize * vec2(2, -2) + vec2(-1, 1), 0, 1);
  b = vec4(ends.zw / uSize * vec2(2, -2) + vec2(-1, 1), 0, 1);
  wa = widths.x; wb = widths.y; dash = widths.z;
  colour = tint;
}`,
};

/** Bones as the message has them: thin wedges from thick to thin, drawn over the parts. */
export const boneStrokes = (marks: { value: Texture }, markWidth: { value: number }): StrokeKind => ({
  attributes: [["from", 3], ["to", 3], ["gene", 1], ["parent", 1]],
  depthTest: false,
  uniforms: { uMarks: marks, uMarkWidth: markWidth, uColour: { value: [1, 1, 1] }, uSelected: { value: [1, 1, 1] },
    uDim: { value: 0 } },
  vertex: `
uniform sampler2D uMarks;
uniform int uMarkWidth;
uniform vec3 uColour, uSelected;
uniform float uDim;
void stroke(out vec4 a, out vec4 b, out float wa, out float wb, out vec4 colour, inout float dash, inout bool keep) {
  a = projectionMatrix * viewMatrix * vec4(from, 1);
  b = projectionMatrix * viewMatrix * vec4(to, 1);
  float l = distance(a.xy / max(a.w, 1e-5), b.xy / max(b.w, 1e-5)) * 0.5 * uSize.y;
  wa = clamp(0.17 * l, 1.1, 7.0);
  wb = clamp(0.05 * l, 0.7, 2.0);
  int g = int(gene), mark = int(texelFetch(uMarks, ivec2(g % uMarkWidth, g / uMarkWidth), 0).r * 255.0 + 0.5);
  bool lit = (mark & 3) != 0;
  colour = lit ? vec4(uSelected, 0.95) : vec4(uColour, uDim > 0.0 ? 0.28 : 0.75);
}`,
});

/** The field, kFieldFloats each: lines that grow thinner in their direction, and fade away from the curves. */
export const fieldStrokes: StrokeKind = {
  attributes: [["place", 3], ["direction", 3], ["strength", 1]],
  depthTest: true,
  uniforms: { uLength: { value: 0.2 }, uColour: { value: [1, 1, 1] } },
  vertex: `
uniform float uLength;
uniform vec3 uColour;
void stroke(out vec4 a, out vec4 b, out float wa, out float wb, out vec4 colour, inout float dash, inout bool keep) {
  a = projectionMatrix * viewMatrix * vec4(place - 0.5 * uLength * direction, 1);
  b = projectionMatrix * viewMatrix * vec4(place + 0.5 * uLength * direction, 1);
  wa = 2.6; wb = 0.5;
  colour = vec4(uColour, 0.05 + 0.7 * strength * strength);
  keep = strength > 0.004;
}`,
};
