// Colours of the view, for dark and light backgrounds. Meanings are Okabe and Ito's colours, which all eyes tell apart,
// and no meaning rests on colour alone: ghosts to be avoided are hatched, what is selected is thicker, what is locked
// is striped.

export type Rgb = readonly [number, number, number];

/** sRGB, 0..1. */
export function hex(code: number): Rgb {
  return [(code >> 16 & 255) / 255, (code >> 8 & 255) / 255, (code & 255) / 255];
}

export const linear = (c: Rgb): Rgb =>
  c.map((x) => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4) as unknown as Rgb;

export interface Palette {
  background: Rgb;
  ground: Rgb;
  grid: Rgb;
  /** What lies around lines so that they are seen on anything. */
  halo: Rgb;
  curve: Rgb;
  selected: Rgb;
  handle: Rgb;
  bone: Rgb;
  field: Rgb;
  want: Rgb;
  avoid: Rgb;
  density: Rgb;
  axes: readonly [Rgb, Rgb, Rgb];
  text: Rgb;
}

const kAxes = [hex(0xe0603a), hex(0x35a58c), hex(0x4a8fe0)] as const;

export const kDark: Palette = {
  background: hex(0x1f2226), ground: hex(0x2a2e33), grid: hex(0x596069), halo: hex(0x101214), curve: hex(0x56b4e9),
  selected: hex(0xf5b83d), handle: hex(0xffffff), bone: hex(0xe6a8d0), field: hex(0x8fb8d6), want: hex(0x4f9be0),
  avoid: hex(0xe8703a), density: hex(0xb8bec6), axes: kAxes, text: hex(0xe6e8ea),
};

export const kLight: Palette = {
  background: hex(0xe6e8eb), ground: hex(0xd9dcdf), grid: hex(0x9aa1a9), halo: hex(0xffffff), curve: hex(0x0b65ac),
  selected: hex(0xc77700), handle: hex(0xffffff), bone: hex(0x9a3f78), field: hex(0x41708f), want: hex(0x1b6fc2),
  avoid: hex(0xcc4e12), density: hex(0x50565d), axes: kAxes, text: hex(0x24282c),
};
