#pragma once
// Samples: models drawn from a grammar without any target, to see what it grows.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/executor.h"
#include "base/random.h"
#include "run/input_files.h"
#include "run/model_files.h"

namespace espalier {

struct SampleRequest {
  std::string grammar;                            // path, relative to `folder`
  std::string folder;
  std::map<std::string, std::string> attributes;  // as the language writes them
  std::uint32_t count = 16;                       // 1..1000
  std::uint64_t seed = 1;
  std::optional<std::uint32_t> grow;              // this many steps of growth from a seedling, not the whole prior
  std::string from;                               // path: `grow` goes on with this derivation; empty: from a seedling
  std::optional<std::uint32_t> genes;             // grown by moves to this many genes, as searches start; excludes grow
  std::array<std::uint32_t, 2> picture = {800, 600};
  std::array<std::uint32_t, 2> cell = {400, 300};  // of a model on the sheet
  std::uint32_t columns = 0;                       // of the sheet; 0 = as near to 4:3 as the count allows
};

inline constexpr const char* kSampleMarker = "samples.toml";

/// What is written of each sample.
enum class SampleFiles : std::uint8_t {
  all,
  genes,  // derivations only: models and pictures take nearly all of the time
};

/// The request as TOML ("espalier_sample = 1 ..."), and back; `folder` is not written. Throws Error.
std::string to_toml(const SampleRequest& request);
SampleRequest parse_sample_request(std::string_view text, const std::string& name, const std::string& folder);

class SampleSet {
 public:
  /// Draws them all. Throws Error.
  SampleSet(const SampleRequest& request, MeshSource& source, Executor& executor);

  std::size_t size() const { return derivations_.size(); }
  const Derivation& derivation(std::size_t index) const { return derivations_[index]; }
  Provenance provenance(std::size_t index) const;
  std::vector<std::string> names(SampleFiles which = SampleFiles::all) const;
  void write(const std::string& name, const std::string& path);
  void write_individual(std::size_t index, const std::string& path, const Provenance& provenance);
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void draw();
  Derivation draw_one(RandomStream& random);
  void read_ancestor();
  void write_sheet(const std::string& path);

  SampleRequest request_;  // its grammar names the copy
  LoadedGrammar grammar_;
  MeshTable meshes_;
  InputFiles inputs_;
  std::string settings_;
  std::optional<Derivation> ancestor_;  // what `from` names
  std::vector<Derivation> derivations_;
  std::vector<std::string> warnings_;
  std::size_t truncated_ = 0, short_ = 0;  // samples that met the budget of genes; that could not grow to `genes`
  std::vector<Mesh> no_ghosts_;
  std::optional<ModelFiles> files_;
};

/// Draws and writes into a new folder `out` (see RunFolder); returns the warnings. Throws Error, then nothing is left.
std::vector<std::string> write_samples(const SampleRequest& request, const std::string& out, MeshSource& source,
                                       Executor& executor, SampleFiles which = SampleFiles::all);

}  // namespace espalier
