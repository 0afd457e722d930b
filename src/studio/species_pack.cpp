#include "studio/species_pack.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/version.h"
#include "breed/usual_viability.h"
#include "io/file.h"
#include "io/image.h"
#include "run/derivation_file.h"
#include "run/find_derivation.h"
#include "run/input_files.h"
#include "run/model_files.h"
#include "run/run_folder.h"
#include "run/scene_limits.h"
#include "run/scene_toml.h"
#include "run/toml_value.h"

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
                      r.settings.strength, r.settings.least_distance, r.format);
  if (r.most_triangles) line += fmt::format(" --max-triangles {}", *r.most_triangles);
  for (const auto& [name, value] : attributes) line += fmt::format(" -D {}={}", name, value);
  return line + " --out OUT";
}

class Pack {
 public:
  Pack(const SpeciesRequest& request, MeshSource& source, Executor& executor)
      : request_(request),
        stock_(read_stock(request)),
        meshes_(load_meshes(stock_.grammar, source)),
        executor_(executor) {
    inputs_.add_grammar(stock_.grammar);
    if (stock_.favourite) favourite_name_ = inputs_.add_start(find_derivation(request.from)).name;
    find();
    settings_ = fmt::format("# Bred by Espalier {}: {}\nespalier_breed = 1\ngrammar = {}\n", kVersion,
                            summary(species_, request_.settings), quote_toml(inputs_.grammar_name()));
    if (!favourite_name_.empty()) settings_ += fmt::format("from = {}\n", quote_toml(favourite_name_));
    settings_ += fmt::format("seed = {}\ncount = {}\nstrength = {}\nleast_distance = {}\n", request_.seed,
                             request_.settings.count, format_toml(request_.settings.strength),
                             format_toml(request_.settings.least_distance));
    if (request_.most_triangles) settings_ += fmt::format("most_triangles = {}\n", *request_.most_triangles);
    settings_ += "\n[attributes]\n";
    for (const auto& [name, value] : stock_.grammar.attributes) {
      settings_ += fmt::format("{} = {}\n", quote_toml(name), quote_toml(value));
    }
  }

  SpeciesReport report() const {
    SpeciesReport report;
    report.found = static_cast<std::uint32_t>(species_.siblings.size());
    report.nearest = species_.nearest;
    report.words = summary(species_, request_.settings);
    for (const Appraisal& one : species_.appraisals) {
      report.triangles = std::max(report.triangles, static_cast<std::uint64_t>(one.measures[Measure::triangles]));
    }
    return report;
  }

  void write(const std::string& folder) {
    write_file(folder + "/" + kSpeciesMarker, settings_);
    inputs_.write(folder);
    RenderSettings look;
    look.width = request_.cell[0], look.height = request_.cell[1];
    const std::vector<Mesh> no_ghosts;
    ModelFiles files(*stock_.grammar.graph, meshes_, load_textures(stock_.grammar), no_ghosts, look, executor_);
    std::vector<SheetCell> cells;
    for (std::size_t i = 0; i < species_.siblings.size(); ++i) {
      const Derivation& sibling = species_.siblings[i];
      files.write(sibling, folder + "/" + name(i, ".derivation.json"), provenance(i));
      files.write(sibling, folder + "/" + name(i, "." + request_.format), provenance(i));
      cells.push_back({files.picture(sibling), fmt::format("{}  {} triangles", i + 1, triangles(i))});
    }
    const Picture sheet = contact_sheet(cells, fmt::format("{}: {} bred, seed {}", stock_.grammar.graph->name,
                                                           cells.size(), request_.seed));
    write_png(folder + "/species.png", sheet.width, sheet.height, sheet.rgb, provenance(0));
    write_file(folder + "/species.json", index());
  }

 private:
  void find() {
    ModelAppraiser::Settings settings;
    settings.viability = usual_viability(*stock_.grammar.graph, meshes_);
    settings.viability.limits = stock_.limits;
    settings.limits.most_parts = kMostPartsLookedAt;
    if (request_.most_triangles) {
      std::optional<double>& max = settings.viability.limits[Measure::triangles].max;
      max = std::min(max.value_or(1e18), static_cast<double>(*request_.most_triangles));
    }
    ModelAppraiser appraiser(stock_.grammar.graph, meshes_, settings, nullptr, executor_);
    BreedProblem problem;
    problem.graph = stock_.grammar.graph;
    problem.appraiser = &appraiser;
    problem.seed = request_.seed;
    species_ = find_species(problem, stock_.favourite, request_.settings);
  }

  static std::string name(std::size_t i, const std::string& ending) { return fmt::format("{:03}{}", i + 1, ending); }
  std::uint64_t triangles(std::size_t i) const {
    return static_cast<std::uint64_t>(species_.appraisals[i].measures[Measure::triangles]);
  }

  Provenance provenance(std::size_t i) const {
    Provenance p;
    p.version = kVersion;
    p.made_by = "breed";
    p.seed = request_.seed;
    p.index = i;
    p.inputs = inputs_.hashes();
    p.settings = settings_;
    p.settings_folder = ".";
    p.derivation = hash_text(species_.siblings[i]);
    return p;
  }

  std::string index() const {
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < species_.siblings.size(); ++i) {
      const Appraisal& one = species_.appraisals[i];
      models.push_back({{"file", name(i, "." + request_.format)},
                        {"derivation", name(i, ".derivation.json")},
                        {"derivation_hash", hash_text(species_.siblings[i])},
                        {"candidate", species_.drawn_as[i]},
                        {"triangles", triangles(i)},
                        {"height_m", one.measures[Measure::height]},
                        {"spread_m", one.measures[Measure::spread]}});
    }
    const nlohmann::ordered_json index = {
        {"espalier_species", 1},
        {"version", kVersion},
        {"grammar", inputs_.grammar_name()},
        {"from", favourite_name_.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(favourite_name_)},
        {"seed", request_.seed},
        {"found", species_.siblings.size()},
        {"asked", request_.settings.count},
        {"words", summary(species_, request_.settings)},
        {"least_distance_found", species_.nearest},
        {"make_again", command_line(request_, favourite_name_.empty() ? inputs_.grammar_name() : favourite_name_,
                                    favourite_name_.empty() ? "" : inputs_.grammar_name(), stock_.grammar.attributes)},
        {"inputs", inputs_.hashes()},
        {"models", models}};
    return index.dump(1) + "\n";
  }

  SpeciesRequest request_;
  Stock stock_;
  MeshTable meshes_;
  Executor& executor_;
  InputFiles inputs_;
  std::string favourite_name_;  // in the folder; empty: bred from the grammar
  std::string settings_;
  Species species_;
};

}  // namespace

SpeciesReport write_species(const SpeciesRequest& request, const std::string& out, MeshSource& source,
                            Executor& executor) {
  validate(request.settings);
  const std::array<std::string_view, 4> formats = {"glb", "obj", "ply", "stl"};
  if (std::find(formats.begin(), formats.end(), request.format) == formats.end()) {
    throw Error(fmt::format("--format must be glb, obj, ply or stl, got {}", quote_toml(request.format)));
  }
  RunFolder folder(out, kSpeciesMarker);
  Pack pack(request, source, executor);
  const SpeciesReport report = pack.report();
  if (report.found == 0) return report;
  pack.write(folder.staging());
  folder.commit();
  return report;
}

}  // namespace espalier
