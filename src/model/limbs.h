#pragma once
// Limbs: chains of cones and cylinders that touch end to end, as trunks, branches and roots are made of, whoever made
// them, rules or details. No bones are needed: what touches belongs together.

#include <cstdint>
#include <vector>

#include "model/model.h"

namespace espalier {

/// A point of a limb's axis and how thick the limb is there, m.
struct LimbJoint {
  Vec3 at{0};
  float radius = 0;
};

struct Limb {
  std::vector<LimbJoint> joints;     // from base to tip, at least two
  std::vector<std::uint32_t> parts;  // indices into Model::instances, from base to tip; one fewer than joints
  std::uint16_t material = 0;
  float depth = 0;  // m from the base, along the limb, to the surface of the limb that it leaves; 0: it leaves none
  float host = 0;   // m, the radius of that one there
};

struct Limbs {
  static constexpr std::uint32_t kNone = 0xffffffffu;

  std::vector<Limb> limbs;                // in the order of their first parts
  std::vector<std::uint32_t> limb_of;     // per instance: which limb shows it; kNone: no limb
};

/// The limbs of what `full` (else: parts) shows. A span is a cone or cylinder that is round and not sheared. It goes on
/// another where its base stands within 0.6 tip radii of that one's tip, it has the same material, turns by less than
/// 75 degrees and is 0.3 to 1.7 times as wide there; of several the most alike goes on, the others leave. Spans that
/// come later in the model go on those that come before. A sphere within a limb's joint, no wider than it, belongs to
/// the limb: it only rounded the joint off.
Limbs find_limbs(const Model& model, const MeshTable& meshes, bool full = true);

}  // namespace espalier
