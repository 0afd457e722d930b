#pragma once
// Results: what a run leaves behind, file by file. Each can be written alone, so that a single one can be made again
// and compared. All but the times in result.json, convergence.csv and report.html are the same bytes for the same setup
// and steps.

#include <map>
#include <string>
#include <vector>

#include "run/model_files.h"
#include "run/outcome_pictures.h"
#include "run/search_loop.h"

namespace espalier {

inline constexpr const char* kRunMarker = "run.toml";

/// The text of run.toml.
std::string settings_text(const Setup& setup);

class ResultWriter {
 public:
  /// All must outlive it.
  ResultWriter(const Setup& setup, const SearchResult& result, Executor& executor);

  /// Names within the run folder, in the order of writing: the most precious first.
  std::vector<std::string> names() const;
  /// Writes the file `name` (one of names()) to `path`. Throws Error.
  void write(const std::string& name, const std::string& path);

  /// Number of individuals: the best is 0, alternatives follow.
  std::size_t size() const { return 1 + result_.alternatives.size(); }
  const Individual& individual(std::size_t index) const;
  /// `settings_folder`: where run.toml lies, seen from the file.
  Provenance provenance(std::size_t index, const std::string& settings_folder) const;
  /// The text of run.toml.
  const std::string& settings() const { return settings_; }

  /// A file about one individual, by the ending of `path` (see ModelFiles); pictures of alternatives are half as large.
  void write_individual(std::size_t index, const std::string& path, const Provenance& provenance);

 private:
  const Picture& best_picture();
  const OutcomePicture& outcome(const std::string& name);
  const Picture& small_picture(std::size_t index);
  void write_small_picture(std::size_t index, const std::string& path, const Provenance& provenance);
  void write_sheet(const std::string& path);
  void write_outcome(const std::string& name, const std::string& path);
  void write_report(const std::string& path);
  void write_result(const std::string& path) const;
  void write_convergence(const std::string& path) const;
  void write_diagnostics(const std::string& path) const;

  const Setup& setup_;
  const SearchResult& result_;
  Executor& executor_;
  std::string settings_;
  ModelFiles files_;
  Picture best_picture_;                 // empty: not drawn yet
  std::map<std::string, OutcomePicture> outcomes_;  // by name; as far as they were drawn
  std::vector<Picture> small_pictures_;  // by individual; empty ones are not drawn yet
};

}  // namespace espalier
