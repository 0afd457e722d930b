import { Icon } from "../controls/icons";
import type { ExportFormat } from "../connection/files";
import type { Studio } from "../store/studio";
import { kModelFormats } from "./model_formats";
import { Menu } from "../shell/menu";
import { useStudio } from "../shell/studio_context";

const kFormats: readonly { format: ExportFormat; name: string; words: string }[] = [
  ...kModelFormats,
  { format: "espalier", name: "Project", words: "all of it as one file" },
];

/** What is exported is what is seen: the server is asked once it has confirmed the last edit. */
function afterEdits(studio: Studio, event: MouseEvent & { currentTarget: HTMLAnchorElement }): void {
  const rest = studio.state.status.value.kind === "open" ? studio.rest : null;
  if (rest === null) return;
  event.preventDefault();
  const link = Object.assign(document.createElement("a"), { href: event.currentTarget.href, download: "" });
  void rest.then(() => link.click());
}

export function ExportMenu() {
  const studio = useStudio();
  const project = studio.document.value?.project.id;
  return (
    <Menu label="Export" button={<><Icon name="export" />Export</>} disabled={project === undefined}>
      {project !== undefined && kFormats.map(({ format, name, words }) => (
        <a key={format} role="menuitem" tabIndex={-1} href={studio.files.exportUrl(project, format)} download onClick={(event) => afterEdits(studio, event)}>
          <b>{name}</b>
          <span>{words}</span>
        </a>
      ))}
    </Menu>
  );
}
