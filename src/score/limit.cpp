#include "score/limit.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "score/smootherstep.h"

namespace espalier {
namespace {

// Four digits say enough, unless two numbers that differ would read the same.
std::string number(const MeasureFacts& facts, double value, double beside) {
  if (facts.whole) return fmt::format("{}", value);
  const std::string brief = fmt::format("{:.4g}", value);
  return value != beside && brief == fmt::format("{:.4g}", beside) ? fmt::format("{}", value) : brief;
}

std::string number_with_unit(Measure measure, double value, double beside) {
  const MeasureFacts& facts = facts_of(measure);
  std::string text = number(facts, value, beside);
  if (facts.unit.empty()) return text;
  text += fmt::format(" {}", facts.unit);
  if (facts.whole && value == 1) text.pop_back();  // units of counts are plurals
  return text;
}

// "57 genes", "height 4.2 m", "balance 0.43": counts speak for themselves, but for levels of what.
std::string named(Measure measure, double value, double beside) {
  const std::string text = number_with_unit(measure, value, beside);
  const bool counted = facts_of(measure).name == facts_of(measure).unit;
  return counted ? text : fmt::format("{} {}", facts_of(measure).name, text);
}

}  // namespace

double Limit::cost(double value) const {
  if (!(weight > 0)) return 0;
  return weight * (from <= to ? smootherstep(value, from, to) : smootherstep(from - value, 0, from - to));
}

void validate(Measure measure, const Limit& limit) {
  const auto fail = [&](const std::string& rule) {
    throw Error(fmt::format("limits.{}: {}", facts_of(measure).name, rule));
  };
  for (const std::optional<double>& bound : {limit.min, limit.max}) {
    if (bound && !std::isfinite(*bound)) fail(fmt::format("min and max must be finite, got {}", *bound));
  }
  if (limit.min && limit.max && *limit.min > *limit.max) {
    fail(fmt::format("min must not be above max, got {} and {}", *limit.min, *limit.max));
  }
  if (!std::isfinite(limit.from) || !std::isfinite(limit.to)) {
    fail(fmt::format("from and to must be finite, got {} and {}", limit.from, limit.to));
  }
  if (!std::isfinite(limit.weight) || limit.weight < 0) {
    fail(fmt::format("weight must be finite and >= 0, got {}", limit.weight));
  }
  if (limit.weight > 0 && limit.from == limit.to) {
    fail(fmt::format("from and to must differ where weight > 0, got {} twice", limit.to));
  }
}

Limit length_term(std::string_view preset, double genes_min, double genes_max) {
  Limit limit;
  if (preset == "length-2016") {
    limit.from = 40, limit.to = 100, limit.weight = 0.2;
  } else if (preset == "length-2017") {
    limit.from = genes_min, limit.to = genes_max, limit.weight = 0.1;
  } else {
    throw Error(fmt::format("preset must be one of \"length-2016\", \"length-2017\", got \"{}\"", preset));
  }
  return limit;
}

std::string with_unit(Measure measure, double value) { return number_with_unit(measure, value, value); }

std::string describe(Measure measure, const Limit& limit, double value) {
  std::string text = named(measure, value, limit.from);
  const double cost = limit.cost(value);
  if (!(cost > 0)) return text;
  const bool rises = limit.from < limit.to;
  return text + fmt::format(": {} {} {}, costs {}", with_unit(measure, std::abs(value - limit.from)),
                            rises ? "over" : "under", with_unit(measure, limit.from),
                            cost < 1000 ? fmt::format("{:.3g}", cost) : fmt::format("{:.0f}", cost));
}

std::string describe_rejection(Measure measure, const Limit& limit, double value) {
  if (limit.accepts(value)) return "";
  const bool low = limit.min && value < *limit.min;
  const double bound = low ? *limit.min : *limit.max;
  const bool counted = facts_of(measure).name == facts_of(measure).unit;
  return fmt::format("{} {} {} {} {}", named(measure, value, bound), counted && value != 1 ? "are" : "is",
                     low ? "below" : "above", low ? "min" : "max", number_with_unit(measure, bound, value));
}

std::string describe_bounds(Measure measure, const Limit& limit) {
  const MeasureFacts& facts = facts_of(measure);
  if (limit.min && limit.max) {
    return fmt::format("{} to {}", number(facts, *limit.min, *limit.max), with_unit(measure, *limit.max));
  }
  if (limit.min) return "at least " + with_unit(measure, *limit.min);
  return limit.max ? "at most " + with_unit(measure, *limit.max) : "";
}

}  // namespace espalier
