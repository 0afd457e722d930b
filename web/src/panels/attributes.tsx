import type { Attribute, Value } from "../api";
import { CheckField, ChoiceField } from "../controls/fields";
import { NumberField } from "../controls/number_field";
import { Slider } from "../controls/slider";
import { useStudio } from "../shell/studio_context";
import { changeAttribute } from "../store/scene";
import { attributeValue, isWhole, labelOf, sceneValue } from "./attribute_values";
import { Panel } from "./panel";

/** What the grammar lets a person set. */
export function AttributesPanel() {
  const studio = useStudio();
  const attributes = studio.state.checked.value?.attributes ?? [];
  const groups = new Map<string, Attribute[]>();
  for (const attribute of attributes) {
    const { group } = labelOf(attribute);
    groups.set(group, [...(groups.get(group) ?? []), attribute]);
  }
  const changed = attributes.some((one) => studio.scene.value.attributes?.[one.name] !== undefined);
  return (
    <Panel
      id="attributes"
      title="Attributes"
      actions={changed && (
        <button type="button" class="text-button" onClick={() => studio.setScene("Reset attributes", { ...studio.scene.value, attributes: {} })}>
          Reset
        </button>
      )}
    >
      {attributes.length === 0 && <p class="hint">Declare one in the grammar: <code>attr tall in 1..5 = 2 "Tower/Height"</code></p>}
      {[...groups].map(([group, list]) => (
        <div key={group} role="group" aria-label={group || "Attributes"}>
          {group !== "" && <h3>{group}</h3>}
          {list.map((attribute) => <AttributeRow key={attribute.name} attribute={attribute} />)}
        </div>
      ))}
    </Panel>
  );
}

function AttributeRow({ attribute }: { attribute: Attribute }) {
  const studio = useStudio();
  const scene = studio.scene.value;
  const { label } = labelOf(attribute);
  const value = attributeValue(attribute, scene);
  const standard = scene.attributes?.[attribute.name] === undefined;
  const set = (next: Value, gesture?: string) =>
    studio.setScene(`Set ${attribute.name}`, changeAttribute(studio.scene.value, attribute.name, sceneValue(attribute, next)), gesture);
  const onReset = () => {
    if (!standard) studio.setScene(`Reset ${attribute.name}`, changeAttribute(studio.scene.value, attribute.name, undefined));
  };
  const title = [attribute.comment, "Double-click the name for the grammar's own value."].filter(Boolean).join("\n");
  const common = { label, standard, title, onReset };
  if (attribute.kind === "bool") return <CheckField {...common} value={value === true} onChange={set} />;
  if (attribute.kind === "choice")
    return <ChoiceField {...common} value={String(value)} choices={attribute.choices ?? []} onChange={(next) => set(next)} />;
  const number = Number(value);
  const unit = attribute.unit === "deg" ? "°" : attribute.unit;
  const { min, max, step } = attribute;
  if (min === undefined || max === undefined || min >= max)
    return <NumberField {...common} value={number} {...(unit === undefined ? {} : { unit })} onChange={set} />;
  return <Slider {...common} value={number} min={min} max={max} step={step} whole={isWhole(attribute)} unit={unit} onChange={set} />;
}
