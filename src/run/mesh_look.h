#pragma once
// The options of `espalier export` and `render` that decide about meshes, as text: on the command line and, as TOML, in
// the provenance of what was made with them.

#include <optional>
#include <string>

#include "model/level_of_detail.h"
#include "run/toml_section.h"

namespace espalier {

inline constexpr Choice<Joints> kJointsChoices[] = {{"separate", Joints::separate}, {"smooth", Joints::smooth}};
std::string_view name_of(Joints joints);

/// `joints`: "separate", "smooth" or empty; `level` 0..3. Nothing where neither is given: parts as the grammar makes
/// them. Throws Error.
std::optional<LevelOfDetail> read_level_of_detail(const std::string& joints, const std::optional<std::uint32_t>& level);

/// `joints = ".."` and `lod = ..`, and back from such a section or text. Throws Error.
std::string to_toml(const LevelOfDetail& detail);
std::optional<LevelOfDetail> level_of_detail(TomlSection& section);
LevelOfDetail parse_level_of_detail(const std::string& text, const std::string& name);

}  // namespace espalier
