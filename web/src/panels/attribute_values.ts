import type { Attribute, Scene, Value } from "../api";

/** The value that the scene gives an attribute, or the grammar's own. Angles are texts in a scene ("25deg") and numbers here. */
export function attributeValue(attribute: Attribute, scene: Scene): Value {
  const own = scene.attributes?.[attribute.name];
  if (own === undefined) return attribute.standard;
  if (attribute.kind === "number") {
    const number = typeof own === "string" ? Number.parseFloat(own) : Number(own);
    if (!Number.isFinite(number)) return attribute.value;
    return typeof own === "string" && own.endsWith("rad") ? (number * 180) / Math.PI : number;
  }
  return own;
}

/** As a scene has it: angles with their unit. */
export function sceneValue(attribute: Attribute, value: Value): Value {
  return attribute.kind === "number" && attribute.unit ? `${value}${attribute.unit}` : value;
}

/** "Tree/Branch over parent": the group and the label. */
export function labelOf(attribute: Attribute): { group: string; label: string } {
  const words = attribute.comment ?? "";
  const written = attribute.label ?? (words.length <= 60 && words.indexOf("/") > 0 ? words : "");
  const slash = written.indexOf("/");
  if (slash > 0) return { group: written.slice(0, slash).trim(), label: written.slice(slash + 1).trim() || attribute.name };
  return { group: "", label: written || attribute.name };
}

export function isWhole(attribute: Attribute): boolean {
  const { step, min, standard } = attribute;
  return step !== undefined && [step, min ?? 0, standard].every((one) => typeof one === "number" && Number.isInteger(one));
}
