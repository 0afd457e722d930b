#pragma once
// The genes of a derivation as a list: what locks name, in words.

#include <string>

#include "run/derivation_file.h"

namespace espalier {

/// A line a gene: its number, how many genes are below, its path, its variant, its draws and where its slots are empty.
std::string gene_list(const LoadedDerivation& loaded);
/// The same as JSON.
std::string gene_list_json(const LoadedDerivation& loaded);

}  // namespace espalier
