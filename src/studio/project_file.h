#pragma once
// A whole project as one file: JSON, with its files in base64. Its format is in docs/studio-protocol.md.

#include <string>
#include <string_view>
#include <vector>

#include "studio/breeding_store.h"
#include "studio/shipped.h"
#include "studio/store.h"
#include "studio/workbench.h"

namespace espalier::studio {

struct WholeProject {
  std::string name;
  NewProject content;
  std::string shown;  // the model, as JSON; may be empty
  std::vector<StoredFavourite> favourites;
  std::vector<WholeBreeding> breedings;  // changed last first
};

inline constexpr int kProjectFileVersion = 1;
inline constexpr std::size_t kMostProjectFileBytes = 96u << 20;

std::string project_file(const WholeProject& project);
/// Throws Error naming what is wrong: not such a file, another version, paths that lead elsewhere, files that are damaged.
WholeProject parse_project_file(std::string_view text);

}  // namespace espalier::studio
