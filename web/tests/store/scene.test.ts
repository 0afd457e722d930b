import { describe, expect, test } from "vitest";
import type { Scene } from "../../src/api";
import { readPreferences, PREFERENCE_DEFAULTS } from "../../src/store/preferences";
import { addMesh, changeAttribute, changeCurve, changeLimit, changeMesh, duplicateTarget, removeTarget } from "../../src/store/scene";

const scene: Scene = {
  curves: { weight: 2, curve: [{ points: [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0, 3, 0]], offset: 0.5 }] },
  volume: { form: "linear", mesh: [{ file: "a.obj" }, { file: "b.obj", position: [1, 2, 3] }] },
  limits: { genes: { max: 10 } },
};

describe("changes of a scene", () => {
  test("leave the old one as it was", () => {
    const before = JSON.stringify(scene);
    const after = changeCurve(scene, 0, { offset: 0.9, thickness: [1, 0] });
    expect(after.curves).toMatchObject({ weight: 2, curve: [{ offset: 0.9, thickness: [1, 0] }] });
    expect(after.volume).toBe(scene.volume);
    expect(JSON.stringify(scene)).toBe(before);
  });

  test("take out what is undefined, and what there is not is left alone", () => {
    expect("offset" in changeCurve(scene, 0, { offset: undefined }).curves!.curve[0]!).toBe(false);
    expect(changeCurve(scene, 5, { offset: 1 })).toBe(scene);
    expect(changeMesh({}, 0, { fill: 1 })).toEqual({});
  });

  test("remove and duplicate targets", () => {
    expect(removeTarget(scene, "curve", 0).curves).toBeUndefined();
    expect(removeTarget(scene, "mesh", 0).volume).toEqual({ form: "linear", mesh: [{ file: "b.obj", position: [1, 2, 3] }] });
    expect(duplicateTarget(scene, "mesh", 1).volume!.mesh[2]).toEqual({ file: "b.obj", position: [1.25, 2, 3] });
    expect(duplicateTarget(scene, "curve", 0).curves!.curve[1]).toMatchObject({ offset: 0.5, points: [[0.25, 0, 0], [0.25, 1, 0], [0.25, 2, 0], [0.25, 3, 0]] });
    expect(duplicateTarget(scene, "silhouette", 0)).toBe(scene);
    expect(addMesh({}, { file: "c.obj" })).toEqual({ volume: { mesh: [{ file: "c.obj" }] } });
  });

  test("of limits and attributes leave no empty tables", () => {
    expect(changeLimit(scene, "genes", undefined).limits).toBeUndefined();
    expect(changeLimit(scene, "height", { max: 3 }).limits).toEqual({ genes: { max: 10 }, height: { max: 3 } });
    const tall = changeAttribute({}, "tall", 3);
    expect(tall).toEqual({ attributes: { tall: 3 } });
    expect(changeAttribute(tall, "tall", undefined)).toEqual({});
  });
});

describe("preferences", () => {
  test("that cannot be read are the defaults", () => {
    expect(readPreferences(null)).toEqual(PREFERENCE_DEFAULTS);
    expect(readPreferences("{")).toEqual(PREFERENCE_DEFAULTS);
    expect(readPreferences("[1]")).toEqual(PREFERENCE_DEFAULTS);
    expect(readPreferences('{"theme": "pink", "left": "wide", "right": null, "folded": [1, "gene"]}')).toEqual({ ...PREFERENCE_DEFAULTS, folded: ["gene"] });
    expect(readPreferences('{"theme": "light", "left": 500}')).toMatchObject({ theme: "light", left: 500 });
  });
});
