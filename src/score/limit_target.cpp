#include "score/limit_target.h"

#include <cmath>

#include <fmt/format.h>

#include "base/error.h"
#include "score/smootherstep.h"

namespace espalier {

void validate(const Limit& limit) {
  if (limit.min > limit.max) {
    throw Error(fmt::format("limits: min genes must not be above max, got {} and {}", limit.min, limit.max));
  }
  if (!std::isfinite(limit.from) || !std::isfinite(limit.to) || limit.from > limit.to) {
    throw Error(fmt::format("limits: the ramp must go up, got from = {}, to = {}", limit.from, limit.to));
  }
  if (!std::isfinite(limit.weight) || limit.weight < 0) {
    throw Error(fmt::format("limits: weight must be >= 0, got {}", limit.weight));
  }
}

LimitTarget::LimitTarget(const Limit& limit) : limit_(limit) { validate(limit); }

double LimitTarget::penalty(std::size_t genes) const {
  return limit_.weight * smootherstep(static_cast<double>(genes), limit_.from, limit_.to);
}

double LimitTarget::score(const Derivation& derivation, const Model&, TargetScratch*) const {
  return -penalty(derivation.size());
}

Explanation LimitTarget::explain(const Derivation& derivation, const Model&, TargetScratch*) const {
  Explanation e;
  e.name = name_;
  e.score = -penalty(derivation.size());
  e.words = fmt::format("{} {}", derivation.size(), derivation.size() == 1 ? "gene" : "genes");
  e.terms = {{"genes", -limit_.weight, static_cast<double>(derivation.size()), limit_.to, e.score, "genes"}};
  return e;
}

}  // namespace espalier
