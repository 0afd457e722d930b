#include "run/mesh_look.h"

#include <fmt/format.h>

#include "base/error.h"

namespace espalier {

std::string_view name_of(Joints joints) {
  for (const Choice<Joints>& choice : kJointsChoices)
    if (choice.value == joints) return choice.name;
  return {};
}

std::optional<LevelOfDetail> read_level_of_detail(const std::string& joints,
                                                  const std::optional<std::uint32_t>& level) {
  if (joints.empty() && !level) return std::nullopt;
  LevelOfDetail out;
  if (level) {
    if (*level >= LevelOfDetail::kCount)
      throw Error(fmt::format("--lod must be from 0 to {}, got {}", LevelOfDetail::kCount - 1, *level));
    out.level = *level;
  }
  if (joints.empty()) return out;
  for (const Choice<Joints>& choice : kJointsChoices) {
    if (choice.name != joints) continue;
    out.joints = choice.value;
    return out;
  }
  throw Error(fmt::format("--joints must be separate or smooth, got \"{}\"", joints));
}

std::string to_toml(const LevelOfDetail& detail) {
  return fmt::format("joints = \"{}\"\nlod = {}\n", name_of(detail.joints), detail.level);
}

std::optional<LevelOfDetail> level_of_detail(TomlSection& section) {
  const auto joints = section.choice("joints", kJointsChoices);
  const auto level = section.whole("lod", 0, LevelOfDetail::kCount - 1);
  if (!joints && !level) return std::nullopt;
  return LevelOfDetail{static_cast<std::uint32_t>(level.value_or(0)), joints.value_or(Joints::separate)};
}

LevelOfDetail parse_level_of_detail(const std::string& text, const std::string& name) {
  const TomlValue root = parse_toml(text, name);
  TomlSection section(root, name, "");
  const LevelOfDetail out = level_of_detail(section).value_or(LevelOfDetail{});
  section.finish();
  return out;
}

}  // namespace espalier
