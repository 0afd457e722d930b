#pragma once
// A session of the breeding room as one file: JSON, with the files of its states in base64. Its format is in
// docs/studio-protocol.md.

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "studio/breeding_store.h"

namespace espalier::studio {

inline constexpr int kBreedingFileVersion = 2;
inline constexpr std::size_t kMostBreedingFileBytes = 96u << 20;

/// Throws Error where it would be too large.
std::string breeding_file(const WholeBreeding& whole);
/// Throws Error naming what is wrong: not such a file, another version, what refers to nothing, texts that are damaged.
WholeBreeding parse_breeding_file(std::string_view text);

/// The same as a member of another file.
nlohmann::ordered_json breeding_json(const WholeBreeding& whole);
WholeBreeding parse_breeding(const nlohmann::ordered_json& json);

}  // namespace espalier::studio
