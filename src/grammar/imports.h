#pragma once
// Imports: a grammar and the files that it imports, read and parsed into one tree. Paths are relative to the folder of
// the file that imports and stay below the folder of the grammar; a file counts once, however often it is imported.

#include <functional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/ast.h"

namespace espalier {

/// The text of a file by its path relative to the grammar's folder. Throws Error, whose message names the file.
using ReadImport = std::function<std::string(const std::string& path)>;

/// More files are refused (E0123), as are more bytes than kLargestSource (parser.h) in all of them together.
inline constexpr std::size_t kMostImports = 40;

/// Parses the only entry of `sources`, the grammar, then what it imports, and what those import. Every file read is
/// added to `sources`, whose index is SourceSpan::file, named by its path as seen from where the grammar's path is.
/// The tree holds all declarations, without the imports and without the starts of imported files.
ast::Grammar parse_with_imports(std::vector<SourceText>& sources, const ReadImport& read, Diagnostics& diagnostics);

}  // namespace espalier
