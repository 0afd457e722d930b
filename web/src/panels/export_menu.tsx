import { Icon } from "../controls/icons";
import type { ExportFormat } from "../connection/files";
import { kModelFormats } from "./model_formats";
import { Menu } from "../shell/menu";
import { useStudio } from "../shell/studio_context";

const kFormats: readonly { format: ExportFormat; name: string; words: string }[] = [
  ...kModelFormats,
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
