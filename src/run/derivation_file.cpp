#include "run/derivation_file.h"

#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "base/error.h"
#include "base/hash.h"
#include "base/version.h"
#include "derivation/adapt.h"
#include "derivation/encode.h"
#include "io/file.h"
#include "run/find_grammar.h"
#include "run/mesh_look.h"
#include "run/model_files.h"
#include "run/sample.h"
#include "run/scene_scorer.h"
#include "run/scene_toml.h"
#include "run/setup.h"
#include "run/toml_section.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostDerivationBytes = 1ull << 30;

/// `adapted`: attributes of the grammar were set anew, so what their guards refuse is cut and counted there.
Derivation read_derivation(const GeneratorGraph& graph, const std::string& path, AdaptedGenes* adapted) {
  try {
    const std::string text = read_file(path, kMostDerivationBytes);
    if (!adapted) return decode(graph, text);
    std::optional<Adapted> fitting = adapt(graph, decode(graph, text, 4'000'000, Fit::adaptable));
    if (!fitting) throw Error("nothing of the derivation can stand with these attributes");
    *adapted = {fitting->cut, fitting->grown};
    return std::move(fitting->derivation);
  } catch (const Error& error) {
    const std::string message = error.what();
    throw Error(message.starts_with(path) ? message : path + ": " + message);
  }
}

std::optional<Provenance> provenance_of(const std::string& path) {
  try {
    return read_provenance(path);
  } catch (const Error&) {
    return std::nullopt;  // a derivation may come from anywhere
  }
}

/// Which grammar settings name, and the attributes that they set.
struct NamedGrammar {
  std::string path;
  std::map<std::string, std::string> attributes;
};

NamedGrammar grammar_named_by(const std::string& settings, const std::string& name, const std::string& folder) {
  const auto in_folder = [&](const std::string& path) { return (fs::path(folder) / path).string(); };
  const TomlValue root = parse_toml(settings, name);
  if (root.find("espalier_sample")) {
    const SampleRequest request = parse_sample_request(settings, name, folder);
    return {in_folder(request.grammar), request.attributes};
  }
  if (root.find("espalier_breed")) {
    TomlSection bred(root, name, "");
    std::map<std::string, std::string> set;
    if (const TomlValue* table = bred.table("attributes")) {
      TomlSection values(*table, name, "attributes");
      for (const auto& [attribute, value] : table->members) set[attribute] = values.text(attribute).value_or("");
    }
    return {in_folder(bred.text("grammar").value_or("")), set};
  }
  const Scene scene = parse_scene(settings, name, folder);
  return {in_folder(scene.grammar), scene.attributes};
}

LoadedGrammar load_with(const NamedGrammar& named, const std::map<std::string, std::string>& attributes) {
  std::map<std::string, std::string> set = named.attributes;
  for (const auto& [attribute, value] : attributes) set[attribute] = value;
  return load_grammar(named.path, set);
}

/// Of a derivation that nobody named a grammar for: that of its settings, or one that lies near it.
LoadedGrammar grammar_of(const std::string& path, const std::map<std::string, std::string>& attributes) {
  const std::optional<Provenance> provenance = provenance_of(path);
  if (!provenance || provenance->settings.empty()) return find_grammar(path, {}, attributes);
  const NamedGrammar named = grammar_named_by(provenance->settings, path + " (its settings)",
                                              settings_folder_of(path, *provenance));
  std::error_code ignored;
  if (!fs::exists(named.path, ignored)) return find_grammar(path, named.attributes, attributes, named.path);
  return load_with(named, attributes);
}

}  // namespace

std::string settings_folder_of(const std::string& path, const Provenance& provenance) {
  return (fs::absolute(path).parent_path() / provenance.settings_folder).lexically_normal().string();
}

LoadedGrammar grammar_of_settings(const std::string& settings, const std::string& name, const std::string& folder,
                                  const std::map<std::string, std::string>& attributes) {
  return load_with(grammar_named_by(settings, name, folder), attributes);
}

Provenance made_from(const std::string& derivation_path, bool as_it_is, const LoadedGrammar& grammar,
                     const Derivation& derivation, const std::string& out) {
  Provenance p;
  const std::optional<Provenance> original = provenance_of(derivation_path);
  if (original && as_it_is) {
    p = *original;
    const fs::path folder = fs::weakly_canonical(fs::absolute(derivation_path).parent_path() / p.settings_folder);
    const fs::path from = fs::weakly_canonical(fs::absolute(out).parent_path());
    p.settings_folder = folder.lexically_relative(from).generic_string();
  } else {
    for (const SourceText& source : grammar.sources)
      p.inputs[fs::path(source.name).filename().string()] = content_hash(source.text);
  }
  p.version = kVersion;
  p.made_by = "export";
  p.derivation = hash_text(derivation);
  return p;
}

Explanation score_derivation(const Scene& scene, const std::string& derivation_path, MeshSource& source,
                             AdaptedGenes* adapted) {
  const std::unique_ptr<Setup> setup = set_up(scene, source);
  const Derivation derivation = read_derivation(setup->graph(), derivation_path, adapted);
  const std::unique_ptr<Executor> executor = make_serial_executor();
  return SceneScorer(setup->graph(), setup->objective, *executor).explain(derivation);
}

LoadedDerivation load_derivation(const std::string& path, const std::string& grammar,
                                 const std::map<std::string, std::string>& attributes) {
  LoadedDerivation loaded;
  loaded.grammar = grammar.empty() ? grammar_of(path, attributes) : load_grammar(grammar, attributes);
  loaded.derivation =
      read_derivation(*loaded.grammar.graph, path, attributes.empty() ? nullptr : &loaded.adapted);
  return loaded;
}

ExportReport export_derivation(const ExportRequest& request, MeshSource& source, Executor& executor) {
  if (request.out.ends_with(".json") || request.out.ends_with(".png")) {
    throw Error(fmt::format("{}: export writes .glb, .obj, .ply or .stl", request.out));
  }
  const auto [grammar, derivation, adapted] =
      load_derivation(request.derivation, request.grammar, request.attributes);
  const MeshTable meshes = load_meshes(grammar, source);
  const std::vector<Mesh> no_ghosts;
  ModelFiles files(*grammar.graph, meshes, load_textures(grammar), no_ghosts, {}, executor);
  const bool as_it_is = request.grammar.empty() && request.attributes.empty();
  ExportReport report{adapted, false};
  Provenance provenance = made_from(request.derivation, as_it_is, grammar, derivation, request.out);
  if (request.all_levels) {
    const LevelOfDetail detail = request.detail.value_or(LevelOfDetail{});
    for (const auto& [name, triangles] : files.write_levels(derivation, request.out, detail, provenance)) {
      report.files.push_back({(fs::path(request.out).parent_path() / name).string(), triangles});
    }
  } else {
    if (request.detail) provenance.mesh = to_toml(*request.detail);
    report.files.push_back({request.out, files.write(derivation, request.out, provenance)});
  }
  report.truncated = files.model().truncated;
  return report;
}

}  // namespace espalier
