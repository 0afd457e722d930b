// Where the turtle stands behind a module that is rewritten further: children get a copy of the frame and give none
// back, so what follows them has to be told.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grammar/lsystem_steps.h"

namespace espalier::lsystem {
namespace {

using Vector = Leap::Vector;

Vector map(const Leap& leap, const Vector& v) {
  Vector result{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) result[k] += leap.axes[i][k] * v[i];
  return result;
}

Leap then(const Leap& a, const Leap& b) {
  Leap result = a;
  const Vector unit = map(a, b.unit), fixed = map(a, b.fixed);
  for (std::size_t k = 0; k < 3; ++k) result.unit[k] += unit[k], result.fixed[k] += fixed[k];
  for (std::size_t i = 0; i < 3; ++i) result.axes[i] = map(a, b.axes[i]);
  return result;
}

/// A turn about an axis, counter-clockwise seen from its tip.
Leap turn(std::size_t axis, double degrees) {
  Leap result;
  const double radians = degrees * std::numbers::pi / 180;
  double s = std::sin(radians), c = std::cos(radians);
  if (std::abs(s) < 1e-15) s = 0;  // right angles stay exact
  if (std::abs(c) < 1e-15) c = 0;
  const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
  result.axes[i][i] = c, result.axes[i][j] = s, result.axes[j][i] = -s, result.axes[j][j] = c;
  return result;
}

bool near(const Vector& a, const Vector& b, double scale) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(a[k] - b[k]) > 1e-9 * std::max(1.0, scale)) return false;
  return true;
}

double size(const Leap& leap) {
  double result = 0;
  for (std::size_t k = 0; k < 3; ++k) result = std::max({result, std::abs(leap.unit[k]), std::abs(leap.fixed[k])});
  return result;
}

bool same_axes(const Leap& a, const Leap& b) {
  return near(a.axes[0], b.axes[0], 1) && near(a.axes[1], b.axes[1], 1) && near(a.axes[2], b.axes[2], 1);
}

}  // namespace

bool same(const Leap& a, const Leap& b) {
  return near(a.unit, b.unit, size(a)) && near(a.fixed, b.fixed, size(a)) && same_axes(a, b);
}

/// A module by itself: a turtle command, or a symbol that does nothing.
std::optional<Leap> Steps::leap_of(const Module& module, const Values& values, int left) const {
  const Species* species = find(module);
  const double growth = species && species->growth ? std::pow(*species->growth, left) : 1;
  double value = growth;
  if (!module.args.empty()) {
    const std::optional<double> given = evaluate(module.args[0], values);
    if (!given) return std::nullopt;
    value *= *given;
  }
  const char c = module.symbol[0];
  Leap result;
  if (draws(module) || moves(module)) {
    (module.args.empty() ? result.unit : result.fixed)[1] = value;
    return result;
  }
  if (c == '|') return turn(2, 180);
  const double degrees = module.args.empty() ? growth * system_.angle : value;
  if (c == '+') result = turn(2, degrees);
  if (c == '-') result = turn(2, -degrees);
  if (c == '^') result = turn(0, degrees);
  if (c == '&') result = turn(0, -degrees);
  if (c == '/') result = turn(1, degrees);
  if (c == '\\') result = turn(1, -degrees);
  return result;
}

std::optional<Leap> Steps::leap_of(const std::vector<Module>& modules, const Values& values, int left) const {
  Leap result;
  int depth = 0;
  for (const Module& m : modules) {
    if (leap_budget_ == 0) return std::nullopt;
    --leap_budget_;
    if (m.symbol == "[") ++depth;
    if (m.symbol == "]") --depth;
    if (depth > 0 || m.symbol == "]") continue;
    const Species* species = find(m);
    std::optional<Leap> next;
    if (species && !species->growth) {
      const std::optional<Arguments> args = arguments(m, values);
      if (!args) return std::nullopt;
      next = leap_of(static_cast<std::size_t>(species - species_.data()), *args, left);
    } else {
      next = leap_of(m, values, left);
    }
    if (!next) return std::nullopt;
    result = then(result, *next);
  }
  return std::isfinite(size(result)) ? std::optional(result) : std::nullopt;
}

std::optional<Leap> Steps::leap_of(std::size_t index, const Arguments& args, int left) const {
  const Species& species = species_[index];
  const auto known = leaps_.find({{index, args}, left});
  if (known != leaps_.end()) return known->second;
  std::optional<Leap> result;
  const auto match = matching(species, args);
  if (match && (left == 0 || match->empty())) {
    Module self{species.symbol, {}, {}};
    for (const double value : args) self.args.push_back({Op::number, {}, value, {}, {}});
    result = leap_of(self, values(species, args), 0);
  } else if (match) {
    for (const std::size_t p : *match) {
      const auto one = leap_of(system_.productions[p].successor, values(species, args), left - 1);
      if (!one || (p != *match->begin() && !(result && same(*result, *one)))) {
        result.reset();
        break;
      }
      result = one;
    }
  }
  leaps_[{{index, args}, left}] = result;
  return result;
}

std::optional<Leap> Steps::leap(const Species& species, int left, bool scaled) const {
  const std::size_t index = static_cast<std::size_t>(&species - species_.data());
  if (species.params.empty()) return scaled ? std::nullopt : leap_of(index, {}, left);
  if (!followed_) return std::nullopt;
  std::optional<Leap> result;
  for (const Arguments& args : modules_[static_cast<std::size_t>(system_.iterations - left)][index]) {
    std::optional<Leap> one = leap_of(index, args, left);
    if (!one || (scaled && args[0] == 0)) return std::nullopt;
    for (std::size_t k = 0; scaled && k < 3; ++k) one->unit[k] /= args[0], one->fixed[k] /= args[0];
    if (result && !same(*result, *one)) return std::nullopt;
    result = one;
  }
  return result ? result : Leap{};
}

}  // namespace espalier::lsystem
