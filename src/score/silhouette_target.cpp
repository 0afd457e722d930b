#include "score/silhouette_target.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "score/percentage.h"
#include "score/smootherstep.h"

namespace espalier {
namespace {

/// In full pixels.
double degrees(std::uint64_t sum) { return static_cast<double>(sum) / WeightImage::kFull; }

const SilhouetteSettings& checked(const SilhouetteSettings& settings) {
  const auto fail = [&](const std::string& what) { throw Error(fmt::format("{}: {}", settings.name, what)); };
  for (const auto& [key, weight] : {std::pair("want", settings.want), std::pair("avoid", settings.avoid)})
    if (!std::isfinite(weight) || weight < 0) fail(fmt::format("{} must be >= 0, got {}", key, weight));
  const WeightImage& image = settings.image;
  if (image.width != settings.projection.width || image.height != settings.projection.height)
    fail(fmt::format("the image has {} x {} pixels, its camera {} x {}", image.width, image.height,
                     settings.projection.width, settings.projection.height));
  for (const std::int32_t degree : image.degrees)
    if (degree != 0) return settings;
  fail("no pixel of the image matters: all are mid-grey or transparent");
  return settings;
}

}  // namespace

SilhouetteTarget::SilhouetteTarget(SilhouetteSettings settings, const MeshTable& meshes)
    : settings_(checked(settings)), kernel_(settings.projection, make_casters(meshes), settings_.image) {}

SilhouetteTarget::~SilhouetteTarget() = default;

std::unique_ptr<TargetScratch> SilhouetteTarget::make_scratch() const {
  return std::make_unique<SilhouetteScratch>(settings_.projection);
}

SilhouetteCounts SilhouetteTarget::counts(std::span<const Instance> instances, TargetScratch& scratch) const {
  return kernel_.count(instances, settings_.view, static_cast<SilhouetteScratch&>(scratch));
}

PixelCanvas SilhouetteTarget::silhouette(std::span<const Instance> instances) const {
  SilhouetteScratch scratch(settings_.projection);
  kernel_.draw(instances, settings_.view, scratch);
  return std::move(scratch.canvas);
}

double SilhouetteTarget::evaluate(const SilhouetteCounts& counts) const {
  const double wanted = degrees(counts.wanted_sum), free = degrees(counts.free_sum);
  if (settings_.form == SilhouetteForm::linear) return settings_.want * wanted - settings_.avoid * free;
  const SilhouetteCounts& all = kernel_.weights().all;
  const double of = degrees(all.wanted_sum > 0 ? all.wanted_sum : all.free_sum);
  return settings_.want * smootherstep(wanted, 0, of) - settings_.avoid * smootherstep(free, 0, of);
}

double SilhouetteTarget::score(const Derivation&, const Model& model, TargetScratch* scratch) const {
  return evaluate(counts(model.instances, *scratch));
}

double SilhouetteTarget::optimum() const {
  SilhouetteCounts best;
  best.wanted_sum = kernel_.weights().all.wanted_sum;
  return evaluate(best);
}

Explanation SilhouetteTarget::explain(const Derivation&, const Model& model, TargetScratch* scratch) const {
  const SilhouetteCounts counted = counts(model.instances, *scratch);
  const SilhouetteCounts& all = kernel_.weights().all;
  Explanation e;
  e.name = name();
  e.score = evaluate(counted);
  e.optimum = optimum();
  e.percent = percent_of(e.score, e.optimum);
  const auto term = [&](const char* what, double weight, std::uint64_t count, std::uint64_t of, SilhouetteCounts part) {
    e.terms.push_back({what, weight, static_cast<double>(count), static_cast<double>(of), evaluate(part), "pixels"});
  };
  term("wanted and covered", settings_.want, counted.wanted, all.wanted, {.wanted_sum = counted.wanted_sum});
  term("covered, to be left free", -settings_.avoid, counted.free, counted.covered, {.free_sum = counted.free_sum});
  e.words = fmt::format("{} of what is wanted covered, {} spilled",
                        percentage(degrees(counted.wanted_sum), degrees(all.wanted_sum)),
                        percentage(static_cast<double>(counted.free), static_cast<double>(counted.covered)));
  return e;
}

}  // namespace espalier
