#include "run/probes.h"

#include <algorithm>

#include <fmt/format.h>

#include "derivation/moves.h"
#include "derivation/sample.h"
#include "model/expand.h"

namespace espalier {
namespace {

constexpr std::uint32_t kProbes = 256;
constexpr std::uint32_t kLongestProbe = 400;  // genes; more tell nothing new and cost time
constexpr double kWorthWarning = 0.25;        // share of a target that no probe covers

}  // namespace

std::vector<Instance> probe_instances(const GeneratorGraph& graph, const Scene& scene, bool full) {
  const GeneLimits& limits = scene.search.ga.genes;
  const std::uint32_t longest = std::max(limits.min, std::min(limits.max, kLongestProbe));
  std::vector<Instance> all;
  Expander expander(graph, {.make_materials = false});
  Model model;
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    RandomStream random({scene.seed, Purpose::probe, 0, i, 0});
    Derivation derivation = seedling(graph, random);
    close_open_slots(graph, derivation, random);
    const std::uint32_t length = limits.min + random.below(longest - limits.min + 1);
    while (derivation.size() < length && grow(graph, derivation, {}, random)) {}
    expander.expand(derivation, full ? ExpandTo::full : ExpandTo::parts, model);
    all.insert(all.end(), model.instances.begin(), model.instances.end());
  }
  return all;
}

namespace {

// To a volume target, and to a silhouette, all probes together are one big model.
void warn_of_silhouettes(const Setup& setup, std::span<const Instance> instances, std::vector<std::string>& warnings) {
  for (const SilhouetteTarget* target : setup.silhouettes) {
    const auto scratch = target->make_scratch();
    if (target->counts(instances, *scratch).wanted > 0 || target->settings().want == 0) continue;
    warnings.push_back(
        fmt::format("{}: none of {} models grown from the grammar reached any of what is wanted; does the "
                    "camera look at where it builds?",
                    target->name(), kProbes));
  }
}

}  // namespace

std::vector<std::string> warn_of_reach(const Setup& setup) {
  const std::vector<Instance> instances = probe_instances(setup.graph(), setup.scene, setup.full());
  std::vector<std::string> warnings;
  warn_of_silhouettes(setup, instances, warnings);
  if (!setup.volume) return warnings;
  const auto scratch = setup.volume->make_scratch();
  const VolumeCounts counts = setup.volume->counts(instances, *scratch);
  for (std::size_t i = 0; i < setup.targets.size(); ++i) {
    const VolumeMesh& mesh = setup.volume->settings().meshes[i];
    const auto voxels = static_cast<double>(setup.volume->target_voxels(i));
    const double missed = 1 - static_cast<double>(counts.inside[i]) / voxels;
    if (!(mesh.fill > 0) || missed < kWorthWarning) continue;
    warnings.push_back(fmt::format("{}: {} of it lies where none of {} models grown from the grammar reached; is it in "
                                   "the place and size that the grammar builds?",
                                   mesh.name, missed > 0.995 ? "all" : fmt::format("{:.0f} %", 100 * missed), kProbes));
  }
  return warnings;
}

}  // namespace espalier
