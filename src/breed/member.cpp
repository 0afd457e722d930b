#include "breed/member.h"

#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "base/printable.h"

namespace espalier {
namespace {

constexpr std::array<std::string_view, kOrigins> kNames = {"sampled", "kept",    "crossed", "mutated",
                                                           "edited",  "blended", "sibling"};

}  // namespace

std::string_view name_of(Origin origin) { return kNames[static_cast<std::size_t>(origin)]; }

Origin origin_named(std::string_view name) {
  for (std::size_t i = 0; i < kOrigins; ++i) {
    if (kNames[i] == name) return static_cast<Origin>(i);
  }
  throw Error(fmt::format("origin must be one of {}, got \"{}\"", fmt::join(kNames, ", "), printable(name)));
}

Member kept_copy(const Member& parent, MemberId id) {
  return {id, parent.derivation, Origin::kept, {parent.id}, parent.rating, parent.rated};
}

}  // namespace espalier
