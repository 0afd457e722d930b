#pragma once
// Files of a contest: the best of a variant as a run would have written it, and folders that keep what could be
// written.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/render.h"
#include "run/contest.h"
#include "run/run_folder.h"

namespace espalier {

/// The best that a variant found, over its seeds.
struct ContestBest {
  std::uint64_t seed = 0, steps = 0;  // `espalier run --seed --generations` makes it again
  Individual individual;
};

/// Takes the outcome's best where it is better than what is there; of equals the first stays.
void keep_best(std::optional<ContestBest>& best, const ContestOutcome& outcome);

/// The files that show a variant's best, and its settings, with which `espalier run` makes it again.
class BestFiles {
 public:
  /// All must outlive it; `setup` is the variant's, and becomes that of the best's seed.
  BestFiles(Setup& setup, const ContestVariant& variant, const ContestBest& best, Executor& executor);

  /// The text of the settings file.
  std::string settings() const;
  /// By the ending of `path`: .derivation.json or a model's.
  void write(const std::string& path) const;
  void write_picture(const std::string& path);
  /// Drawn once.
  const Picture& picture();

 private:
  Setup& setup_;
  SearchResult result_;
  Executor& executor_;
  Picture picture_;
};

/// A file of a folder, by its name there.
using FolderFile = std::pair<std::string, std::function<void(const std::string& path)>>;

/// Writes all, and gives the folder its name. Where one fails, the others are written still, the staged folder is kept,
/// and an Error says where.
void write_folder(RunFolder& folder, const std::vector<FolderFile>& files);

}  // namespace espalier
