#pragma once
// Finding the grammar of a derivation whose settings name none that is there: near the file, by the hash of its text.

#include <map>
#include <string>

#include "run/grammar_file.h"

namespace espalier {

/// NAME.esp beside the derivation at `path` or in the folder above, where NAME is the grammar that the derivation names
/// (with - for _ too, as files of grammars are often called). It must have the hash that the derivation names, with the
/// attributes of `made_with` set, or with `attributes` over them; these are set in what is given back. Throws Error that
/// lists where it looked (first `missing`, where the grammar should have been; empty: nowhere) and what it found there.
LoadedGrammar find_grammar(const std::string& path, const std::map<std::string, std::string>& made_with,
                           const std::map<std::string, std::string>& attributes, const std::string& missing = {});

}  // namespace espalier
