// Small pictures of a model, for strips and lists: drawn larger than they are, then made smaller.

/** Pixels; twice what a strip shows, for screens with small pixels. */
export const kPortraitWidth = 192, kPortraitHeight = 144;
/** Drawn pixels along one of the picture. */
export const kPortraitScale = 3;
/** Bytes that a server keeps of one (docs/studio-protocol.md). */
export const kMostPortraitBytes = 32 * 1024;

export interface Crop {
  x: number;
  y: number;
  width: number;
  height: number;
}

/** The smallest part of an image around all that is not clear in it, with a margin and the image's shape; may reach out. */
export function cropOf(rgba: Uint8ClampedArray, width: number, height: number): Crop | null {
  let left = width, right = -1, top = height, bottom = -1;
  for (let y = 0, i = 3; y < height; ++y)
    for (let x = 0; x < width; ++x, i += 4) {
      if (rgba[i] === 0) continue;
      if (x < left) left = x;
      if (x > right) right = x;
      if (y < top) top = y;
      bottom = y;
    }
  if (right < 0) return null;
  const share = 1.04 * Math.max((right - left + 1) / width, (bottom - top + 1) / height);
  const wide = share * width, high = share * height;
  return { x: (left + right + 1 - wide) / 2, y: (top + bottom + 1 - high) / 2, width: wide, height: high };
}

/** Rows as WebGL gives them, from below, with alpha: as an image, smaller where it would be too many bytes. */
export async function encodePortrait(rgba: Uint8ClampedArray<ArrayBuffer>, width: number, height: number): Promise<Blob | null> {
  const crop = cropOf(rgba, width, height);
  if (crop === null) return null;
  const large = document.createElement("canvas");
  large.width = width;
  large.height = height;
  large.getContext("2d")!.putImageData(new ImageData(rgba, width, height), 0, 0);
  for (const share of [1, 0.5]) {
    const small = document.createElement("canvas");
    small.width = kPortraitWidth * share;
    small.height = kPortraitHeight * share;
    const paper = small.getContext("2d")!;
    paper.imageSmoothingQuality = "high";
    paper.setTransform(1, 0, 0, -1, 0, small.height);
    paper.drawImage(large, crop.x, crop.y, crop.width, crop.height, 0, 0, small.width, small.height);
    // Browsers that do not write WebP write PNG.
    const image = await new Promise<Blob | null>((done) => small.toBlob(done, "image/webp", 0.82));
    if (image !== null && image.size <= kMostPortraitBytes) return image;
  }
  return null;
}
