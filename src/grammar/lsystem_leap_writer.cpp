// What moves the frame on behind a child, to where its own string ends.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "grammar/lsystem_writer.h"

namespace espalier::lsystem {
namespace {

using Vector = Leap::Vector;

bool is_zero(const Vector& v) {
  return std::all_of(v.begin(), v.end(), [](double x) { return std::abs(x) < 1e-12; });
}

std::string number(double x) { return fmt::format("{:.10g}", std::abs(x) < 1e-12 ? 0.0 : x); }

std::string vector(const Vector& v) { return fmt::format("({}, {}, {})", number(v[0]), number(v[1]), number(v[2])); }

/// The factor between neighbours, where it is one and the same.
std::optional<double> ratio(const std::vector<Vector>& ways) {
  if (is_zero(ways[0])) return std::nullopt;
  std::size_t largest = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(ways[0][k]) > std::abs(ways[0][largest])) largest = k;
  if (ways.size() < 2) return 1;
  const double factor = ways[1][largest] / ways[0][largest];
  for (std::size_t i = 1; i < ways.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(ways[i][k] - factor * ways[i - 1][k]) > 1e-9 * std::max(1.0, std::abs(ways[i][largest])))
        return std::nullopt;
  return std::abs(factor - std::round(factor)) < 1e-12 ? std::round(factor) : factor;
}

struct AxisAngle {
  Vector axis{0, 1, 0};
  double degrees = 0;
};

AxisAngle axis_angle(const std::array<Vector, 3>& m) {  // m[column][row]
  const Vector twice_sine = {m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]};
  const double s =
      std::sqrt(twice_sine[0] * twice_sine[0] + twice_sine[1] * twice_sine[1] + twice_sine[2] * twice_sine[2]) / 2;
  const double c = (m[0][0] + m[1][1] + m[2][2] - 1) / 2;
  AxisAngle result;
  result.degrees = std::atan2(s, c) * 180 / std::numbers::pi;
  if (result.degrees < 1e-9) return {};
  if (s > 1e-6) {
    for (std::size_t k = 0; k < 3; ++k) result.axis[k] = twice_sine[k] / (2 * s);
    return result;
  }
  std::size_t k = 0;  // half a turn: R + 1 = 2 a a^T, whose largest column leads along a
  for (std::size_t i = 1; i < 3; ++i)
    if (m[i][i] > m[k][k]) k = i;
  const double length = std::sqrt((m[k][k] + 1) / 2);
  for (std::size_t i = 0; i < 3; ++i) result.axis[i] = (m[k][i] + (i == k ? 1 : 0)) / (2 * length);
  return result;
}

/// Makes all turns go about one axis, of which no component is negative where it is one of ours; false where they do
/// not.
bool align(std::vector<AxisAngle>& turns) {
  const AxisAngle* first = nullptr;
  for (AxisAngle& turn : turns) {
    if (turn.degrees == 0) continue;
    const double sum = turn.axis[0] + turn.axis[1] + turn.axis[2];
    if (sum < 0) {
      for (double& x : turn.axis) x = -x;
      turn.degrees = -turn.degrees;
    }
    if (!first) first = &turn;
    for (std::size_t k = 0; k < 3; ++k)
      if (std::abs(turn.axis[k] - first->axis[k]) > 1e-9) return false;
  }
  if (!first) return true;
  const Vector axis = first->axis;
  for (AxisAngle& turn : turns) turn.axis = axis;
  return true;
}

std::string power_of(const std::string& left) { return left.find(' ') == std::string::npos ? left : "(" + left + ")"; }

}  // namespace

/// By the steps that are left, 0 to all; found once.
const std::optional<std::vector<Leap>>& Writer::leaps_of(const Species& species, bool scaled) {
  const auto [place, fresh] = leaps_.try_emplace({&species, scaled});
  if (fresh) place->second = find_leaps(species, scaled);
  return place->second;
}

std::optional<std::vector<Leap>> Writer::find_leaps(const Species& species, bool scaled) {
  const Species& other = other_steps_.species()[static_cast<std::size_t>(&species - steps_.species().data())];
  std::vector<Leap> result;
  bool by_angle = false;
  for (int left = 0; left <= system_.iterations; ++left) {
    const std::optional<Leap> leap = steps_.leap(species, left, scaled);
    if (!leap) return std::nullopt;
    result.push_back(*leap);
    const std::optional<Leap> turned = other_steps_.leap(other, left, scaled);
    by_angle |= !turned || !same(*leap, *turned);
  }
  angle_is_fixed_ |= by_angle;
  return result;
}

