#pragma once
// Finding the derivation behind a file: a derivation itself, a folder of a run, or a model or picture that was made of
// one.

#include <string>

namespace espalier {

/// The path of the .derivation.json that `path` names: itself, a run's best, or the one in the folder of the run or the
/// samples that the provenance of a model or picture tells of. Throws Error saying what was looked for.
std::string find_derivation(const std::string& path);

}  // namespace espalier
