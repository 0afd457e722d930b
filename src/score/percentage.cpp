#include "score/percentage.h"

#include <fmt/format.h>

namespace espalier {

std::string percentage(double part, double of) {
  if (!(part > 0) || !(of > 0)) return "0 %";
  const double p = 100 * part / of;
  return p < 0.5 ? "<1 %" : fmt::format("{:.0f} %", p);
}

}  // namespace espalier
