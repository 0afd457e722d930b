#include "run/scene_curves.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "run/scene_choices.h"
#include "run/toml_section.h"

namespace espalier {
namespace {

constexpr double kMostWeight = 1e6;
constexpr float kFarthest = 1e5f;

template <std::size_t N>
void take_all(std::array<double, N>& out, const std::optional<std::vector<double>>& numbers) {
  if (numbers) std::copy(numbers->begin(), numbers->end(), out.begin());
}

/// Rules that join several keys. Errors begin with `prefix` and the key to blame, which `section` has.
void check(const TomlSection& section, const CurveSettings& settings, const std::string& prefix) {
  try {
    validate(settings);
  } catch (const Error& error) {
    const std::string text = error.what();
    const std::size_t end = text.find(' ');
    section.fail(text.substr(prefix.size(), end - prefix.size()), text.substr(end + 1));
  }
}

GuidingCurve read_curve(const TomlValue& table, const std::string& file, std::size_t index) {
  TomlSection s(table, file, fmt::format("curves.curve.{}", index));
  GuidingCurve curve;
  const auto points = s.vectors("points", 4, -kFarthest, kFarthest);
  if (!points) s.fail("", "must have points: the four control points of a cubic Bézier curve");
  std::copy(points->begin(), points->end(), curve.curve.points.begin());
  take_all(curve.distance, s.numbers("distance", 3, -kMostWeight, kMostWeight));
  take(curve.alignment, s.number("alignment", 0, kMostWeight));
  take(curve.offset, s.number("offset", -1, 1));
  take(curve.utilisation, s.number("utilisation", 0, kMostWeight));
  take(curve.segment, s.number("segment", 1e-6, kFarthest));
  take_all(curve.thickness, s.numbers("thickness", 2, 0, kFarthest, true));
  s.finish();
  check(s, {{curve}}, "curve.0.");
  return curve;
}

BoneDensity read_density(const TomlValue& table, const std::string& file) {
  TomlSection s(table, file, "curves.density");
  BoneDensity density;
  const auto min = s.vector("min", -kFarthest, kFarthest), max = s.vector("max", -kFarthest, kFarthest);
  if (!min || !max) s.fail("", "must have min and max: the corners of a box");
  density.min = *min, density.max = *max;
  take(density.cell, s.number("cell", 1e-6, kFarthest));
  take(density.wanted, s.number("wanted", 0, 1e9));
  take(density.cost, s.number("cost", 0, kMostWeight));
  s.finish();
  check(s, {{GuidingCurve()}, false, 0, density}, "density.");
  return density;
}

std::string curve_text(const GuidingCurve& curve) {
  std::string points;
  for (const Vec3& point : curve.curve.points) points += (points.empty() ? "" : ", ") + format_vector(point);
  return fmt::format(
      "\n[[curves.curve]]\npoints = [{}]\ndistance = [{}, {}, {}]\nalignment = {}\noffset = {}\nutilisation = {}\n"
      "segment = {}\nthickness = [{}, {}]\n",
      points, format_toml(curve.distance[0]), format_toml(curve.distance[1]), format_toml(curve.distance[2]),
      format_toml(curve.alignment), format_toml(curve.offset), format_toml(curve.utilisation),
      format_toml(curve.segment), format_toml(curve.thickness[0]), format_toml(curve.thickness[1]));
}

}  // namespace

SceneCurves read_curves(const TomlValue& table, const std::string& file) {
  TomlSection s(table, file, "curves");
  SceneCurves out;
  take(out.weight, s.number("weight", 0, kMostWeight));
  take(out.settings.blend, s.boolean("blend"));
  take(out.settings.field_cells, s.whole("field_cells", 0, 128));
  const std::vector<TomlValue>* curves = s.tables("curve");
  if (!curves || curves->empty()) s.fail("curve", "must be there at least once: [[curves.curve]] with points = [...]");
  if (curves->size() > CurveSettings::kMostCurves)
    s.fail("curve", fmt::format("must be at most {}, got {}", CurveSettings::kMostCurves, curves->size()));
  for (std::size_t i = 0; i < curves->size(); ++i) out.settings.curves.push_back(read_curve((*curves)[i], file, i));
  if (const TomlValue* density = s.table("density")) out.settings.density = read_density(*density, file);
  s.finish();
  check(s, out.settings, "");
  return out;
}

std::string curves_to_toml(const SceneCurves& curves) {
  const CurveSettings& settings = curves.settings;
  if (settings.curves.empty()) return "";
  std::string text = fmt::format("[curves]\nweight = {}\nblend = {}\nfield_cells = {}\n", format_toml(curves.weight),
                                 settings.blend, settings.field_cells);
  for (const GuidingCurve& curve : settings.curves) text += curve_text(curve);
  if (settings.density) {
    const BoneDensity& density = *settings.density;
    text += fmt::format("\n[curves.density]\nmin = {}\nmax = {}\ncell = {}\nwanted = {}\ncost = {}\n",
                        format_vector(density.min), format_vector(density.max), format_toml(density.cell),
                        format_toml(density.wanted), format_toml(density.cost));
  }
  return text;
}

}  // namespace espalier
