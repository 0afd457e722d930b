// The middle: the view with its tools. What the view shows follows from the store.
import { computed, effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { IconButton } from "../controls/fields";
import { Icon, type IconName } from "../controls/icons";
import { Slider } from "../controls/slider";
import { thousands } from "../controls/number";
import type { Brush, Highlight, Side, StudioView, Tool } from "../view/host";
import { createView } from "../view/create_view";
import { useStudio } from "../shell/studio_context";
import { currentView } from "../shell/view_access";
import { silhouettesOf } from "../store/scene";
import { stable } from "../store/stable";
import type { Studio } from "../store/studio";

export function ViewPane() {
  const studio = useStudio();
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const view = createView(place.current!, studio);
    currentView.value = view;
    const stops = follow(studio, view);
    return () => {
      stops.forEach((stop) => stop());
      currentView.value = null;
      view.dispose();
    };
  }, [studio]);
  return (
    <div class="view-pane">
      <div class="view-place"><div class="view-element" ref={place} /></div>
      <Tools />
      <LookBar />
      <SilhouetteCards />
      <ViewNumbers />
    </div>
  );
}

function follow(studio: Studio, view: StudioView): (() => void)[] {
  const { state } = studio;
  const project = computed(() => studio.document.value?.project.id);
  let framed: number | undefined;
  const rules = stable(() => state.shown.value?.rules ?? []);
  const highlight = stable<Highlight>(() => {
    const rule = state.cursorRule.value;
    const selection = state.selection.value;
    return {
      locked: state.shown.value?.locked ?? [],
      ...(rule === null ? {} : { rule }),
      ...(selection?.kind === "gene" ? { gene: selection.gene } : {}),
    };
  });
  return [
    effect(() => view.setLook(studio.look.value)),
    effect(() => {
      if (state.meshes.value !== null) view.setMeshes(state.meshes.value);
    }),
    effect(() => {
      view.setModel(state.model.value);
      if (state.model.value === null) return;
      // Another project is seen from afar first.
      if (framed !== project.peek()) view.frame();
      framed = project.peek();
    }),
    effect(() => view.setRules(rules.value)),
    effect(() => view.setCloud(state.cloud.value)),
    effect(() => {
      const id = project.value;
      if (id !== undefined) view.setScene(studio.scene.value, (path) => studio.files.meshUrl(id, path));
    }),
    effect(() => view.setHidden(state.hidden.value)),
    effect(() => {
      const selection = state.selection.value;
      view.setSelection(selection?.kind === "silhouette" ? null : selection);
    }),
    effect(() => view.setTool(state.tool.value)),
    effect(() => view.setBrush(state.brush.value.brush, state.brush.value.radius)),
    effect(() => view.setHighlight(highlight.value)),
  ];
}

const kTools: readonly { tool: Tool; icon: IconName; words: string; key: string }[] = [
  { tool: "select", icon: "select", words: "Select and move", key: "V" },
  { tool: "curve", icon: "curve", words: "Draw a curve", key: "C" },
  { tool: "box", icon: "box", words: "Place a box", key: "B" },
  { tool: "sphere", icon: "sphere", words: "Place a sphere", key: "O" },
  { tool: "cylinder", icon: "cylinder", words: "Place a cylinder", key: "U" },
  { tool: "paint", icon: "paint", words: "Paint a silhouette", key: "P" },
];

function Tools() {
  const studio = useStudio();
  const tool = studio.state.tool.value;
  return (
    <div class="view-tools">
      <div class="tool-strip" role="toolbar" aria-label="Tools" aria-orientation="vertical">
        {kTools.map((one) => (
          <IconButton key={one.tool} label={one.words} keys={one.key} pressed={tool === one.tool} onClick={() => studio.setTool(one.tool)}>
            <Icon name={one.icon} />
          </IconButton>
        ))}
      </div>
      {tool === "paint" && <BrushBar />}
    </div>
  );
}

const kBrushes: readonly { brush: Brush; words: string }[] = [
  { brush: "want", words: "Want" },
  { brush: "avoid", words: "Avoid" },
  { brush: "erase", words: "Erase" },
];

