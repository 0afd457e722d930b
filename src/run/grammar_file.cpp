#include "run/grammar_file.h"

#include <filesystem>

#include "base/error.h"
#include "io/file.h"
#include "io/image_import.h"

namespace espalier {

CompileResult compile_grammar_file(const std::string& path, const std::map<std::string, std::string>& attributes) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  const ReadImport read = [&](const std::string& name) {
    return read_file((folder / name).string(), kMostGrammarBytes);
  };
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
  grammar.attributes = attributes;
  grammar.warnings = report;
  grammar.sources = std::move(result.sources);
  grammar.checked = result.checked;
  grammar.graph = result.graph;
  return grammar;
}

TextureTable load_textures(const LoadedGrammar& grammar) {
  const std::filesystem::path folder = std::filesystem::path(grammar.path).parent_path();
  FileImageSource source;
  TextureTable textures;
  Diagnostics diagnostics;
  for (const TextureRef& texture : image_textures(*grammar.graph)) {
    try {
      textures.add_file(texture.path, source.load((folder / texture.path).string()));
    } catch (const Error& error) {
      diagnostics.error("E0908", texture.span, error.what(), "paths are relative to the grammar's folder");
    }
  }
  if (!diagnostics.has_errors()) return textures;
  std::string report = render(diagnostics, grammar.sources);
  while (report.ends_with('\n')) report.pop_back();
  throw Error(report);
}

MeshTable load_meshes(const LoadedGrammar& grammar, MeshSource& source) {
  return MeshTable(*grammar.graph, std::filesystem::path(grammar.path).parent_path().string(), source);
}

}  // namespace espalier
