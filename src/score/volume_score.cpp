// What counts are worth, and how that is told: the formulas of volume_target.h.

#include <string>

#include <fmt/format.h>

#include "score/percentage.h"
#include "score/smootherstep.h"
#include "score/volume_target.h"

namespace espalier {
namespace {

double in_voxels(std::uint64_t count) { return static_cast<double>(count); }

double overlap_of(const VolumeSettings& settings, const VolumeCounts& counts) {
  return in_voxels(settings.overlap_count == OverlapCount::voxels ? counts.overlap : counts.hits - counts.covered);
}

}  // namespace

template <class Sink>
void VolumeTarget::each_term(const VolumeCounts& counts, const Sink& term) const {
  const VolumeSettings& s = settings();
  const double covered = in_voxels(counts.covered), spilled = in_voxels(counts.spilled);
  const double outside = in_voxels(counts.outside), overlap = overlap_of(s, counts);
  const bool linear = s.form == VolumeForm::linear;
  for (std::size_t i = 0; i < s.meshes.size(); ++i) {
    const double inside = in_voxels(counts.inside[i]), all = in_voxels(target_voxels(i));
    term("inside", &s.meshes[i], s.meshes[i].fill, inside, all, linear ? inside : smootherstep(inside, 0, all));
    if (linear) term("not in", &s.meshes[i], *s.meshes[i].spill, covered - inside, covered, covered - inside);
  }
  switch (s.form) {
    case VolumeForm::linear:
      term("overlap", nullptr, -s.overlap_weight, overlap, covered, overlap);
      term("outside the grid", nullptr, *s.outside_weight, outside, 0, outside);
      break;
    case VolumeForm::smootherstep: {
      const double wrong = spilled + overlap + outside, of = 2 * wanted_;
      term("spilled, overlap and outside the grid", nullptr, -spill_, wrong, of, smootherstep(wrong, 0, of));
      break;
    }
    case VolumeForm::smootherstep_separate: {
      const double wrong = spilled + outside, of = 3 * wanted_;
      term("spilled and outside the grid", nullptr, -spill_, wrong, of, smootherstep(wrong, 0, of));
      term("overlap", nullptr, -s.overlap_weight, overlap, covered, smootherstep(overlap, 0, covered));
      break;
    }
  }
}

double VolumeTarget::evaluate(const VolumeCounts& counts) const {
  double sum = 0;
  each_term(counts, [&](const char*, const VolumeMesh*, double weight, double, double, double factor) {
    sum += weight * factor;
  });
  return sum;
}

std::vector<Term> VolumeTarget::breakdown(const VolumeCounts& counts) const {
  std::vector<Term> terms;
  each_term(counts, [&](const char* name, const VolumeMesh* mesh, double weight, double count, double of,
                        double factor) {
    Term t;
    t.name = mesh == nullptr ? name : fmt::format("{} {}", name, mesh->name);
    t.weight = weight;
    t.count = count;
    t.of = of;
    t.value = weight * factor;
    t.unit = "voxels";
    terms.push_back(std::move(t));
  });
  return terms;
}

std::string VolumeTarget::describe(const VolumeCounts& counts) const {
  double filled = 0, to_fill = 0, hit = 0, to_avoid = 0;
  for (std::size_t i = 0; i < settings().meshes.size(); ++i) {
    const bool avoid = settings().meshes[i].fill < 0;
    (avoid ? hit : filled) += in_voxels(counts.inside[i]);
    (avoid ? to_avoid : to_fill) += in_voxels(target_voxels(i));
  }
  const double covered = in_voxels(counts.covered), outside = in_voxels(counts.outside);
  std::string words;
  if (to_fill > 0) words = fmt::format("{} filled, ", percentage(filled, to_fill));
  if (to_avoid > 0) words += fmt::format("{} of what to avoid hit, ", percentage(hit, to_avoid));
  words += fmt::format("{} {}, {} overlap", percentage(in_voxels(counts.spilled), covered),
                       to_fill > 0 ? "spilled" : "elsewhere", percentage(overlap_of(settings(), counts), covered));
  if (outside > 0) {
    words += fmt::format(", {} outside the grid", percentage(outside, in_voxels(counts.hits) + outside));
  }
  return words;
}

Explanation VolumeTarget::explain(const Derivation& derivation, const Model& model, TargetScratch* scratch) const {
  static_cast<void>(derivation);
  const VolumeCounts counted = counts(model.instances, *scratch);
  Explanation e;
  e.name = name();
  e.score = evaluate(counted);
  e.optimum = optimum();
  e.percent = percent_of(e.score, e.optimum);
  e.terms = breakdown(counted);
  e.words = describe(counted);
  return e;
}

}  // namespace espalier