function BrushBar() {
  const studio = useStudio();
  const { brush, radius } = studio.state.brush.value;
  const set = (changes: Partial<{ brush: Brush; radius: number }>) => (studio.state.brush.value = { ...studio.state.brush.value, ...changes });
  return (
    <div class="brush-bar" role="group" aria-label="Brush">
      {kBrushes.map((one) => (
        <button key={one.brush} type="button" class={`button brush-${one.brush}`} aria-pressed={brush === one.brush} onClick={() => set({ brush: one.brush })}>
          <span class="swatch" />{one.words}
        </button>
      ))}
      <Slider label="Size" min={2} max={100} whole value={radius} onChange={(next) => set({ radius: next })} />
    </div>
  );
}

type LookKey = "parts" | "bones" | "field" | "targets" | "ground" | "reach";
const kLooks: readonly { name: LookKey; icon: IconName; words: string; key: string }[] = [
  { name: "parts", icon: "parts", words: "Model", key: "M" },
  { name: "bones", icon: "bones", words: "Bones", key: "J" },
  { name: "field", icon: "field", words: "Field of directions", key: "W" },
  { name: "targets", icon: "targets", words: "Targets", key: "T" },
  { name: "reach", icon: "reach", words: "Where the rule under the cursor can reach", key: "H" },
  { name: "ground", icon: "ground", words: "Ground", key: "G" },
];
const kSides: readonly { side: Side; words: string; key: string }[] = [
  { side: "+z", words: "From the front", key: "1" },
  { side: "-z", words: "From behind", key: "Shift-1" },
  { side: "+x", words: "From the right", key: "3" },
  { side: "-x", words: "From the left", key: "Shift-3" },
  { side: "+y", words: "From above", key: "7" },
  { side: "-y", words: "From below", key: "Shift-7" },
];

/** With a real minus. */
const sideName = (side: Side) => side.replace("-", "−");

function LookBar() {
  const studio = useStudio();
  const preferences = studio.preferences.value;
  return (
    <div class="view-look">
      <div class="tool-strip flat" role="toolbar" aria-label="What is shown">
        {kLooks.map((one) => (
          <IconButton key={one.name} label={one.words} keys={one.key} pressed={preferences[one.name]} onClick={() => studio.setPreferences({ [one.name]: !preferences[one.name] })}>
            <Icon name={one.icon} />
          </IconButton>
        ))}
      </div>
      <div class="tool-strip flat sides" role="toolbar" aria-label="Sides">
        <IconButton label="See all of it" keys="F" onClick={() => currentView.value?.frame()}><Icon name="frame" /></IconButton>
        {kSides.map((one) => (
          <IconButton key={one.side} label={`${one.words}, ${sideName(one.side)}`} keys={one.key} onClick={() => currentView.value?.snap(one.side)}>
            <span class="side-name">{sideName(one.side)}</span>
          </IconButton>
        ))}
      </div>
    </div>
  );
}

/** Silhouettes are no part of space: they stand beside it as small pictures. */
function SilhouetteCards() {
  const studio = useStudio();
  const project = studio.document.value?.project.id;
  const selection = studio.state.selection.value;
  if (project === undefined || !studio.preferences.value.targets) return null;
  return (
    <ul class="silhouette-cards" aria-label="Silhouettes">
      {silhouettesOf(studio.scene.value).map((silhouette, index) => {
        const image = silhouette.image ?? silhouette.want_image ?? silhouette.avoid_image;
        if (image === undefined || studio.visibility.isHidden("silhouette", index)) return null;
        const selected = selection?.kind === "silhouette" && selection.index === index;
        return (
          <li key={index}>
            <button type="button" aria-pressed={selected} title={image} aria-label={`Silhouette ${index + 1}: ${image}`} onClick={() => studio.select(selected ? null : { kind: "silhouette", index })}>
              <img src={studio.files.url(project, image)} alt="" />
            </button>
          </li>
        );
      })}
    </ul>
  );
}

function ViewNumbers() {
  const { state } = useStudio();
  const shown = state.shown.value;
  const drawn = state.drawn.value;
  if (shown === null) return null;
  return (
    <p class="view-numbers">
      {thousands(shown.parts)} parts · {thousands(shown.bones)} bones · {thousands(shown.genes)} genes
      {drawn !== null && ` · drawn in ${Math.round(drawn)} ms`}
      {shown.truncated && " · more than can be shown"}
    </p>
  );
}
