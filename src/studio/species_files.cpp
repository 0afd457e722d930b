#include "studio/species_files.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/version.h"
#include "io/file.h"
#include "io/image.h"
#include "run/mesh_look.h"
#include "run/model_files.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

class SpeciesWriter {
 public:
  SpeciesWriter(const SpeciesOrigin& origin, const Species& species, const SpeciesSettings& settings,
                const SpeciesForm& form, Executor& executor)
      : origin_(origin),
        species_(species),
        settings_(settings),
        form_(form),
        toml_(recipe()),
        files_(*origin.grammar.graph, origin.meshes, origin.textures, no_ghosts_, look(form), executor) {}

  std::uint64_t write(const std::string& folder) {
    write_file(folder + "/" + kSpeciesMarker, toml_);
    origin_.inputs.write(folder);
    nlohmann::ordered_json models = nlohmann::ordered_json::array();
    std::vector<SheetCell> cells;
    std::uint64_t most = 0;
    for (std::size_t i = 0; i < species_.siblings.size(); ++i) {
      const Derivation& sibling = species_.siblings[i];
      nlohmann::ordered_json model = index_of(i);
      files_.write(sibling, folder + "/" + name(i, ".derivation.json"), provenance(i));
      const std::uint64_t finest = write_model(i, folder, model);
      most = std::max(most, finest);
      cells.push_back({files_.picture(sibling), fmt::format("{}  {} triangles", i + 1, finest)});
      models.push_back(std::move(model));
    }
    const Picture sheet = contact_sheet(cells, fmt::format("{}: {} bred, seed {}", origin_.grammar.graph->name,
                                                           cells.size(), origin_.seed));
    write_png(folder + "/species.png", sheet.width, sheet.height, sheet.rgb, provenance(0));
    write_file(folder + "/species.json", index(models));
    return most;
  }

 private:
  static RenderSettings look(const SpeciesForm& form) {
    RenderSettings settings;
    settings.width = form.cell[0], settings.height = form.cell[1];
    return settings;
  }

  std::string recipe() const {
    std::string text = fmt::format("# Bred by Espalier {}: {}\nespalier_breed = 1\ngrammar = {}\n", kVersion,
                                   summary(species_, settings_), quote_toml(origin_.inputs.grammar_name()));
    if (!origin_.favourite.empty()) text += fmt::format("from = {}\n", quote_toml(origin_.favourite));
    text += fmt::format("seed = {}\ncount = {}\nstrength = {}\nleast_distance = {}\n", origin_.seed, settings_.count,
                        format_toml(settings_.strength), format_toml(settings_.least_distance));
    text += origin_.settings + "\n[attributes]\n";
    for (const auto& [attribute, value] : origin_.grammar.attributes) {
      text += fmt::format("{} = {}\n", quote_toml(attribute), quote_toml(value));
    }
    return text;
  }

  static std::string name(std::size_t i, const std::string& ending) { return fmt::format("{:03}{}", i + 1, ending); }

  /// One file or one per level; what there is to say of them goes into `model`. Triangles of the finest.
  std::uint64_t write_model(std::size_t i, const std::string& folder, nlohmann::ordered_json& model) {
    const std::string file = name(i, "." + form_.format), path = folder + "/" + file;
    Provenance as = provenance(i);
    if (!form_.all_levels) {
      if (form_.detail) as.mesh = to_toml(*form_.detail);
      model["file"] = file;
      return model["triangles"] = files_.write(species_.siblings[i], path, as);
    }
    const auto levels = files_.write_levels(species_.siblings[i], path, form_.detail.value_or(LevelOfDetail{}), as);
    model["file"] = levels[0].name, model["triangles"] = levels[0].triangles;
    for (const auto& [level, triangles] : levels) model["levels"].push_back({{"file", level}, {"triangles", triangles}});
    return levels[0].triangles;
  }

  nlohmann::ordered_json index_of(std::size_t i) const {
    const Appraisal& one = species_.appraisals[i];
    return {{"derivation", name(i, ".derivation.json")},
            {"derivation_hash", hash_text(species_.siblings[i])},
            {"candidate", species_.drawn_as[i]},
            {"height_m", one.measures[Measure::height]},
            {"spread_m", one.measures[Measure::spread]}};
  }

  Provenance provenance(std::size_t i) const {
    return provenance_in_folder("breed", origin_.seed, i, origin_.inputs, toml_, species_.siblings[i]);
  }

  std::string index(const nlohmann::ordered_json& models) const {
    using Json = nlohmann::ordered_json;
    const auto or_null = [](const std::string& text) { return text.empty() ? Json() : Json(text); };
    const Json index = {{"espalier_species", 1},
                        {"version", kVersion},
                        {"grammar", origin_.inputs.grammar_name()},
                        {"from", or_null(origin_.favourite)},
                        {"seed", origin_.seed},
                        {"found", species_.siblings.size()},
                        {"asked", settings_.count},
                        {"words", summary(species_, settings_)},
                        {"least_distance_found", species_.nearest},
                        {"make_again", or_null(origin_.make_again)},
                        {"inputs", origin_.inputs.hashes()},
                        {"models", models}};
    return index.dump(1) + "\n";
  }

  const SpeciesOrigin& origin_;
  const Species& species_;
  const SpeciesSettings& settings_;
  const SpeciesForm& form_;
  const std::string toml_;
  const std::vector<Mesh> no_ghosts_;
  ModelFiles files_;
};

}  // namespace

void validate(const SpeciesForm& form) {
  const std::array<std::string_view, 4> formats = {"glb", "obj", "ply", "stl"};
  if (std::find(formats.begin(), formats.end(), form.format) == formats.end()) {
    throw Error(fmt::format("--format must be glb, obj, ply or stl, got {}", quote_toml(form.format)));
  }
}

std::uint64_t write_species_files(const SpeciesOrigin& origin, const Species& species, const SpeciesSettings& settings,
                                  const SpeciesForm& form, const std::string& folder, Executor& executor) {
  return SpeciesWriter(origin, species, settings, form, executor).write(folder);
}

}  // namespace espalier
