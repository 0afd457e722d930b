// AVX-512 is left out: its paths would have to be held equal on machines that we cannot test on.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
// All that remain, the slowest too, so that a test can compare them on one machine.
#define HWY_COMPILE_ALL_ATTAINABLE

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "score/volume_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <type_traits>

#include "base/check.h"
#include "score/parts-inl.h"
#include "score/sweep-inl.h"
#include "score/volume_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

void draw_model(const std::vector<Solid>& solids, std::span<const Instance> instances, VolumeView view,
                VolumeScratch& scratch) {
  draw_parts(solids, instances, view, scratch, scratch.canvas);
}

void draw_counting(const std::vector<Solid>& solids, std::span<const Instance> instances, VolumeView view,
                   VolumeScratch& scratch, CountingCanvas& canvas) {
  draw_parts(solids, instances, view, scratch, canvas);
}

/// `used` tells of each block how the union of the targets fills it; counts.inside has one entry per target.
void sweep_model(const std::vector<BitGrid>& targets, const BitGrid& all, const BlockMap& used,
                 VolumeScratch& scratch, VolumeCounts& counts) {
  VoxelCanvas& canvas = scratch.canvas;
  constexpr std::integral_constant<std::size_t, kBlockTiles * 8> kWords;
  const std::size_t row_words = std::size_t{canvas.nx()} * 8;
  SweepSums sums;
  for (std::size_t d = 0; d < canvas.dirty.size(); ++d) {
    const std::size_t row = d / canvas.dirty_words * row_words;
    std::uint64_t bits = canvas.dirty[d];
    canvas.dirty[d] = 0;
    for (; bits != 0; bits &= bits - 1) {
      const int bit = std::countr_zero(bits);
      const std::size_t in_row = (d % canvas.dirty_words * 64 + static_cast<std::size_t>(bit)) * kWords;
      const std::size_t at = row + in_row;
      const std::size_t words = std::min<std::size_t>(kWords, row_words - in_row);
      std::uint32_t* once = canvas.once.data() + at;
      for (std::size_t i = 0; targets.size() > 1 && i < targets.size(); ++i) {
        BitSum inside;
        add_common(once, targets[i].data() + at, words, inside);
        counts.inside[i] += inside.total();
      }
      const BlockUse use = (used.any[d] >> bit & 1) == 0   ? BlockUse::none
                           : (used.full[d] >> bit & 1) == 0 ? BlockUse::some
                                                            : BlockUse::all;
      if (words == kWords) sweep_block(once, canvas.twice.data() + at, all.data() + at, use, kWords, sums);
      else sweep_block(once, canvas.twice.data() + at, all.data() + at, use, words, sums);
    }
  }
  const std::uint64_t wanted = sums.wanted.total();
  counts.spilled = sums.spilled.total();
  counts.covered = wanted + counts.spilled;
  counts.overlap = sums.overlap.total();
  if (targets.size() == 1) counts.inside[0] = wanted;
}

