// Makes small WebP pictures of large PNGs with alpha, cut to what is in them: shrink.ts FOLDER OUT. For script/samples.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { cropOf, kPortraitHeight, kPortraitWidth } from "../src/view/portrait.ts";
import { launch } from "./browser.ts";

const kMostBytes = 12_000;
const [from, to] = process.argv.slice(2) as [string, string];
const browser = await launch();
try {
  const page = await browser.newPage();
  await page.evaluate(`window.cropOf = ${cropOf.toString()}`);
  for (const name of readdirSync(from).filter((file) => file.endsWith(".png"))) {
    const png = readFileSync(join(from, name)).toString("base64");
    const webp = await page.evaluate(async ([png, width, height, most]) => {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      const paper = (wide: number, high: number) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [wide, high];
        return canvas.getContext("2d")!;
      };
      const large = paper(image.naturalWidth, image.naturalHeight);
      large.drawImage(image, 0, 0);
      const { width: wide, height: high } = large.canvas;
      const crop = (window as unknown as { cropOf: typeof cropOf }).cropOf(large.getImageData(0, 0, wide, high).data, wide, high)!;
      const small = paper(width, height);
      small.imageSmoothingQuality = "high";
      small.drawImage(large.canvas, crop.x, crop.y, crop.width, crop.height, 0, 0, width, height);
      let url = "";
      for (const quality of [0.82, 0.7, 0.55]) {
        url = small.canvas.toDataURL("image/webp", quality);
        if (url.length * 0.75 <= most) break;
      }
      return url;
    }, [png, kPortraitWidth, kPortraitHeight, kMostBytes] as const);
    writeFileSync(join(to, name.replace(/png$/, "webp")), Buffer.from(webp.slice(webp.indexOf(",") + 1), "base64"));
  }
} finally {
  await browser.close();
}
