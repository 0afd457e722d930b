#include "run/find_derivation.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "io/file.h"
#include "io/provenance.h"
#include "run/results.h"
#include "run/sample.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".derivation.json";
constexpr std::size_t kMostLookedAt = 2000;

std::string in_folder(const fs::path& folder) {
  const fs::path best = folder / ("best" + std::string(kEnding));
  if (fs::exists(folder / kRunMarker) && fs::exists(best)) return best.string();
  if (fs::exists(folder / kSampleMarker))
    throw Error(fmt::format("{}: holds many samples; name one of its files, like {}", folder.string(),
                            (folder / ("01" + std::string(kEnding))).string()));
  throw Error(fmt::format("{}: is no folder of a run: it holds no {} beside a best{}", folder.string(), kRunMarker,
                          kEnding));
}

/// Whether a file is the derivation that has this hash.
bool is_derivation(const fs::path& path, const std::string& hash) {
  try {
    return read_provenance(path.string()).derivation == hash;
  } catch (const Error&) {
    return false;
  }
}

/// Those in a folder that end as derivations do, the one named like `stem` first.
std::vector<fs::path> derivations_in(const fs::path& folder, const std::string& stem) {
  std::vector<fs::path> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().ends_with(kEnding)) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end(), [&](const fs::path& a, const fs::path& b) {
    const bool first_a = a.filename() == stem + kEnding, first_b = b.filename() == stem + kEnding;
    return first_a != first_b ? first_a : a < b;
  });
  if (found.size() > kMostLookedAt) found.resize(kMostLookedAt);
  return found;
}

}  // namespace

std::string find_derivation(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) return in_folder(path);
  if (path.ends_with(".json")) return path;
  const Provenance provenance = read_provenance(path);
  if (provenance.derivation.empty())
    throw Error(fmt::format("{}: was not made of one derivation; name a {}", path, kEnding));
  if (provenance.settings.empty())
    throw Error(fmt::format("{}: was made with another grammar or other attributes than its derivation's, which it does "
                            "not keep; name the {}, with --grammar or -D", path, kEnding));
  const fs::path here = fs::absolute(path).parent_path();
  const fs::path run = (here / provenance.settings_folder).lexically_normal();
  for (const fs::path& folder : {here, run, run / "alternatives"}) {
    for (const fs::path& candidate : derivations_in(folder, fs::path(path).stem().string())) {
      if (is_derivation(candidate, provenance.derivation)) return candidate.string();
    }
  }
  throw Error(
      fmt::format("{}: holds no genes, and no {} with the derivation {} that it was made of lies beside it or in "
                  "{}",
                  path, kEnding, provenance.derivation, run.string()));
}

}  // namespace espalier
