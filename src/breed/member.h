#pragma once
// Member: one individual of a breeding session: what it looks like (its derivation), where it comes from, and what a
// person thinks of it.

#include <cstdint>
#include <string_view>
#include <vector>

#include "derivation/derivation.h"

namespace espalier {

/// Unique within a session and never used again; 0 names nobody.
using MemberId = std::uint64_t;

enum class Origin : std::uint8_t {
  sampled,  // drawn from the grammar: the first screen, newcomers
  kept,     // a copy of its parent, with its rating
  crossed,
  mutated,
  edited,   // by hand
  blended,
  sibling,  // "more like this"
};
inline constexpr std::size_t kOrigins = 7;

/// "sampled", "kept", ...
std::string_view name_of(Origin origin);
/// The inverse; throws Error for another name.
Origin origin_named(std::string_view name);

struct Member {
  static constexpr std::size_t kMostParents = 3;

  MemberId id = 0;
  Derivation derivation;
  Origin origin = Origin::sampled;
  std::vector<MemberId> parents;  // at most kMostParents; what is held by draw locks comes from the first
  /// Finite; above 0 is liked, below 0 disliked, 0 neutral (GenTree's ratings go up and down from 0; of five stars the
  /// third is 0). Who was not rated is neutral and has 0.
  double rating = 0;
  bool rated = false;

  bool operator==(const Member&) const = default;
};

/// A copy of `parent` for the next generation: who it is stays, and what was thought of it.
Member kept_copy(const Member& parent, MemberId id);

}  // namespace espalier
