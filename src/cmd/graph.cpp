// espalier graph: a grammar or a derivation as a picture.
#include <cstdio>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/attributes.h"
#include "cmd/verbs.h"
#include "io/file.h"
#include "model/draw_values.h"
#include "render/derivation_diagram.h"
#include "render/generator_diagram.h"
#include "run/derivation_file.h"

namespace espalier {
namespace {

std::string draw_grammar(const GraphOptions& options) {
  if (!options.grammar.empty()) throw Error("--grammar goes with a .derivation.json, not with a grammar");
  const LoadedGrammar grammar = load_grammar(options.file, parse_attributes(options.attributes));
  if (!grammar.warnings.empty()) fmt::print(stderr, "{}", grammar.warnings);
  return generator_diagram(*grammar.graph, outline_of(*grammar.checked, grammar.sources));
}

std::string draw_derivation(const GraphOptions& options) {
  const auto [grammar, derivation, adapted] =
      load_derivation(options.file, options.grammar, parse_attributes(options.attributes));
  print_adapted(adapted);
  std::vector<std::optional<float>> values(derivation.draws.size());
  if (derivation.size() <= kMostBoxedGenes) values = draw_values(*grammar.graph, derivation);
  return derivation_diagram(*grammar.graph, derivation, outline_of(*grammar.checked, grammar.sources), values);
}

}  // namespace

int graph_verb(const GraphOptions& options) {
  if (!options.out.empty() && !options.out.ends_with(".svg")) {
    throw Error(fmt::format("{}: graph writes .svg", options.out));
  }
  const std::string picture = options.file.ends_with(".json") ? draw_derivation(options) : draw_grammar(options);
  if (!options.out.empty()) {
    write_file(options.out, picture);
    fmt::print("wrote {}\n", options.out);
  } else if (std::fwrite(picture.data(), 1, picture.size(), stdout) != picture.size() || std::fflush(stdout) != 0) {
    throw Error("standard output cannot be written");
  }
  return kDone;
}

}  // namespace espalier
