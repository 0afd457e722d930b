#include "run/grammar_file.h"

#include <filesystem>

#include "base/error.h"
#include "grammar/compiler.h"
#include "io/file.h"

namespace espalier {

LoadedGrammar load_grammar(const std::string& path, const std::map<std::string, std::string>& attributes) {
  LoadedGrammar grammar;
  grammar.path = path;
  grammar.text = read_file(path, kMostGrammarBytes);
  const CompileResult result = compile_grammar({path, grammar.text, attributes});
  std::string report;
  if (!result.diagnostics.items().empty()) report = render(result.diagnostics, path, grammar.text);
  if (!result.graph) {
    while (report.ends_with('\n')) report.pop_back();
    throw Error(report.empty() ? path + ": the grammar does not compile" : report);
  }
  grammar.warnings = report;
  grammar.graph = result.graph;
  return grammar;
}

MeshTable load_meshes(const LoadedGrammar& grammar, MeshSource& source) {
  return MeshTable(*grammar.graph, std::filesystem::path(grammar.path).parent_path().string(), source);
}

}  // namespace espalier
