#include "search/ga_gains.h"

#include "base/check.h"

namespace espalier {

void GaGains::begin_generation() {
  if (last_.size() == kWindow) last_.erase(last_.begin());
  last_.emplace_back();
}

void GaGains::add(VariationKind kind, bool better) {
  CHECK(!last_.empty());
  Gain& gain = last_.back()[static_cast<std::size_t>(kind)];
  ++gain.made;
  gain.better += better;
}

GaGains::Gain GaGains::sum(VariationKind kind) const {
  Gain sum;
  for (const Generation& one : last_) {
    sum.made += one[static_cast<std::size_t>(kind)].made;
    sum.better += one[static_cast<std::size_t>(kind)].better;
  }
  return sum;
}

void GaGains::save(StateWriter& writer) const {
  writer.u64(last_.size());
  for (const Generation& generation : last_) {
    for (const Gain& gain : generation) {
      writer.u64(gain.made);
      writer.u64(gain.better);
    }
  }
}

GaGains GaGains::load(StateReader& reader) {
  GaGains gains;
  gains.last_.resize(reader.u64_at_most(kWindow, "generations"));
  for (Generation& generation : gains.last_) {
    for (Gain& gain : generation) {
      gain.made = reader.u64();
      gain.better = reader.u64_at_most(gain.made, "better children");
    }
  }
  return gains;
}

}  // namespace espalier
