#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)  // see volume_kernel.cpp
#define HWY_COMPILE_ALL_ATTAINABLE

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "score/silhouette_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "base/check.h"
#include "score/fold_draw-inl.h"
#include "score/silhouette-inl.h"
#include "score/silhouette_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace espalier {
namespace HWY_NAMESPACE {

void draw_by_pixel(const Caster& caster, const Instance& instance, const Projection& projection,
                   const Outline& outline, PixelCanvas& canvas) {
  for (std::int32_t row = outline.row[0]; row < outline.row[1]; ++row)
    for (std::int32_t column = outline.column[0]; column < outline.column[1]; ++column)
      if (meets(caster, instance, ray_through(projection, column + 0.5, row + 0.5)))
        canvas.set(static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row));
}

/// Any part, one at a time.
void draw_carefully(const Caster& caster, const Instance& instance, const Projection& projection,
                    SilhouetteScratch& scratch) {
  OutlineMaker& maker = scratch.maker;
  switch (maker.set(caster, instance)) {
    case OutlineMaker::Result::nothing: break;
    case OutlineMaker::Result::outline: draw_outline(maker.outline(), scratch.canvas); break;
    case OutlineMaker::Result::triangles:
      for (std::size_t i = 0; i < maker.triangles(); ++i)
        if (maker.triangle(i)) draw_outline(maker.outline(), scratch.canvas);
      break;
    case OutlineMaker::Result::by_pixel:
      draw_by_pixel(caster, instance, projection, maker.outline(), scratch.canvas);
      break;
  }
}

/// Draws the parts of a queue, and empties it.
void flush(PartQueue& queue, BatchKind kind, const std::vector<Caster>& casters, const Projection& projection,
           SilhouetteScratch& scratch) {
  if (queue.count == 0) return;
  for (int lane = queue.count; lane < 8; ++lane) queue.part[lane] = queue.part[0], queue.top[lane] = 1;
  OutlineBatch batch;
  batch.load(projection, queue);
  switch (kind) {
    case BatchKind::sphere: batch.set_spheres(); break;
    case BatchKind::round: batch.set_rounds(); break;
    case BatchKind::box: batch.set_boxes(); break;
  }
  batch.finish(projection);
  for (int lane = 0; lane < queue.count; ++lane) {
    const Instance& part = *queue.part[lane];
    if (batch.ready_[lane] != 0) draw_lane(batch, kind, lane, scratch.canvas);
    else draw_carefully(casters[part.mesh], part, projection, scratch);
  }
  queue.count = 0;
}

void draw_silhouette(const std::vector<Caster>& casters, const Projection& projection,
                     std::span<const Instance> instances, VolumeView view, SilhouetteScratch& scratch) {
  PartQueue queues[3];
  for (const Instance& instance : instances) {
    if (!(view == VolumeView::full ? in_full(instance) : in_parts(instance))) continue;
    const Caster& caster = casters[instance.mesh];
    BatchKind kind = BatchKind::box;
    if (caster.kind == Caster::Kind::sphere) {
      kind = BatchKind::sphere;
    } else if (caster.kind == Caster::Kind::round) {
      kind = BatchKind::round;
    } else if (caster.kind != Caster::Kind::box) {
      if (caster.folds.faces == 0 ||
          !draw_folds(caster.folds, instance, projection, scratch.folds, scratch.canvas))
        draw_carefully(caster, instance, projection, scratch);
      continue;
    }
    PartQueue& queue = queues[static_cast<int>(kind)];
    queue.part[queue.count] = &instance;
    queue.top[queue.count] = caster.tapered ? instance.top : 1;
    if (++queue.count == 8) flush(queue, kind, casters, projection, scratch);
  }
  for (int k = 0; k < 3; ++k) flush(queues[k], static_cast<BatchKind>(k), casters, projection, scratch);
}

void sweep_silhouette(PixelCanvas& canvas, const WeightTiles& weights, SilhouetteCounts& counts) {
  if (weights.graded) sweep_graded(canvas, weights, counts);
  else if (weights.all.wanted + weights.all.free == weights.all.covered) sweep_uniform<true>(canvas, weights, counts);
  else sweep_uniform<false>(canvas, weights, counts);
}

}  // namespace HWY_NAMESPACE
}  // namespace espalier
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace espalier {

HWY_EXPORT(draw_silhouette);
HWY_EXPORT(sweep_silhouette);

WeightTiles::WeightTiles(const WeightImage& image)
    : wanted(image.width, image.height), free(image.width, image.height) {
  const auto note = [&](std::int32_t degree, std::int32_t& alike, std::uint64_t& pixels, std::uint64_t& sum) {
    if (alike == 0) alike = degree;
    graded |= alike != degree;
    ++pixels;
    sum += static_cast<std::uint64_t>(degree);
  };
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const std::int32_t degree = image.at(column, row);
      if (degree > 0) wanted.set(column, row), note(degree, wanted_degree, all.wanted, all.wanted_sum);
      if (degree < 0) free.set(column, row), note(-degree, free_degree, all.free, all.free_sum);
    }
  }
  all.covered = std::uint64_t{image.width} * image.height;
  if (!graded) return;
  degrees.resize(wanted.words.size() * 32);
  wanted_of_tile.resize(wanted.tiles());
  free_of_tile.resize(wanted.tiles());
  for (std::uint32_t row = 0; row < image.height; ++row) {
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const std::int32_t degree = image.at(column, row);
      const std::size_t tile = wanted.word_index(column, row) / 8;
      degrees[(tile * 32 + column % 32) * 8 + row % 8] = std::abs(degree);
      (degree > 0 ? wanted_of_tile : free_of_tile)[tile] += std::abs(degree);
    }
  }
}

SilhouetteKernel::SilhouetteKernel(const Projection& projection, std::vector<Caster> casters, const WeightImage& image)
    : projection_(projection), casters_(std::move(casters)), weights_(image) {
  CHECK(image.width == projection.width && image.height == projection.height);
}

void SilhouetteKernel::draw(std::span<const Instance> instances, VolumeView view, SilhouetteScratch& scratch) const {
  HWY_DYNAMIC_DISPATCH(draw_silhouette)(casters_, projection_, instances, view, scratch);
}

SilhouetteCounts SilhouetteKernel::sweep(SilhouetteScratch& scratch) const {
  SilhouetteCounts counts;
  HWY_DYNAMIC_DISPATCH(sweep_silhouette)(scratch.canvas, weights_, counts);
  return counts;
}

}  // namespace espalier

#endif  // HWY_ONCE
