#pragma once
// The checker: holds a syntax tree against every rule of the language that is known before a search starts. Passes run
// one after the other, by concern: names, static values, kinds, structure, growth. Each reports all that it finds.

#include <map>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "grammar/ast.h"
#include "grammar/checked.h"

namespace espalier {

/// The grammar with what was found out about it, or nothing where there are errors, including those that `diagnostics`
/// held before. `attribute_overrides`: values of attrs as text ("1.6", "25deg", "true") by name; faults in them are
/// errors without a span (line 0).
std::optional<CheckedGrammar> check(ast::Grammar grammar, const std::map<std::string, std::string>& attribute_overrides,
                                    Diagnostics& diagnostics);

}  // namespace espalier
