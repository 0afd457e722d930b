// The formats in which one model leaves the studio.
import type { IndividualFormat } from "../connection/files";

export const kModelFormats: readonly { format: IndividualFormat; name: string; words: string }[] = [
  { format: "glb", name: "GLB", words: "model with materials" },
  { format: "lods", name: "Levels of detail", words: "four models for games, with smooth joints, zipped" },
  { format: "obj", name: "OBJ", words: "model with materials, zipped" },
  { format: "ply", name: "PLY", words: "triangles" },
  { format: "stl", name: "STL", words: "triangles, for printing" },
  { format: "png", name: "PNG", words: "picture" },
  { format: "zip", name: "Scene folder", words: "what espalier run runs, zipped" },
];
