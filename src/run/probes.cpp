#include "run/probes.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/counted.h"
#include "derivation/moves.h"
#include "derivation/sample.h"
#include "model/expand.h"
#include "run/setup.h"

namespace espalier {
namespace {

constexpr std::uint32_t kProbes = 256;
constexpr std::uint32_t kLongestProbe = 400;       // genes; more tell nothing new and cost time
constexpr std::size_t kMostInstances = 2'000'000;  // of all probes; a budget for grammars whose models are huge
constexpr double kWorthWarning = 0.25;             // share of a target that no probe covers

}  // namespace

Derivation grow_probe(const GeneratorGraph& graph, const Scene& scene, std::uint32_t index) {
  const GeneLimits& limits = scene.search.ga.genes;
  const std::uint32_t longest = std::max(limits.min, std::min(limits.max, kLongestProbe));
  RandomStream random({scene.seed, Purpose::probe, 0, index, 0});
  Derivation derivation = seedling(graph, random);
  close_open_slots(graph, derivation, random);
  const std::uint32_t length = limits.min + random.below(longest - limits.min + 1);
  while (derivation.size() < length && grow(graph, derivation, {}, random)) {}
  return derivation;
}

Probes grow_probes(const GeneratorGraph& graph, const Scene& scene, bool full) {
  Probes probes;
  Expander expander(graph, {.make_materials = false});
  Model model;
  while (probes.models < kProbes && probes.instances.size() < kMostInstances) {
    expander.expand(grow_probe(graph, scene, probes.models), full ? ExpandTo::full : ExpandTo::parts, model);
    probes.instances.insert(probes.instances.end(), model.instances.begin(), model.instances.end());
    ++probes.models;
  }
  return probes;
}

ProbeReach find_reach(Setup& setup) {
  if (setup.silhouettes.empty() && !setup.volume) return {};
  const bool full = setup.objective.view() == TargetView::full;
  const Probes probes = setup.probes ? std::move(*setup.probes) : grow_probes(setup.graph(), setup.scene, full);
  setup.probes.reset();
  ProbeReach reach;
  reach.models = probes.models;
  const auto share = [](std::uint64_t part, std::uint64_t of) {
    return of > 0 ? static_cast<double>(part) / static_cast<double>(of) : 1.0;
  };
  for (const SilhouetteTarget* target : setup.silhouettes) {
    const auto scratch = target->make_scratch();
    const std::vector<std::int32_t>& degrees = target->settings().image.degrees;
    const auto wanted = std::count_if(degrees.begin(), degrees.end(), [](std::int32_t degree) { return degree > 0; });
    reach.silhouettes.push_back(
        share(target->counts(probes.instances, *scratch).wanted, static_cast<std::uint64_t>(wanted)));
  }
  if (!setup.volume) return reach;
  const auto scratch = setup.volume->make_scratch();
  const VolumeCounts counts = setup.volume->counts(probes.instances, *scratch);
  for (std::size_t i = 0; i < counts.inside.size(); ++i)
    reach.meshes.push_back(share(counts.inside[i], setup.volume->target_voxels(i)));
  return reach;
}

std::vector<std::string> warn_of_reach(const Setup& setup, const ProbeReach& reach) {
  std::vector<std::string> warnings;
  const std::string models = counted(reach.models, "model");
  for (std::size_t i = 0; i < setup.silhouettes.size(); ++i) {
    const SilhouetteSettings& silhouette = setup.silhouettes[i]->settings();
    if (reach.silhouettes[i] > 0 || silhouette.want == 0) continue;
    warnings.push_back(fmt::format("{}: none of {} grown from the grammar reached any of what is wanted; does the "
                                   "camera look at where it builds?", silhouette.name, models));
  }
  for (std::size_t i = 0; i < reach.meshes.size(); ++i) {
    const VolumeMesh& mesh = setup.volume->settings().meshes[i];
    const double missed = 1 - reach.meshes[i];
    if (!(mesh.fill > 0) || missed < kWorthWarning) continue;
    warnings.push_back(fmt::format("{}: {} of it lies where none of {} grown from the grammar reached; is it in "
                                   "the place and size that the grammar builds?", mesh.name,
                                   missed > 0.995 ? "all" : fmt::format("{:.0f} %", 100 * missed), models));
  }
  return warnings;
}

}  // namespace espalier
