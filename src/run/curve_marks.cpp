#include "run/curve_marks.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/counted.h"

namespace espalier {
namespace {

constexpr Colour kGlass{{150, 178, 222}};  // of ghosts, as they look on a light ground

std::string share(std::size_t part, std::size_t of, const char* whole) {
  return of == 0 ? "" : fmt::format(", {:.0f} % of {}", 100.0 * static_cast<double>(part) / static_cast<double>(of), whole);
}

std::string box_in_words(const Vec3& min, const Vec3& max) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})", min.x, min.y, min.z, max.x, max.y, max.z);
}

}  // namespace

Colour colour_of(CurveMark mark) {
  switch (mark) {
    case CurveMark::unused: return {{247, 175, 40}};
    case CurveMark::used: return {{24, 100, 190}};
    case CurveMark::follows: return {{74, 80, 90}};
    case CurveMark::strays: return {{205, 62, 20}};
  }
  return {};
}

MarkedCurves mark_curves(const CurveTarget& target, const Model& model) {
  const CurveCost& cost = target.cost();
  CurveTally tally;
  tally_bones(cost, model, tally);
  MarkedCurves marked;
  auto next = tally.uses.begin();
  for (std::uint32_t curve = 0; curve < cost.settings().curves.size(); ++curve) {
    marked.uses.emplace_back(next, next + cost.segments(curve));
    next += cost.segments(curve);
  }
  for (const Bone& bone : model.bones) {
    const BoneEffect effect = cost.judge(cost.nearest(bone.from), bone.from, bone.to);
    marked.bones.push_back(effect.distance + effect.alignment > 0 ? CurveMark::strays : CurveMark::follows);
  }
  return marked;
}

std::string curve_in_words(const CurveTarget& target, std::uint32_t curve) {
  const CubicBezier& drawn = target.cost().settings().curves[curve].curve;
  const double length = length_to(drawn, 1);
  const std::uint32_t segments = target.cost().segments(curve);
  return fmt::format("curve {}: {:.4g} m in {} of {:.3g} m", curve + 1, length, counted(segments, "segment"),
                     length / segments);
}

std::string settings_in_words(const GuidingCurve& curve) {
  std::string text = fmt::format("distance {:g} + {:g} d + {:g} d^2, alignment {:g} beyond {:g}, utilisation {:g}",
                                 curve.distance[0], curve.distance[1], curve.distance[2], curve.alignment,
                                 curve.offset, curve.utilisation);
  if (curve.thickness[0] > 0 || curve.thickness[1] > 0)
    text += fmt::format(", thickness {:g} to {:g} m", curve.thickness[0], curve.thickness[1]);
  return text;
}

std::vector<std::string> extras_in_words(const CurveSettings& settings) {
  std::vector<std::string> lines;
  if (settings.blend) lines.emplace_back("tangents are blended between the two nearest curves");
  if (settings.field_cells > 0)
    lines.push_back(fmt::format("read from a grid, {} along its longest edge", counted(settings.field_cells, "cell")));
  if (settings.density) {
    const BoneDensity& d = *settings.density;
    lines.push_back(fmt::format("at most {:g} bones per m3 from {}, in cells of {:g} m; beyond it {:g} per square",
                                d.wanted, box_in_words(d.min, d.max), d.cell, d.cost));
  }
  return lines;
}

std::vector<LegendRow> legend_of(const MarkedCurves& marked, const CurveSettings& settings) {
  std::size_t segments = 0, used = 0;
  for (const auto& curve : marked.uses) {
    segments += curve.size();
    used += static_cast<std::size_t>(std::count_if(curve.begin(), curve.end(), [](std::uint8_t n) { return n > 0; }));
  }
  const auto strays = static_cast<std::size_t>(std::count(marked.bones.begin(), marked.bones.end(), CurveMark::strays));
  const std::size_t bones = marked.bones.size();
  std::vector<LegendRow> rows;
  const auto add = [&](CurveMark mark, const std::string& text) { rows.push_back({{colour_of(mark)}, text}); };
  if (bones > 0) {
    add(CurveMark::used, "used: " + counted(used, "segment") + share(used, segments, "the curves"));
    add(CurveMark::unused, "not used: " + counted(segments - used, "segment"));
    add(CurveMark::follows, "follows: " + counted(bones - strays, "bone") + share(bones - strays, bones, "all"));
    add(CurveMark::strays, "strays: " + counted(strays, "bone") + ", too far away or not aligned");
  } else {
    add(CurveMark::unused, counted(marked.uses.size(), "curve") + ", " + counted(segments, "segment"));
  }
  const bool thick = std::any_of(settings.curves.begin(), settings.curves.end(), [](const GuidingCurve& curve) {
    return curve.thickness[0] > 0 || curve.thickness[1] > 0;
  });
  if (thick) rows.push_back({{kGlass}, "tubes: within them distance costs nothing"});
  if (settings.density) rows.push_back({{kGlass}, "box: where only so many bones are wanted"});
  return rows;
}

}  // namespace espalier
