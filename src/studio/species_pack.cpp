#include "studio/species_pack.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "breed/appraiser.h"
#include "breed/usual_viability.h"
#include "model/expand.h"
#include "model/surfaces.h"
#include "run/derivation_file.h"
#include "run/find_derivation.h"
#include "run/mesh_look.h"
#include "run/run_folder.h"
#include "run/scene_limits.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kMostPartsLookedAt = 400'000;

/// What is bred: a grammar, perhaps a favourite, perhaps limits.
struct Stock {
  LoadedGrammar grammar;
  std::optional<Derivation> favourite;
  Limits limits;
};

Stock read_stock(const SpeciesRequest& request) {
  const std::string& from = request.from;
  Stock stock;
  if (from.ends_with(".esp")) {
    stock.grammar = load_grammar(from, request.attributes);
    return stock;
  }
  if (from.ends_with(".toml")) {
    const Scene scene = load_scene(from, {});
    std::map<std::string, std::string> attributes = scene.attributes;
    for (const auto& [name, value] : request.attributes) attributes[name] = value;
    stock.grammar = load_grammar((fs::path(scene.folder) / scene.grammar).string(), attributes);
    stock.limits = limits_of(scene);
    return stock;
  }
  LoadedDerivation loaded = load_derivation(find_derivation(from), request.grammar, request.attributes);
  stock.grammar = std::move(loaded.grammar);
  stock.favourite = std::move(loaded.derivation);
  return stock;
}

std::string command_line(const SpeciesRequest& r, const std::string& from, const std::string& grammar,
                         const std::map<std::string, std::string>& attributes) {
  std::string line = fmt::format("espalier breed --from {}", from);
  if (!grammar.empty()) line += " --grammar " + grammar;
  line += fmt::format(" --count {} --seed {} --strength {} --least-distance {} --format {}", r.settings.count, r.seed,
                      r.settings.strength, r.settings.least_distance, r.form.format);
  if (r.form.detail) line += fmt::format(" --joints {}", name_of(r.form.detail->joints));
  if (r.form.detail && !r.form.all_levels) line += fmt::format(" --lod {}", r.form.detail->level);
  if (r.form.all_levels) line += " --lods";
  if (r.most_triangles) line += fmt::format(" --max-triangles {}", *r.most_triangles);
  for (const auto& [name, value] : attributes) line += fmt::format(" -D {}={}", name, value);
  return line + " --out OUT";
}

/// Refuses what has too many triangles as its files are made, where these are not the grammar's own parts.
class LevelAppraiser final : public Appraiser {
 public:
  LevelAppraiser(Appraiser& others, const GeneratorGraph& graph, const MeshTable& meshes, const LevelOfDetail& detail,
                 std::uint64_t most, Executor& executor)
      : others_(others), graph_(graph), meshes_(meshes), detail_(detail), most_(most), executor_(executor) {
    for (int i = 0; i < executor.workers(); ++i) workers_.push_back(std::make_unique<Worker>(graph));
  }

  std::vector<Appraisal> appraise(std::span<const Derivation* const> candidates) override {
    std::vector<Appraisal> appraisals = others_.appraise(candidates);
    executor_.for_each(candidates.size(), [&](std::size_t i, int which) {
      if (!appraisals[i].viable) return;
      auto& [expander, model] = *workers_[static_cast<std::size_t>(which)];
      expander.expand(*candidates[i], ExpandTo::full, model);
      const std::uint64_t triangles = most_triangles_at(model, meshes_, materials_of(graph_, model), detail_);
      if (triangles <= most_) return;
      appraisals[i].viable = false;
      appraisals[i].reasons.push_back(describe_rejection(Measure::triangles, {.max = static_cast<double>(most_)},
                                                         static_cast<double>(triangles)));
    });
    return appraisals;
  }
  const std::vector<std::string>& feature_names() const override { return others_.feature_names(); }
  bool has_targets() const override { return others_.has_targets(); }

 private:
  struct Worker {
    explicit Worker(const GeneratorGraph& graph) : expander(graph) {}
    Expander expander;
    Model model;
  };

  Appraiser& others_;
  const GeneratorGraph& graph_;
  const MeshTable& meshes_;
  const LevelOfDetail detail_;
  const std::uint64_t most_;
  Executor& executor_;
  std::vector<std::unique_ptr<Worker>> workers_;
};

/// The one that a limit of triangles is about; none: parts as the grammar makes them.
std::optional<LevelOfDetail> finest_level(const SpeciesForm& form) {
  if (!form.all_levels) return form.detail;
  LevelOfDetail finest = form.detail.value_or(LevelOfDetail{});
  finest.level = 0;
  return finest;
}

Species find(const SpeciesRequest& request, const Stock& stock, const MeshTable& meshes, Executor& executor) {
  const std::optional<LevelOfDetail> level = finest_level(request.form);
  ModelAppraiser::Settings settings;
  settings.viability = usual_viability(*stock.grammar.graph, meshes);
  settings.viability.limits = stock.limits;
  settings.limits.most_parts = kMostPartsLookedAt;
  if (request.most_triangles && !level) {
    std::optional<double>& max = settings.viability.limits[Measure::triangles].max;
    max = std::min(max.value_or(1e18), static_cast<double>(*request.most_triangles));
  }
  ModelAppraiser appraiser(stock.grammar.graph, meshes, settings, nullptr, executor);
  BreedProblem problem;
  problem.graph = stock.grammar.graph;
  problem.appraiser = &appraiser;
  problem.seed = request.seed;
  std::optional<LevelAppraiser> at_level;
  if (request.most_triangles && level) {
    at_level.emplace(appraiser, *stock.grammar.graph, meshes, *level, *request.most_triangles, executor);
    problem.appraiser = &*at_level;
  }
  return find_species(problem, stock.favourite, request.settings);
}

std::string settings_of(const SpeciesRequest& request) {
  std::string text;
  if (request.most_triangles) text += fmt::format("most_triangles = {}\n", *request.most_triangles);
  if (request.form.detail) text += to_toml(*request.form.detail);
  if (request.form.all_levels) text += "all_levels = true\n";
  return text;
}

}  // namespace

SpeciesReport write_species(const SpeciesRequest& request, const std::string& out, MeshSource& source,
                            Executor& executor) {
  validate(request.settings);
  validate(request.form);
  RunFolder folder(out, kSpeciesMarker);
  const Stock stock = read_stock(request);
  const MeshTable meshes = load_meshes(stock.grammar, source);
  const TextureTable textures = load_textures(stock.grammar);
  InputFiles inputs;
  inputs.add_grammar(stock.grammar);
  const std::string favourite = stock.favourite ? inputs.add_start(find_derivation(request.from)).name : "";
  const Species species = find(request, stock, meshes, executor);
  SpeciesReport report;
  report.found = static_cast<std::uint32_t>(species.siblings.size());
  report.nearest = species.nearest;
  report.words = summary(species, request.settings);
  if (report.found == 0) return report;
  const std::string& grammar = inputs.grammar_name();
  const std::string again = favourite.empty() ? command_line(request, grammar, "", stock.grammar.attributes)
                                              : command_line(request, favourite, grammar, stock.grammar.attributes);
  const SpeciesOrigin origin{stock.grammar, meshes, textures, inputs, favourite, again, settings_of(request), request.seed};
  report.triangles = write_species_files(origin, species, request.settings, request.form, folder.staging(), executor);
  folder.commit();
  return report;
}

}  // namespace espalier
