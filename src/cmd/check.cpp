// espalier check: what is wrong with a grammar.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/counted.h"
#include "cmd/attributes.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/grammar_file.h"

namespace espalier {
namespace {

void print_json(const std::string& file, const CompileResult& result) {
  const Diagnostics& diagnostics = result.diagnostics;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Diagnostic& d : diagnostics.items()) {
    list.push_back({{"severity", d.severity == Severity::error ? "error" : "warning"},
                    {"code", d.code},
                    {"message", d.message},
                    {"file", result.sources[d.span.file].name},
                    {"line", d.span.line},
                    {"column", d.span.column},
                    {"offset", d.span.offset},
                    {"length", d.span.length},
                    {"help", d.help}});
  }
  const nlohmann::ordered_json document = {
      {"file", file}, {"errors", diagnostics.error_count()}, {"diagnostics", list}};
  fmt::print("{}\n", document.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void print_summary(const std::string& file, const GeneratorGraph& graph) {
  std::size_t draws = 0, variants = 0;
  for (const Rule& rule : graph.rules) draws += rule.draws.size(), variants += rule.variants.size();
  const std::string meshes = fmt::format("{} mesh{}", graph.meshes.size(), graph.meshes.size() == 1 ? "" : "es");
  fmt::print("{}: {} is well-formed: {} with {}, {}, {}, {}, {}\n", file, graph.name,
             counted(graph.rules.size(), "rule"), counted(variants, "variant"),
             counted(graph.edges.size() - 1, "edge"), counted(draws, "draw"),
             counted(graph.details.size(), "detail"), meshes);
}

}  // namespace

int check_verb(const CheckOptions& options) {
  const CompileResult result = compile_grammar_file(options.file, parse_attributes(options.attributes));
  if (options.json) {
    print_json(options.file, result);
  } else if (!result.diagnostics.items().empty()) {
    fmt::print("{}", render(result.diagnostics, result.sources));
  }
  if (!result.graph) return kBadInput;
  AssimpMeshSource source;
  LoadedGrammar grammar;
  grammar.path = options.file;
  grammar.sources = result.sources;
  grammar.graph = result.graph;
  load_meshes(grammar, source);
  load_textures(grammar);
  if (!options.json) print_summary(options.file, *result.graph);
  return kDone;
}

}  // namespace espalier
