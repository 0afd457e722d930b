// The embedded model: from its bytes (report_model.h) to buffers of triangles ready to draw.
"use strict";
const geometry = {};

geometry.bytes = (text) => {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
};

// Shapes as {positions, normals, triangles}, parts as {place, shape, material}.
geometry.read = (header, buffer) => {
  let at = 0;
  const take = (Type, count) => {
    const array = new Type(buffer, at, count);
    at += count * Type.BYTES_PER_ELEMENT;
    return array;
  };
  const shapes = header.shapes.map(() => ({}));
  shapes.forEach((shape, i) => { shape.positions = take(Float32Array, 3 * header.shapes[i][0]); });
  shapes.forEach((shape, i) => { shape.normals = take(Int16Array, 4 * header.shapes[i][0]); });
  shapes.forEach((shape, i) => { shape.triangles = take(Uint32Array, 3 * header.shapes[i][1]); });
  const places = take(Float32Array, 12 * header.parts);
  const kinds = take(Uint32Array, 2 * header.parts);
  if (at !== buffer.byteLength) throw new Error("the model's bytes do not fit its header");
  const parts = [];
  for (let i = 0; i < header.parts; ++i) {
    parts.push({place: places.subarray(12 * i, 12 * i + 12), shape: shapes[kinds[2 * i]], material: kinds[2 * i + 1]});
  }
  return {parts, targets: header.targets.map((i) => shapes[i])};
};

const kUnmoved = [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0];
const kNoMaterial = {color: [0.8, 0.8, 0.8], roughness: 0.7, metal: 0, opacity: 1, glow: 0};

// Normals go by the cofactors (the inverse transpose times the determinant), which flat parts have too; mirrored ones
// are turned round.
const cofactors = (m) => {
  const cross = (a, b) => [m[a + 1] * m[b + 2] - m[a + 2] * m[b + 1], m[a + 2] * m[b] - m[a] * m[b + 2],
                           m[a] * m[b + 1] - m[a + 1] * m[b]];
  const c = [...cross(3, 6), ...cross(6, 0), ...cross(0, 3)];
  const mirrored = m[0] * c[0] + m[1] * c[1] + m[2] * c[2] < 0;
  return mirrored ? c.map((x) => -x) : c;
};

// One buffer of all pieces [{place, shape, material}], moved by `centre` and `scale` to about unit size.
geometry.bake = (pieces, materials, centre, scale) => {
  let vertices = 0, corners = 0;
  for (const {shape} of pieces) {
    vertices += shape.positions.length / 3;
    corners += shape.triangles.length;
  }
  const out = {
    positions: new Float32Array(3 * vertices), normals: new Int16Array(4 * vertices),
    colors: new Uint8Array(4 * vertices), surfaces: new Uint8Array(4 * vertices), triangles: new Uint32Array(corners),
  };
  const byte = (x) => Math.round(255 * Math.min(Math.max(x, 0), 1));
  let vertex = 0, corner = 0;
  for (const {place: m, shape, material} of pieces) {
    const c = cofactors(m), look = materials[material] || kNoMaterial;
    const color = [...look.color.map((x) => byte(Math.sqrt(x))), byte(look.opacity)];
    const surface = [byte(look.roughness), byte(look.metal), byte(look.glow / 4), 0];
    const first = vertex;
    for (let i = 0; i < shape.positions.length / 3; ++i, ++vertex) {
      const [x, y, z] = shape.positions.subarray(3 * i, 3 * i + 3);
      const [u, v, w] = shape.normals.subarray(4 * i, 4 * i + 3);
      const n = [0, 0, 0];
      for (let k = 0; k < 3; ++k) {
        out.positions[3 * vertex + k] = (m[k] * x + m[3 + k] * y + m[6 + k] * z + m[9 + k] - centre[k]) * scale;
        n[k] = c[k] * u + c[3 + k] * v + c[6 + k] * w;
      }
      const length = Math.hypot(...n) || 1;
      for (let k = 0; k < 3; ++k) out.normals[4 * vertex + k] = Math.round(32767 * n[k] / length);
      out.colors.set(color, 4 * vertex);
      out.surfaces.set(surface, 4 * vertex);
    }
    for (const index of shape.triangles) out.triangles[corner++] = first + index;
  }
  return out;
};

// The box of pieces, in model space.
geometry.box = (pieces) => {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const {place: m, shape: {positions: p}} of pieces) {
    for (let i = 0; i < p.length; i += 3) {
      for (let k = 0; k < 3; ++k) {
        const x = m[k] * p[i] + m[3 + k] * p[i + 1] + m[6 + k] * p[i + 2] + m[9 + k];
        if (x < low[k]) low[k] = x;
        if (x > high[k]) high[k] = x;
      }
    }
  }
  return {low, high, empty: !(low[0] <= high[0])};
};

// All that is to be drawn, of unit size around the origin.
geometry.load = () => {
  const header = page.data.model;
  const {parts, targets} = geometry.read(header, geometry.bytes(page.byId("model").textContent));
  const ghosts = targets.map((shape) => ({place: kUnmoved, shape, material: -1}));
  const box = geometry.box(parts.concat(ghosts));
  if (box.empty) return null;
  const centre = box.low.map((x, k) => (x + box.high[k]) / 2);
  const scale = 2 / Math.max(Math.hypot(...box.high.map((x, k) => x - box.low[k])), 1e-30);
  const clear = (part) => (header.materials[part.material] || kNoMaterial).opacity < 1;
  const bake = (pieces) => geometry.bake(pieces, header.materials, centre, scale);
  return {
    solid: bake(parts.filter((part) => !clear(part))), clear: bake(parts.filter(clear)), ghosts: bake(ghosts),
    ground: (box.low[1] - centre[1]) * scale, top: (box.high[1] - centre[1]) * scale,
  };
};
