#include "run/grammar_file.h"

#include <filesystem>

#include "base/error.h"
#include "io/file.h"

namespace espalier {

CompileResult compile_grammar_file(const std::string& path, const std::map<std::string, std::string>& attributes) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const ReadImport read = [&](const std::string& name) { return read_file((folder / name).string(), kMostGrammarBytes); };
  return compile_grammar({path, read_file(path, kMostGrammarBytes), attributes, read});
}

LoadedGrammar load_grammar(const std::string& path, const std::map<std::string, std::string>& attributes) {
  LoadedGrammar grammar;
  grammar.path = path;
  CompileResult result = compile_grammar_file(path, attributes);
  std::string report;
  if (!result.diagnostics.items().empty()) report = render(result.diagnostics, result.sources);
  if (!result.graph) {
    while (report.ends_with('\n')) report.pop_back();
    throw Error(report.empty() ? path + ": the grammar does not compile" : report);
  }
  grammar.warnings = report;
  grammar.sources = std::move(result.sources);
  grammar.checked = result.checked;
  grammar.graph = result.graph;
  return grammar;
}

MeshTable load_meshes(const LoadedGrammar& grammar, MeshSource& source) {
  return MeshTable(*grammar.graph, std::filesystem::path(grammar.path).parent_path().string(), source);
}

}  // namespace espalier
