#pragma once
// The grammars and scenes that come along, within the program itself, and the samples made of them.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <studio_types.h>

#include "grammar/imports.h"
#include "studio/store.h"

namespace espalier::studio {

struct ShippedFile {
  std::string_view path;  // "grammars/city.esp"
  std::string_view bytes;
};

std::span<const ShippedFile> shipped_files();
/// Its bytes; nothing where there is none of that path.
std::optional<std::string_view> find_shipped(std::string_view path);

/// Scenes by their names, then the grammars that no sample of that name shows yet.
const std::vector<api::Sample>& samples();

/// The picture of a sample by its file name, "city.webp".
std::optional<std::string_view> sample_picture(const std::string& name);

/// What a new project holds, and its files' bytes by hash.
struct NewProject {
  StoredState state;
  std::map<std::string, std::string> blobs;
};
/// Throws Error where there is no such sample.
NewProject make_sample(const std::string& name);
/// A small grammar and a scene without targets.
NewProject make_empty_project();

inline constexpr std::uint64_t kMostFileTriangles = 5'000'000;  // of a mesh of a project

/// A file's facts for the project: meshes and images are read once. Throws Error for what is damaged, or of another kind.
StoredFile describe_file(const std::string& path, const std::string& bytes);

}  // namespace espalier::studio
