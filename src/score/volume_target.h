#pragma once
// The volume target: voxels of a model counted against meshes to fill or avoid. (ShapeGenetics 2017, section 8;
// Haubenwallner et al. 2016, section 3.1.6.) docs/volume.md has the formulas with examples.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/mesh.h"
#include "model/model.h"
#include "score/bit_grid.h"
#include "score/target.h"
#include "score/volume_counts.h"
#include "score/volume_view.h"
#include "score/voxel_grid.h"

namespace espalier {

// fill_i, spill_i: weights of target mesh i. T_i = its voxels; T = voxels of the union of the meshes with fill > 0 (of
// all meshes if none has); S = smootherstep from 0.
enum class VolumeForm : std::uint8_t {
  linear,        // sum_i (fill_i * inside_i + spill_i * (covered - inside_i)) - overlap_weight * overlap
                 //   + outside_weight * outside                                              (2017, section 8)
  smootherstep,  // sum_i fill_i * S(inside_i / T_i) - sum_i spill_i * S((spilled + overlap + outside) / 2T)    (2016)
  smootherstep_separate,  // sum_i fill_i * S(inside_i / T_i) - sum_i spill_i * S((spilled + outside) / 3T)
                          //   - overlap_weight * S(overlap / covered)
};
/// What `overlap` means: voxels covered twice or more, each once; or hits beyond the first (hits - covered).
enum class OverlapCount : std::uint8_t { voxels, hits };

struct VolumeMesh {
  std::string name;            // for people
  Mesh mesh;                   // in model space
  double fill = 1;             // reward for what is inside; negative = avoid
  std::optional<double> spill; // linear: added per covered voxel not inside (default -1). smootherstep forms: weight of
                               // what is wrong, subtracted (default 1); negative rewards being elsewhere (avoid scenes)
};

struct VolumeSettings {
  std::string name = "volume";
  std::vector<VolumeMesh> meshes;
  VoxelGrid grid;
  VolumeForm form = VolumeForm::linear;
  VolumeView view = VolumeView::full;
  OverlapCount overlap_count = OverlapCount::voxels;
  double overlap_weight = 0;  // >= 0, subtracted; not used by the form `smootherstep`
  std::optional<double> outside_weight;  // linear: per voxel outside, added; default: the sum of the spill weights
};

/// The voxels that a model covers.
struct CoveredVoxels {
  BitGrid once, twice;  // by at least so many parts
};

/// Immutable once made; shared by threads, each with a scratch from make_scratch().
class VolumeTarget final : public Target {
 public:
  /// Voxelises the target meshes; keeps what it needs of `meshes` (the parts that models are made of). Throws Error
  /// on a bad grid, weights that are not finite, no target mesh, or a mesh that covers no voxel.
  VolumeTarget(VolumeSettings settings, const MeshTable& meshes);
  ~VolumeTarget() override;

  const VolumeSettings& settings() const;
  const VoxelGrid& grid() const { return settings().grid; }
  /// Voxels of target mesh i; T of the formulas.
  std::uint64_t target_voxels(std::size_t i) const;
  std::uint64_t wanted_voxels() const;
  /// One line per thing that a person should know: target meshes that are not closed, with their open edges.
  const std::vector<std::string>& warnings() const;

  /// Counts the instances that settings().view shows. No allocation once the scratch and `counts` are warm.
  void counts(std::span<const Instance> instances, TargetScratch& scratch, VolumeCounts& counts) const;
  VolumeCounts counts(std::span<const Instance> instances, TargetScratch& scratch) const;
  /// For pictures: what is counted, voxel by voxel; and the voxels of target mesh i.
  CoveredVoxels covered(std::span<const Instance> instances) const;
  const BitGrid& voxels_of(std::size_t i) const;

  double evaluate(const VolumeCounts& counts) const;
  /// The terms whose values add up to evaluate(counts).
  std::vector<Term> breakdown(const VolumeCounts& counts) const;
  /// "81 % filled, 6 % spilled, 2 % overlap": filled of the wanted voxels, spilled and overlapping of the covered ones.
  std::string describe(const VolumeCounts& counts) const;

  const std::string& name() const override { return settings().name; }
  TargetView view() const override;
  std::unique_ptr<TargetScratch> make_scratch() const override;
  std::unique_ptr<TargetSession> make_session() const override;
  std::size_t session_bytes() const override;
  double score(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;
  /// Every voxel that is worth it covered once, nothing else: linear: sum over the grid's voxels of max(0, weight);
  /// smootherstep forms: sum of the positive fills, plus -sum(spill) where that is positive.
  double optimum() const override { return optimum_; }
  Explanation explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const override;

 private:
  struct Parts;
  /// Calls term(name, of which mesh or nullptr, weight, count, of, factor) in a fixed order; a term is worth
  /// weight * factor.
  template <class Sink>
  void each_term(const VolumeCounts& counts, const Sink& term) const;

  std::unique_ptr<const Parts> parts_;
  double spill_ = 0;   // sum of the spill weights
  double wanted_ = 0;  // T
  double optimum_ = 0;
};

}  // namespace espalier
