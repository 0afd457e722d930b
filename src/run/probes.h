#pragma once
// Probes: a few hundred models grown before the search starts, which tell where the grammar gets to.

#include <cstdint>
#include <string>
#include <vector>

#include "model/model.h"
#include "run/scene.h"

namespace espalier {

struct Setup;

/// All probes together, as one big model.
struct Probes {
  std::vector<Instance> instances;
  std::uint32_t models = 0;
};

/// The probe of this number, grown from the scene's seed to a length between the gene limits.
Derivation grow_probe(const GeneratorGraph& graph, const Scene& scene, std::uint32_t index);

/// 256 of them, with details if `full`; fewer once they have 2 000 000 parts together.
Probes grow_probes(const GeneratorGraph& graph, const Scene& scene, bool full);

/// What share of the wanted voxels of each target mesh, and of the wanted pixels of each silhouette, some probe covers;
/// 1 where nothing is wanted.
struct ProbeReach {
  std::uint32_t models = 0;
  std::vector<double> meshes, silhouettes;  // in the order of the scene
};

/// Uses up setup.probes; grows them where there are none.
ProbeReach find_reach(Setup& setup);

/// One line per volume to be filled of which much is covered by none of the probes, and per silhouette of which no
/// wanted pixel is. Such a target may be misplaced or of another scale than the grammar.
std::vector<std::string> warn_of_reach(const Setup& setup, const ProbeReach& reach);

}  // namespace espalier
