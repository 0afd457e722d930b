// A made-up model in the form of docs/studio-protocol.md: a row of cones along bones.

/** ESPG with one box. */
export function boxMeshes(): ArrayBuffer {
  const positions: number[] = [];
  const normals: number[] = [];
  const indices: number[] = [];
  for (const axis of [0, 1, 2])
    for (const sign of [-1, 1]) {
      const first = positions.length / 3;
      for (const [u, v] of [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const) {
        const point = [0, 0, 0];
        point[axis] = sign / 2;
        point[(axis + 1) % 3] = (u / 2) * sign;
        point[(axis + 2) % 3] = v / 2;
        positions.push(...point);
        normals.push(...[0, 1, 2].map((k) => (k === axis ? sign : 0)));
      }
      indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
  const out = new ArrayBuffer(16 + 12 + positions.length * 8 + indices.length * 4);
  letters(out, "ESPG");
  new Uint32Array(out, 8).set([1, 1, positions.length / 3, indices.length / 3, 0]);
  new Float32Array(out, 28).set([...positions, ...normals]);
  new Uint32Array(out, 28 + positions.length * 8).set(indices);
  return out;
}

/** ESPM with `count` boxes, a bone and a gene for each; `wave` 0..1 bends it. */
export function model(number: number, count: number, wave: number): ArrayBuffer {
  const out = new ArrayBuffer(32 + count * 64 + count * 32 + 48 + count * 8);
  letters(out, "ESPM");
  new Uint32Array(out, 8).set([number, count, count, 1, count, 1]);
  const view = new DataView(out);
  let from = [0, 0, 0];
  for (let i = 0; i < count; ++i) {
    const angle = Math.sin(i * 0.7 + wave * 6) * 0.9;
    const to = [from[0]! + 0.5 * Math.sin(angle), from[1]! + 0.5 * Math.cos(angle), 0];
    const thick = 0.3 - (0.2 * i) / count;
    const at = 32 + i * 64;
    const columns = [
      thick * Math.cos(angle), -thick * Math.sin(angle), 0, 0.5 * Math.sin(angle), 0.5 * Math.cos(angle), 0, 0, 0, thick,
      (from[0]! + to[0]!) / 2, (from[1]! + to[1]!) / 2, 0,
    ];
    columns.forEach((value, k) => view.setFloat32(at + 4 * k, value, true));
    view.setFloat32(at + 48, 1, true);
    view.setUint32(at + 52, i, true);
    const bone = 32 + count * 64 + i * 32;
    [...from, ...to].forEach((value, k) => view.setFloat32(bone + 4 * k, value, true));
    view.setUint32(bone + 24, i, true);
    view.setInt32(bone + 28, i - 1, true);
    const gene = 32 + count * 96 + 48 + i * 8;
    view.setUint32(gene, i === 0 ? 0 : 1, true);
    view.setInt32(gene + 4, i - 1, true);
    from = to;
  }
  [0.15, 0.1, 0.06, 1, 0, 0, 0, 0, 0.9, 0, 0, 0].forEach((value, k) => view.setFloat32(32 + count * 96 + 4 * k, value, true));
  return out;
}

function letters(out: ArrayBuffer, kind: string): void {
  new Uint8Array(out).set([...kind].map((letter) => letter.charCodeAt(0)));
  new DataView(out).setUint32(4, 1, true);
}
