import { Icon } from "../controls/icons";
import type { ExportFormat } from "../connection/files";
import { Menu } from "../shell/menu";
import { useStudio } from "../shell/studio_context";

const kFormats: readonly { format: ExportFormat; name: string; words: string }[] = [
  { format: "glb", name: "GLB", words: "model with materials" },
  { format: "obj", name: "OBJ", words: "model with materials, zipped" },
  { format: "ply", name: "PLY", words: "triangles" },
  { format: "stl", name: "STL", words: "triangles, for printing" },
  { format: "png", name: "PNG", words: "picture" },
  { format: "zip", name: "Scene folder", words: "what espalier run runs, zipped" },
  { format: "espalier", name: "Project", words: "all of it as one file" },
];

export function ExportMenu() {
  const studio = useStudio();
  const project = studio.document.value?.project.id;
  return (
    <Menu label="Export" button={<><Icon name="export" />Export</>} disabled={project === undefined}>
      {project !== undefined && kFormats.map(({ format, name, words }) => (
        <a key={format} role="menuitem" tabIndex={-1} href={studio.files.exportUrl(project, format)} download onClick={() => studio.edits.flush()}>
          <b>{name}</b>
          <span>{words}</span>
        </a>
      ))}
    </Menu>
  );
}
