#pragma once
// L-systems as grammars of ours. Each symbol that is rewritten becomes a rule, each rewriting step a level of genes;
// alternatives become a `choose`. docs/from-lsystems.md tells what becomes what, and what is refused.

#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.h"

namespace espalier {

struct LSystemImport {
  std::string name;               // of the grammar, a word
  std::string file;               // for the comment that says where it comes from
  std::optional<int> iterations;  // instead of the file's
};

/// The formatted text of a grammar; nothing where `diagnostics` has errors afterwards, which lie in `source`.
std::optional<std::string> import_lsystem(std::string_view source, const LSystemImport& options,
                                          Diagnostics& diagnostics);

}  // namespace espalier
