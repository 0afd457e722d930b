#pragma once
// The grammars on a page of the documentation: what stands between ```esp and ```.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace espalier::testing {

struct Fence {
  std::string page;
  int line = 0;
  std::string text;
};

inline std::vector<Fence> fences(const std::filesystem::path& page) {
  std::ifstream in(page);
  std::vector<Fence> result;
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (!inside && line == "```esp") result.push_back({page.filename().string(), number, ""});
    else if (inside && line != "```") result.back().text += line + "\n";
    if (line == "```esp") inside = true;
    else if (line == "```") inside = false;
  }
  return result;
}

/// The files of a folder of the checkout with an extension, sorted.
inline std::vector<std::filesystem::path> files_in(const std::string& folder, const std::string& extension) {
  std::vector<std::filesystem::path> result;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(ESPALIER_SOURCE_DIR) / folder))
    if (entry.path().extension() == extension) result.push_back(entry.path());
  std::sort(result.begin(), result.end());
  return result;
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Of every page in docs/.
inline std::vector<Fence> all_fences() {
  std::vector<Fence> result;
  for (const auto& page : files_in("docs", ".md"))
    for (Fence& fence : fences(page)) result.push_back(std::move(fence));
  return result;
}

}  // namespace espalier::testing
