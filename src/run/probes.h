#pragma once
// Probes: a few hundred models grown before the search starts, which tell where the grammar gets to.

#include <string>
#include <vector>

#include "run/setup.h"

namespace espalier {

/// The instances of all probes, grown to lengths between the gene limits from the scene's seed, with details if `full`.
std::vector<Instance> probe_instances(const GeneratorGraph& graph, const Scene& scene, bool full);

/// One line per volume to be filled of which much is covered by none of the probes, and per silhouette of which no
/// wanted pixel is. Such a target may be misplaced or of another scale than the grammar.
std::vector<std::string> warn_of_reach(const Setup& setup);

}  // namespace espalier
