#pragma once
// Founders: the models that a scene starts from, read, adapted to its grammar, held against its limits and scored; and
// which of their genes stay.

#include <string>
#include <string_view>
#include <vector>

#include "run/setup.h"

namespace espalier {

/// What files of several derivations end with: a JSON document a line (docs/formats.md).
inline constexpr std::string_view kManyDerivations = ".derivations.jsonl";

/// Takes the founders and locks that `from` names into `setup`, whose objective is built. Throws Error where the file
/// cannot be read, holds what is no derivation of the grammar, where a lock leads to no gene, or where no founder is
/// finished, within the gene limits and acceptable. Founders among others that are not so are left out with a warning.
void take_founders(Setup& setup, const Scene& from);

/// Of derivations as JSON, one a line, those that can stand in the graph, adapted to it: again one a line.
std::string adapted_lines(const GeneratorGraph& graph, std::string_view lines);
/// A derivation as JSON in one line, without its end.
std::string to_line(const GeneratorGraph& graph, const Derivation& derivation);

}  // namespace espalier