void Writer::emit_leap(const Module& m, const Species& species, Body& body) {
  std::string by;
  std::optional<std::vector<Leap>> leaps = leaps_of(species, false);
  if (!leaps && !m.args.empty()) {
    leaps = leaps_of(species, true);
    by = factor(m.args[0], body) + " * ";
  }
  if (!leaps)
    return fail("L0203", m.span,
                fmt::format("what follows `{}` cannot know where it ends: that depends on its arguments or on a choice",
                            m.symbol),
                "put it last, or between [ and ], as in `F[+X]FX`");
  emit_way(species, *leaps, false, by + use_step_if(*leaps), body);
  emit_way(species, *leaps, true, by, body);
  emit_rotation(species, *leaps, body);
  end_line(body);
}

/// `step * `, where a way is counted in steps.
std::string Writer::use_step_if(const std::vector<Leap>& leaps) {
  const bool any = std::any_of(leaps.begin(), leaps.end(), [](const Leap& l) { return !is_zero(l.unit); });
  return any ? use("step") + " * " : "";
}

void Writer::emit_way(const Species& species, const std::vector<Leap>& leaps, bool fixed, const std::string& by,
                      Body& body) {
  std::vector<Vector> ways;
  for (const Leap& leap : leaps) ways.push_back(fixed ? leap.fixed : leap.unit);
  if (std::all_of(ways.begin(), ways.end(), is_zero)) return;
  const std::optional<double> factor = ratio(ways);
  const std::string wanted = species.symbol + "_end";
  if (!factor) {
    std::vector<std::string> values;
    for (const Vector& way : ways) values.push_back(vector(way));
    const std::string name = table(species.symbol + (fixed ? "_path" : "_way"), values);
    return add(body, "move " + named(fmt::format("{}{}({})", by, name, body.left), wanted.c_str(), body));
  }
  std::string growth;
  if (*factor != 1) growth = fmt::format(" * {} ^ {}", number(*factor), power_of(body.left));
  const bool straight = std::abs(ways[0][0]) < 1e-12 && std::abs(ways[0][2]) < 1e-12;
  const std::string first = straight ? number(ways[0][1]) : vector(ways[0]);
  const std::string whole = by.ends_with(" * ") && first == "1" ? by.substr(0, by.size() - 3) : by + first;
  if (growth.find("iterations") != std::string::npos) use("iterations");
  add(body, (straight ? "forward " : "move ") + named(whole + growth, wanted.c_str(), body));
}

void Writer::emit_rotation(const Species& species, const std::vector<Leap>& leaps, Body& body) {
  std::vector<AxisAngle> turns;
  for (const Leap& leap : leaps) turns.push_back(axis_angle(leap.axes));
  const bool one_axis = align(turns);
  std::vector<std::string> axes, angles;
  for (const AxisAngle& turn : turns) {
    axes.push_back(vector(turn.axis));
    angles.push_back(number(turn.degrees) + "deg");
  }
  const bool one_angle = std::equal(angles.begin() + 1, angles.end(), angles.begin());
  if (one_angle && angles[0] == "0deg") return;
  const std::string angle =
      one_angle ? angles[0] : fmt::format("{}({})", table(species.symbol + "_turn", angles), body.left);
  if (one_axis) {
    static const std::map<std::string, std::string> kWords = {
        {"(0, 0, 1)", "yaw"}, {"(1, 0, 0)", "pitch"}, {"(0, 1, 0)", "roll"}};
    const auto word = kWords.find(axes[0]);
    return add(body, fmt::format("{} {}", word == kWords.end() ? "turn " + axes[0] : word->second, angle));
  }
  // `turn` takes a vector that is written out, so its components come one by one.
  const std::string axis = fmt::format("{}({})", table(species.symbol + "_axis", axes), body.left);
  const std::string about = named(axis, "about", body);
  add(body, fmt::format("turn ({}.x, {}.y, {}.z) {}", about, about, about, angle));
}

/// A function of the steps that are left.
std::string Writer::table(const std::string& what, const std::vector<std::string>& values) {
  const std::string name = tables_.at(what);
  if (!written_tables_.insert(what).second) return name;
  std::string text;
  for (std::size_t i = 0; i + 1 < values.size(); ++i)
    if (values[i] != values[i + 1]) text += fmt::format("left < {} ? {} : ", i + 1, values[i]);
  functions_ += fmt::format("fn {}(left) = {}{}\n", name, text, values.back());
  return name;
}

}  // namespace espalier::lsystem
