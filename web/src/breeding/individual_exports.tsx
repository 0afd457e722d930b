// Files of an individual, and a pack of its relatives.
import { useState } from "preact/hooks";
import { Icon } from "../controls/icons";
import { NumberField } from "../controls/number_field";
import { kModelFormats } from "../panels/model_formats";
import { Menu } from "../shell/menu";
import { useStudio } from "../shell/studio_context";

export function IndividualExports({ id }: { id: number }) {
  const studio = useStudio();
  const project = studio.document.value?.project.id;
  const session = studio.room.state.breeding.value?.session.id;
  const [count, setCount] = useState(20);
  const [triangles, setTriangles] = useState(5000);
  if (project === undefined || session === undefined) return null;
  return (
    <section class="exports" aria-labelledby="exports-title">
      <header class="genes-head">
        <h2 id="exports-title">Export</h2>
        <span class="cell-space" />
        <Menu label={`Export ${id}`} button={<><Icon name="export" />As a file</>}>
          {kModelFormats.map(({ format, name, words }) => (
            <a key={format} role="menuitem" tabIndex={-1} href={studio.files.individualUrl(project, session, id, format)} download>
              <b>{name}</b>
              <span>{words}</span>
            </a>
          ))}
        </Menu>
      </header>
      <p class="hint">A species pack: distinct relatives of {id} as GLB files, zipped.</p>
      <NumberField label="Relatives" value={count} min={1} max={200} whole={true} onChange={setCount} />
      <NumberField label="Triangles" title="Each has so many at most" value={triangles} min={100} max={10_000_000} step={500} whole={true} onChange={setTriangles} />
      <a class="button" href={studio.files.speciesUrl(project, session, id, count, triangles)} download><Icon name="tree" />Species pack of {count}</a>
    </section>
  );
}
