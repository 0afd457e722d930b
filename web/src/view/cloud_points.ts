// The cloud of a rule: tens of thousands of dots where its bones and parts can land, one draw call. Points, not quads: a
// browser that draws by processor takes as long for an instance of two triangles as for fifty triangles of a mesh.
import { DynamicDrawUsage, BufferGeometry, GLSL3, InterleavedBuffer, InterleavedBufferAttribute, NormalBlending, Points,
  RawShaderMaterial } from "three";

/** Floats of a dot: place, and kind (0 start of a bone, 1 end, 2 middle of a part). */
export const kCloudFloats = 4;

// Ends are smaller, middles larger. Widths in pixels of the page.
const kVertex = `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec3 uStart, uEnd, uMiddle;
uniform float uRatio; // pixels of the screen per pixel of the page
in vec3 place;
in float sort;
flat out vec4 vColour;
flat out float vWidth;
void main() {
  vWidth = (sort < 0.5 ? 6.0 : sort < 1.5 ? 4.5 : 10.0) * uRatio;
  vColour = sort < 0.5 ? vec4(uStart, 0.5) : sort < 1.5 ? vec4(uEnd, 0.5) : vec4(uMiddle, 0.16);
  gl_Position = projectionMatrix * viewMatrix * vec4(place, 1);
  gl_PointSize = vWidth + 2.0;
}`;

const kFragment = `
precision highp float;
flat in vec4 vColour;
flat in float vWidth;
out vec4 outColour;
void main() {
  float cover = clamp(0.5 + 0.5 * vWidth - length(gl_PointCoord - 0.5) * (vWidth + 2.0), 0.0, 1.0);
  if (cover <= 0.003) discard;
  outColour = vec4(vColour.rgb, vColour.a * cover);
}`;

export class CloudPoints {
  readonly points: Points<BufferGeometry, RawShaderMaterial>;
  private room = 0;
  private buffer!: InterleavedBuffer;

  constructor() {
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: kVertex, fragmentShader: kFragment, transparent: true, blending: NormalBlending,
      depthTest: false, depthWrite: false,
      uniforms: { uStart: { value: [1, 1, 1] }, uEnd: { value: [1, 1, 1] }, uMiddle: { value: [1, 1, 1] }, uRatio: { value: 1 } },
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.visible = false;
  }

  /** The first `count` dots of `data`; copied. */
  set(data: Float32Array, count: number): void {
    if (count > this.room) this.reserve(Math.ceil(count * 1.5));
    if (count > 0) {
      (this.buffer.array as Float32Array).set(data.subarray(0, count * kCloudFloats));
      this.buffer.clearUpdateRanges();
      this.buffer.addUpdateRange(0, count * kCloudFloats);
      this.buffer.needsUpdate = true;
    }
    this.points.geometry.setDrawRange(0, count);
    this.points.visible = count > 0;
  }

  resize(ratio: number): void {
    this.uniform("uRatio", ratio);
  }

  uniform(name: string, value: unknown): void {
    this.points.material.uniforms[name]!.value = value;
  }

  dispose(): void {
    this.points.geometry.dispose();
    this.points.material.dispose();
  }

  private reserve(room: number): void {
    this.room = room;
    this.buffer = new InterleavedBuffer(new Float32Array(room * kCloudFloats), kCloudFloats);
    this.buffer.setUsage(DynamicDrawUsage);
    this.points.geometry.dispose();
    const geometry = this.points.geometry = new BufferGeometry();
    geometry.setAttribute("place", new InterleavedBufferAttribute(this.buffer, 3, 0));
    geometry.setAttribute("sort", new InterleavedBufferAttribute(this.buffer, 1, 3));
  }
}