void count_touched(const std::vector<BitGrid>& targets, const BitGrid& all, const BlockMap& used,
                   const CountingCanvas& canvas, VolumeCounts& counts) {
  constexpr std::size_t kWords = kBlockTiles * 8;
  const std::size_t row_words = std::size_t{all.nx()} * 8;
  SweepSums after, before;
  for (std::size_t i = 0; i < canvas.touched.size(); ++i) {
    const std::size_t block = canvas.touched[i], row = block / canvas.blocks, in_row = block % canvas.blocks;
    const std::size_t at = row * row_words + in_row * kWords, words = std::min(kWords, row_words - in_row * kWords);
    const std::size_t mark = row * canvas.marks_per_row + in_row / 64;
    const BlockUse use = (used.any[mark] >> in_row % 64 & 1) == 0   ? BlockUse::none
                         : (used.full[mark] >> in_row % 64 & 1) == 0 ? BlockUse::some
                                                                     : BlockUse::all;
    alignas(32) std::uint32_t once[kWords], twice[kWords];
    const auto count = [&](const std::uint32_t* planes, SweepSums& sums, std::uint64_t sign) HWY_ATTR {
      flatten_block(planes, once, twice);
      for (std::size_t k = 0; targets.size() > 1 && k < targets.size(); ++k) {
        BitSum inside;
        add_common(once, targets[k].data() + at, words, inside);
        counts.inside[k] += sign * inside.total();
      }
      count_block(once, twice, all.data() + at, use, words, sums);
    };
    count(canvas.planes.data() + block * CountingCanvas::kBlockWords, after, 1);
    if (canvas.copying) count(canvas.copies.data() + i * CountingCanvas::kBlockWords, before, ~0ull);
  }
  const std::uint64_t wanted = after.wanted.total() - before.wanted.total();
  const std::uint64_t spilled = after.spilled.total() - before.spilled.total();
  counts.spilled += spilled;
  counts.covered += wanted + spilled;
  counts.overlap += after.overlap.total() - before.overlap.total();
  if (targets.size() == 1) counts.inside[0] += wanted;
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace espalier {

HWY_EXPORT(draw_model);
HWY_EXPORT(sweep_model);
HWY_EXPORT(draw_counting);
HWY_EXPORT(count_touched);

namespace {

/// Which blocks of a tile row have any and which have all bits set; `canvas` gives the layout.
BlockMap map_blocks(const BitGrid& bits, const VoxelCanvas& canvas) {
  BlockMap map{std::vector<std::uint64_t>(canvas.dirty.size()), std::vector<std::uint64_t>(canvas.dirty.size())};
  const std::size_t rows = canvas.dirty.size() / canvas.dirty_words, row_words = std::size_t{canvas.nx()} * 8;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t block = 0; block < canvas.blocks; ++block) {
      const std::uint32_t* first = bits.data() + row * row_words + block * kBlockTiles * 8;
      const std::uint32_t* last = bits.data() + row * row_words + std::min((block + 1) * kBlockTiles * 8, row_words);
      const std::size_t at = row * canvas.dirty_words + block / 64;
      const std::uint64_t bit = std::uint64_t{1} << block % 64;
      if (std::any_of(first, last, [](std::uint32_t word) { return word != 0; })) map.any[at] |= bit;
      if (std::all_of(first, last, [](std::uint32_t word) { return word == ~0u; })) map.full[at] |= bit;
    }
  }
  return map;
}

}  // namespace

VolumeKernel::VolumeKernel(const VoxelGrid& grid, std::vector<Solid> solids, std::vector<BitGrid> targets)
    : grid_(grid), solids_(std::move(solids)), targets_(std::move(targets)),
      union_(grid.cells[0], grid.cells[1], grid.cells[2]) {
  for (const BitGrid& target : targets_) unite(union_, target);
  used_ = map_blocks(union_, VoxelCanvas(Lattice(grid)));
}

void VolumeKernel::draw(std::span<const Instance> instances, VolumeView view, VolumeScratch& scratch) const {
  scratch.canvas.hits = scratch.canvas.outside = 0;
  HWY_DYNAMIC_DISPATCH(draw_model)(solids_, instances, view, scratch);
}

void VolumeKernel::sweep(VolumeScratch& scratch, VolumeCounts& counts) const {
  counts.inside.assign(targets_.size(), 0);
  HWY_DYNAMIC_DISPATCH(sweep_model)(targets_, union_, used_, scratch, counts);
  counts.hits = scratch.canvas.hits;
  counts.outside = scratch.canvas.outside;
}

void VolumeKernel::draw(std::span<const Instance> instances, VolumeView view, VolumeScratch& scratch,
                        CountingCanvas& canvas) const {
  canvas.hits = canvas.outside = 0;
  HWY_DYNAMIC_DISPATCH(draw_counting)(solids_, instances, view, scratch, canvas);
}

void VolumeKernel::add_change(const CountingCanvas& canvas, VolumeCounts& counts) const {
  HWY_DYNAMIC_DISPATCH(count_touched)(targets_, union_, used_, canvas, counts);
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
