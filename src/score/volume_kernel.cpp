// AVX-512 is left out: its paths would have to be held equal on machines that we cannot test on.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_AVX3 | HWY_AVX3_DL)
// All that remain, the slowest too, so that a test can compare them on one machine.
#define HWY_COMPILE_ALL_ATTAINABLE

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "score/volume_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "base/check.h"
#include "score/parts-inl.h"
#include "score/sweep-inl.h"
#include "score/volume_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

void draw_model(const std::vector<Solid>& solids, std::span<const Instance> instances, VolumeView view,
                VolumeScratch& scratch) {
  for (const Instance& instance : instances) {
    if (!shows(view, instance)) continue;
    DCHECK(instance.mesh < solids.size());
    draw_part(solids[instance.mesh], instance, scratch);
  }
}

/// counts.inside has one entry per target.
void sweep_model(const std::vector<BitGrid>& targets, const BitGrid& all, VolumeScratch& scratch,
                 VolumeCounts& counts) {
  VoxelCanvas& canvas = scratch.canvas;
  SweepSums sums;
  for (std::int32_t tile = 0; tile < canvas.tile_rows(); ++tile) {
    for (std::int32_t word = 0; word < canvas.depth(); ++word) {
      DirtyRange& range = canvas.range(tile, word);
      if (range.empty()) continue;
      const std::size_t row = canvas.row_offset(tile, word) + static_cast<std::size_t>(range.low) * 8;
      const std::size_t n = static_cast<std::size_t>(range.high - range.low) * 8;
      if (targets.size() > 1) {
        for (std::size_t i = 0; i < targets.size(); ++i) {
          counts.inside[i] += count_common(canvas.once.data() + row, targets[i].data() + row, n);
        }
      }
      sweep_row(canvas.once.data() + row, canvas.twice.data() + row, all.data() + row, n, sums);
      range = DirtyRange();
    }
  }
  counts.covered = sums.covered.total();
  counts.overlap = sums.overlap.total();
  const std::uint64_t wanted = sums.wanted.total();
  counts.spilled = counts.covered - wanted;
  if (targets.size() == 1) counts.inside[0] = wanted;
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace espalier {

HWY_EXPORT(draw_model);
HWY_EXPORT(sweep_model);

VolumeKernel::VolumeKernel(const VoxelGrid& grid, std::vector<Solid> solids, std::vector<BitGrid> targets)
    : grid_(grid), solids_(std::move(solids)), targets_(std::move(targets)),
      union_(grid.cells[0], grid.cells[1], grid.cells[2]) {
  for (const BitGrid& target : targets_) unite(union_, target);
}

void VolumeKernel::draw(std::span<const Instance> instances, VolumeView view, VolumeScratch& scratch) const {
  scratch.canvas.hits = scratch.canvas.outside = 0;
  HWY_DYNAMIC_DISPATCH(draw_model)(solids_, instances, view, scratch);
}

void VolumeKernel::sweep(VolumeScratch& scratch, VolumeCounts& counts) const {
  counts.inside.assign(targets_.size(), 0);
  HWY_DYNAMIC_DISPATCH(sweep_model)(targets_, union_, scratch, counts);
  counts.hits = scratch.canvas.hits;
  counts.outside = scratch.canvas.outside;
}

std::vector<std::string> kernel_paths() {
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
  return names;
}

void use_kernel_path(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace espalier

#endif  // HWY_ONCE
