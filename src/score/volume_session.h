#pragma once
// VolumeSession: one state of a chain for a volume target, as a counting canvas. A proposal that changes few parts is
// counted by these alone, and only where they lie: equal to counting the whole model, since all sums are of integers.

#include <memory>

#include "score/counting_canvas.h"
#include "score/target.h"
#include "score/volume_counts.h"
#include "score/volume_kernel.h"
#include "score/volume_target.h"

namespace espalier {

class VolumeSession final : public TargetSession {
 public:
  /// Models of fewer parts are counted as a whole, which takes no longer.
  static constexpr std::size_t kFewestParts = 32;

  /// Both must outlive it. Takes its memory when it is first worth it.
  VolumeSession(const VolumeTarget& target, const VolumeKernel& kernel) : target_(target), kernel_(kernel) {}

  double score(const Derivation& derivation, const Model& model, const ModelChange& change,
               TargetScratch* scratch) override;
  void commit() override;
  void restart() override;
  bool counted_change() const override { return proposal_ == Proposal::counted; }

 private:
  /// How the last proposal was scored: not yet, as a whole, or drawn into the canvas.
  enum class Proposal : std::uint8_t { none, whole, counted };

  bool hold(std::span<const Instance> state, VolumeScratch& scratch);
  bool apply(const ModelChange& change, VolumeScratch& scratch);
  void take_back();

  const VolumeTarget& target_;
  const VolumeKernel& kernel_;
  std::unique_ptr<CountingCanvas> canvas_;
  VolumeCounts counts_, proposed_;  // of the state that the canvas holds, and of the proposal
  bool holds_ = false;              // the canvas holds the state
  Proposal proposal_ = Proposal::none;
  // After a state with too many parts in one place come others: the canvas is not filled in vain at each of them.
  std::uint32_t wait_ = 0, next_wait_ = 1;  // in states
};

}  // namespace espalier
