#pragma once
// Grammars from files: text to graph, and the mesh files that they name.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "grammar/compiler.h"
#include "model/model.h"
#include "model/texture_table.h"

namespace espalier {

inline constexpr std::uint64_t kMostGrammarBytes = 16ull << 20;

struct LoadedGrammar {
  std::string path;
  std::vector<SourceText> sources;  // the grammar, then what it imports, named by path
  std::shared_ptr<const CheckedGrammar> checked;
  std::shared_ptr<const GeneratorGraph> graph;
  std::map<std::string, std::string> attributes;  // that were set, as they were written
  std::string warnings;  // rendered diagnostics; empty if there are none
};

/// Compiles the grammar of a file, with its attributes set and its imports read. Throws Error naming the file when it
/// cannot be read; other faults are in the diagnostics.
CompileResult compile_grammar_file(const std::string& path, const std::map<std::string, std::string>& attributes);

/// Throws Error holding all rendered diagnostics when the text has errors, or naming the file when it cannot be read.
LoadedGrammar load_grammar(const std::string& path, const std::map<std::string, std::string>& attributes);

/// The image files of a grammar; an Error shows the place in the grammar that names the file. Throws Error.
TextureTable load_textures(const LoadedGrammar& grammar);

/// The meshes of a grammar; files are taken relative to its folder. Throws Error.
MeshTable load_meshes(const LoadedGrammar& grammar, MeshSource& source);

}  // namespace espalier
