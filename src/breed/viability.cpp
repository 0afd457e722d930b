#include "breed/viability.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model/parts.h"
#include "search/require.h"

namespace espalier {
namespace {

constexpr int kCells = 24;                      // along the longest side
constexpr std::uint32_t kMostSamples = 2'000'000;  // of all parts

PerMeasure<bool> all_measures() {
  PerMeasure<bool> wanted;
  for (const Measure measure : kAllMeasures) wanted[measure] = true;
  return wanted;
}

/// A part's box in model space: where its middle is, and its half edges as vectors.
struct TurnedBox {
  Vec3 centre;
  Vec3 half[3];

  TurnedBox(const Bounds& box, const Frame& frame) : centre(frame.point(box.centre())) {
    const Vec3 size = 0.5f * box.size();
    for (int i = 0; i < 3; ++i) half[i] = frame.basis[i] * size[i];
  }
  float reach(int axis) const { return std::abs(half[0][axis]) + std::abs(half[1][axis]) + std::abs(half[2][axis]); }
  float edge(int i) const { return 2 * std::sqrt(glm::dot(half[i], half[i])); }
};

bool is_shown(const Instance& part, const Bounds& box) {
  return in_full(part) && !box.empty() && can_be_shown(part.model_from_mesh);
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

}  // namespace

void validate(const ViabilitySettings& s) {
  require_range("most_below_ground", s.most_below_ground, 0.0, 1.0);
  require_range("most_crowding", s.most_crowding, 0.0, 1.0);
  for (const Measure measure : kAllMeasures) validate(measure, s.limits[measure]);
}

Viability::Viability(const MeshTable& meshes, const ViabilitySettings& settings)
    : settings_(settings), gauge_(meshes, VolumeView::full, all_measures()) {
  validate(settings);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    meshes_.push_back({meshes.mesh_bounds(i), std::abs(volume(meshes.mesh(i))), meshes.ref(i).kind == MeshKind::cone});
  }
}

ViabilityReport Viability::judge(const Derivation& derivation, const Model& model, Scratch& scratch) const {
  ViabilityReport report;
  gauge_.measure(derivation, model, scratch.gauge, report.measures);
  report.below_ground = below_ground(model);
  report.crowding = crowding(model, scratch);
  if (model.truncated) report.reasons.push_back("it is too large: parts are missing");
  if (report.measures[Measure::parts] == 0) report.reasons.push_back("there is nothing to see");
  if (report.below_ground > settings_.most_below_ground) {
    report.reasons.push_back(fmt::format("{} of it grows below the ground", percent(report.below_ground)));
  }
  if (report.crowding > settings_.most_crowding) {
    report.reasons.push_back(fmt::format("{} of it lies inside other parts", percent(report.crowding)));
  }
  for (const Measure measure : kAllMeasures) {
    const Limit& limit = settings_.limits[measure];
    if (!limit.accepts(report.measures[measure])) {
      report.reasons.push_back(describe_rejection(measure, limit, report.measures[measure]));
    }
  }
  report.viable = report.reasons.empty();
  return report;
}

double Viability::below_ground(const Model& model) const {
  double below = 0, all = 0;
  for (const Instance& part : model.instances) {
    const MeshFacts& mesh = meshes_[part.mesh];
    if (!is_shown(part, mesh.box)) continue;
    const TurnedBox box(mesh.box, part.model_from_mesh);
    const double a = box.edge(0), b = box.edge(1), c = box.edge(2), surface = a * b + b * c + c * a;
    const double reach = box.reach(1), top = box.centre.y + reach;
    all += surface;
    if (reach > 0) below += surface * std::clamp(1 - top / (2 * reach), 0.0, 1.0);
    if (reach <= 0 && top < 0) below += surface;
  }
  return all > 0 ? below / all : 0;
}

double Viability::crowding(const Model& model, Scratch& scratch) const {
  Bounds whole;
  for (const Instance& part : model.instances) {
    const MeshFacts& mesh = meshes_[part.mesh];
    if (!is_shown(part, mesh.box)) continue;
    const TurnedBox box(mesh.box, part.model_from_mesh);
    const Vec3 reach(box.reach(0), box.reach(1), box.reach(2));
    whole.add(box.centre - reach), whole.add(box.centre + reach);
  }
  if (whole.empty()) return 0;
  const Vec3 size = whole.size();
  const float cell = std::max({size.x, size.y, size.z}) / kCells;
  if (!(cell > 0)) return 0;
  scratch.filled.assign(std::size_t{kCells} * kCells * kCells, 0);
  const double all = fill(model, whole.min, cell, scratch.filled);
  const float room = cell * cell * cell;
  double beyond = 0;
  for (const float volume : scratch.filled) beyond += std::max(0.0f, volume - room);
  return all > 0 ? beyond / all : 0;
}

/// Spreads the volume of each part evenly over points of its box; returns the sum of the volumes.
double Viability::fill(const Model& model, const Vec3& corner, float cell, std::vector<float>& filled) const {
  std::uint32_t left = kMostSamples;
  double all = 0;
  for (const Instance& part : model.instances) {
    const MeshFacts& mesh = meshes_[part.mesh];
    if (!is_shown(part, mesh.box) || mesh.volume <= 0) continue;
    const TurnedBox box(mesh.box, part.model_from_mesh);
    const double top = mesh.cone ? std::max(part.top, 0.0f) : 1;
    const double scale = std::abs(glm::determinant(part.model_from_mesh.basis));
    const double volume = scale * mesh.volume * (1 + top + top * top) / 3;
    std::uint32_t n[3];
    for (int i = 0; i < 3; ++i) n[i] = std::clamp(static_cast<std::uint32_t>(std::ceil(box.edge(i) / cell)), 1u, 48u);
    if (n[0] * n[1] * n[2] > left) n[0] = n[1] = n[2] = 1;
    left -= std::min(left, n[0] * n[1] * n[2]);
    const auto share = static_cast<float>(volume / (n[0] * n[1] * n[2]));
    all += volume;
    const auto offset = [&](int i, std::uint32_t k) {
      return (static_cast<float>(2 * k + 1) / static_cast<float>(n[i]) - 1) * box.half[i];
    };
    for (std::uint32_t x = 0; x < n[0]; ++x) {
      for (std::uint32_t y = 0; y < n[1]; ++y) {
        for (std::uint32_t z = 0; z < n[2]; ++z) {
          const Vec3 at = (box.centre + offset(0, x) + offset(1, y) + offset(2, z) - corner) / cell;
          const auto index = [&](float v) {
            return static_cast<std::size_t>(std::clamp(static_cast<int>(v), 0, kCells - 1));
          };
          filled[(index(at.x) * kCells + index(at.y)) * kCells + index(at.z)] += share;
        }
      }
    }
  }
  return all;
}

}  // namespace espalier
