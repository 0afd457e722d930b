// What the mock server begins with.
import type { Scene } from "../../src/api";

export const TREE = `grammar guided_tree 1
# A branch bends, shrinks and forks at its tip into one to three, or ends in a leaf.
attr tufts = false "Leaves/In tufts"
attr shrink in 0.5..0.85 by 0.05 = 0.7 "Tree/Branch over parent"
attr forks in 1..24 by 1 = 10 "Tree/Forks at most"
attr lean in 0deg..40deg = 5deg "Tree/Leans"
material bark = surface("#6b5344", roughness: 0.95)
material green = surface("#9cc46a", roughness: 0.8)
start Stem

rule Stem { turn z lean  spawn Branch }

# A branch with its bone.
rule Branch when depth(Branch) < forks {
  grow ~ uniform(0.9, 1.3)
  spin ~ angle()
  bend ~ uniform(0deg, 80deg)
  turn y spin  turn x bend  scale shrink * grow
  bone (0, 0, 0) -> (0, 1, 0)
  { move y 0.5  size (0.24, 1.04, 0.24)  paint bark  emit cone(top: 0.78, sides: 12) }
  move y 1  maybe 0.8 spawn Fork else detail Leaf otherwise detail Leaf
}

# One branch that must stand here, and two that may.
rule Fork {
  spawn Branch else detail Leaf otherwise detail Leaf
  for k in 1..2 { maybe 0.5 spawn Branch otherwise detail Leaf }
}

detail Leaf {
  tone ~ uniform(0, 1)
  tilt ~ uniform(-25deg, 25deg)
  turn y tilt  scale tone + 0.5
  paint green
  for k in -2..2 { turn z 55deg * k  move y 0.42  size (0.5, 0.86 - 0.08 * abs(k), 1)  emit leaf }
}
`;

export const EMPTY = `grammar empty 1
start Thing

rule Thing {
  size 1  move y 0.5  emit box
}
`;

export const TREE_SCENE: Scene = {
  seed: 2,
  attributes: { shrink: 0.8, forks: 18 },
  search: { engine: "guided" },
  engine: { guided: { steps: 160, particles: 500, temperature: 1000 } },
  limits: { genes: { min: 1, max: 2000 } },
  curves: {
    curve: [
      { points: [[0, 0, 0], [3.6, 1.5, 0], [-3.6, 3.3, 0], [0.9, 5.6, 0]], distance: [0, 0, 4000], alignment: 3000, offset: 0.9, utilisation: 1000 },
      { points: [[1, 1.25, 0], [1.9, 1.5, 0.2], [2.5, 1.7, 0.5], [3.4, 2.3, 0.6]], distance: [0, 0, 2500], alignment: 3000, offset: 0.9, utilisation: 1000 },
    ],
  },
  volume: { mesh: [{ file: "shapes/sphere.obj", fill: -2, spill: 0, position: [0, 1.5, 0] }] },
};
