#include "studio/file_kind.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <string>

namespace espalier::studio {
namespace {

constexpr std::string_view kMeshEndings[] = {".obj", ".glb", ".gltf", ".ply", ".stl", ".off", ".dae", ".fbx", ".3ds"};
constexpr std::string_view kImageEndings[] = {".png", ".jpg", ".jpeg", ".pfm"};

}  // namespace

FileKind file_kind(std::string_view path) {
  std::string lower(path);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto ends = [&](std::span<const std::string_view> endings) {
    return std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return lower.ends_with(ending); });
  };
  if (ends(kMeshEndings)) return FileKind::mesh;
  if (ends(kImageEndings)) return FileKind::image;
  return path.ends_with(".esp") ? FileKind::grammar : FileKind::other;
}

}  // namespace espalier::studio
