// The words of the language (docs/language.md), with what completion and hovering say of them.

export type WordSort = "keyword" | "value" | "distribution" | "function" | "primitive" | "surface" | "texture" | "axis";

export interface Word {
  name: string;
  sort: WordSort;
  /** As one would write it. */
  signature: string;
  text: string;
}

const list: readonly [WordSort, string, string][] = [
  ["keyword", "grammar NAME 1", "The first line: name of the grammar and version of the language."],
  ["keyword", "import \"FILE\"", "Adds the declarations of another grammar, except its start."],
  ["keyword", "start NAME", "The rule of the first gene."],
  ["keyword", "const NAME = VALUE", "A value known before everything else."],
  ["keyword", "fn NAME(PARAMETERS) = VALUE", "A pure function."],
  ["keyword", "attr NAME in LOW..HIGH by STEP = VALUE \"Group/Label\"", "A value that a person sets."],
  ["keyword", "mesh NAME = MESH", "A primitive or a file."],
  ["keyword", "material NAME = SURFACE", "A surface with a name."],
  ["keyword", "rule NAME(PARAMETERS) limit N when GUARD { .. }", "One use of a rule is one gene of the model."],
  ["keyword", "detail NAME(PARAMETERS) { .. }", "Decoration that is not searched over; in a rule: shows it."],
  ["keyword", "let NAME = VALUE", "Names a value."],
  ["keyword", "if CONDITION { .. } else { .. }", "In a rule the condition is constant, or the block holds no draw, slot, choice or bone."],
  ["keyword", "else", "What is shown or done otherwise; of a slot: where it is empty."],
  ["keyword", "for NAME in LOW..HIGH { .. }", "Repeats a block; both ends are included."],
  ["keyword", "choose { WEIGHT: { .. } .. }", "One of several alternatives by weight."],
  ["keyword", "maybe CHANCE spawn RULE", "A slot that is filled with that chance."],
  ["keyword", "spawn RULE", "A slot in which a child stands."],
  ["keyword", "otherwise detail DETAIL", "Shown where a search stopped before it decided."],
  ["keyword", "mirror AXIS { .. }", "Shows the block and its mirror image; both share their genes."],
  ["keyword", "around AXIS COUNT { .. }", "Shows the block several times around the axis; all share their genes."],
  ["keyword", "split AXIS { SIZE: { .. } .. }", "Cuts the scope along an axis: 2, 20%, ~1 or repeat 3."],
  ["keyword", "comp { FACE: { .. } .. }", "Visits faces of the scope: front back right left top bottom, sides, all."],
  ["keyword", "repeat SIZE", "In split: as many tiles as fit."],
  ["keyword", "move VECTOR", "Moves by a vector, or along one axis: move y 2."],
  ["keyword", "turn AXIS ANGLE", "Turns about an axis: turn y 30deg."],
  ["keyword", "scale FACTOR", "Scales the frame, and so everything below."],
  ["keyword", "size VECTOR", "The dimensions of this part."],
  ["keyword", "resize FACTOR", "Multiplies the dimensions of this part."],
  ["keyword", "reflect AXIS", "Turns an axis around."],
  ["keyword", "aim AXIS toward DIRECTION by SHARE", "Turns an axis towards a direction, or with at towards a point."],
  ["keyword", "toward", "aim y toward (0, 1, 0)"],
  ["keyword", "at", "aim y at (0, 3, 0)"],
  ["keyword", "by", "A step, or how much of a turn."],
  ["keyword", "forward LENGTH", "The turtle: move y."],
  ["keyword", "yaw ANGLE", "The turtle: turn z, to the left."],
  ["keyword", "pitch ANGLE", "The turtle: turn x, up."],
  ["keyword", "roll ANGLE", "The turtle: turn y."],
  ["keyword", "extrude LENGTH", "Gives a face thickness."],
  ["keyword", "paint MATERIAL", "The material of all parts that follow."],
  ["keyword", "reseed VALUE", "Equal values, equal details."],
  ["keyword", "bone FROM -> TO", "Records a bone, which guiding curves look at."],
  ["keyword", "emit MESH", "A part of the model; as is keeps a file's coordinates, as proxy stands in for details."],
  ["keyword", "as", "emit MESH as is, emit MESH as proxy"],
  ["keyword", "is", "emit MESH as is"],
  ["keyword", "proxy", "emit MESH as proxy"],
  ["keyword", "in", "for NAME in LIST, attr NAME in LOW..HIGH"],
  ["keyword", "limit N", "At most so many genes of a rule."],
  ["keyword", "when GUARD", "Where it fails, the slot is absent."],
  ["keyword", "and", "Both."],
  ["keyword", "or", "One of them or both."],
  ["keyword", "not", "The opposite."],
  ["keyword", "mod", "a mod b has the sign of b."],
  ["keyword", "true", "A boolean."],
  ["keyword", "false", "A boolean."],
  ["value", "scope", "The size now: a vector."],
  ["value", "depth", "Genes above this one; depth(R): those that are R's."],
  ["value", "childless", "True where no slot of the gene is filled."],
  ["distribution", "uniform(a, b)", "A number, angle or vector, evenly between a and b."],
  ["distribution", "normal(mean, deviation, low, high)", "A truncated normal: numbers or angles."],
  ["distribution", "loguniform(a, b)", "Evenly in the logarithm; above 0."],
  ["distribution", "integer(a, b)", "A whole number, both ends included."],
  ["distribution", "angle()", "0deg to 360deg, circular."],
  ["distribution", "chance(p)", "True with probability p."],
  ["distribution", "pick(a, 3: b)", "One of several values; 3 is a weight."],
  ["function", "vec(a)", "A vector of three equal numbers."],
  ["function", "length(v)", "Length of a vector."],
  ["function", "normalize(v)", "The vector of length 1."],
  ["function", "dot(a, b)", "Scalar product."],
  ["function", "cross(a, b)", "Vector product."],
  ["function", "floor(a)", "The next whole number below."],
  ["function", "ceil(a)", "The next whole number above."],
  ["function", "round(a)", "The nearest whole number."],
  ["function", "sqrt(a)", "Square root."],
  ["function", "exp(a)", "e to the power of a."],
  ["function", "log(a)", "Natural logarithm."],
  ["function", "abs(a)", "Without its sign."],
  ["function", "min(a, b)", "The smaller one."],
  ["function", "max(a, b)", "The larger one."],
  ["function", "clamp(a, low, high)", "a, kept between low and high."],
  ["function", "mix(a, b, t)", "a at t = 0, b at t = 1: numbers, angles, vectors, materials."],
  ["function", "smooth(low, high, a)", "0 below low, 1 above high, a smooth curve between."],
  ["function", "sin(angle)", "Sine."],
  ["function", "cos(angle)", "Cosine."],
  ["function", "tan(angle)", "Tangent."],
  ["function", "asin(a)", "The angle whose sine is a."],
  ["function", "acos(a)", "The angle whose cosine is a."],
  ["function", "atan2(y, x)", "The angle of a direction."],
  ["primitive", "box", "A unit box."],
  ["primitive", "sphere", "A ball in a unit box."],
  ["primitive", "pyramid", "A pyramid in a unit box."],
  ["primitive", "wedge", "A ramp that rises towards +z."],
  ["primitive", "cylinder(sides: 24)", "A cylinder along y; sides 3..1024."],
  ["primitive", "cone(top: 0, sides: 24)", "A cone along y; top is the width of its upper end."],
  ["primitive", "quad", "A flat square that faces z."],
  ["primitive", "leaf", "A flat leaf that faces z."],
  ["surface", "surface(color, roughness, metal, opacity, glow, cutout, two_sided, texture, tiles, tiles_up)", "A material."],
  ["texture", "image_texture(file)", "A picture file: PNG or JPG."],
  ["texture", "bark_texture(dark, light, furrows, contrast, waves, cracks, bands, seed)", "Bark."],
  ["texture", "leaf_texture(color, vein, width, tip, teeth, lobes, veins, wilt, seed)", "A leaf with its stem, for quad with cutout."],
  ["texture", "noise_texture(a, b, cells, octaves, contrast, warp, ridges, stretch, seed)", "Clouds from one colour to another."],
  ["axis", "x", "To the right."],
  ["axis", "y", "Up."],
  ["axis", "z", "Towards you."],
];

export const WORDS: readonly Word[] = list.map(([sort, signature, text]) => ({
  name: /^\w+/.exec(signature)![0],
  sort,
  signature,
  text,
}));

const byName = new Map(WORDS.map((word) => [word.name, word]));

export function findWord(name: string): Word | undefined {
  return byName.get(name);
}

export const FACES = ["front", "back", "right", "left", "top", "bottom", "sides", "all"] as const;
export const UNITS = ["deg", "rad", "m", "cm", "mm", "%"] as const;
/** Keywords that may begin a statement, and a declaration. */
export const STATEMENT_WORDS = [
  "aim", "around", "bone", "choose", "comp", "detail", "emit", "extrude", "for", "forward", "if", "let", "maybe", "mirror", "move",
  "paint", "pitch", "reflect", "reseed", "resize", "roll", "scale", "size", "spawn", "split", "turn", "yaw",
] as const;
export const DECLARATION_WORDS = ["attr", "const", "detail", "fn", "import", "material", "mesh", "rule", "start"] as const;
