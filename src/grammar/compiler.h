#pragma once
// The way from text to graph, all passes in order: lexer, parser, checker, compiler.

#include <map>
#include <memory>
#include <string>

#include "base/diagnostic.h"
#include "grammar/checked.h"
#include "grammar/graph.h"
#include "grammar/imports.h"

namespace espalier {

struct GrammarSource {
  std::string path;  // for messages, and the folder that mesh files are relative to
  std::string text;
  std::map<std::string, std::string> attributes{};  // overrides by name, values as written after `=`
  ReadImport read_import{};                         // none: imports are errors
};

struct CompileResult {
  std::shared_ptr<const GeneratorGraph> graph;  // null when there are errors
  std::shared_ptr<const CheckedGrammar> checked;  // what the graph was made of
  Diagnostics diagnostics;
  /// The grammar, then what it imports: by SourceSpan::file.
  std::vector<SourceText> sources;
};

CompileResult compile_grammar(const GrammarSource& source);

}  // namespace espalier
