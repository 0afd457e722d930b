#pragma once
// The first screen: members drawn from the grammar that are viable and as unlike each other as can be had.

#include <cstdint>
#include <string>
#include <vector>

#include "breed/breed_problem.h"
#include "breed/member.h"
#include "breed/settings.h"

namespace espalier {

struct FirstGeneration {
  std::vector<Member> members;  // with ids first_id, first_id + 1, ...; fewer than asked for where a note says why
  std::uint32_t tried = 0;      // derivations drawn
  std::uint32_t viable = 0;     // of these
  std::string note;             // what was short, in words; empty where nothing was
};

/// Draws kPoolPerMember per member (spread out by the farthest-point rule on their features: each next one is the one
/// whose nearest chosen neighbour is farthest; the first is the one nearest to the pool's mean), more in rounds until
/// settings.population viable ones are found or kMostDrawsPerMember were tried. Where there are `founders` (presets,
/// a model a person likes), they come first, as they are. Pure.
FirstGeneration first_generation(const BreedProblem& problem, const BreedSettings& settings,
                                 const std::vector<Derivation>& founders, MemberId first_id);

inline constexpr std::uint32_t kPoolPerMember = 4, kMostDrawsPerMember = 40;

/// `count` indices of the points, each next one farthest from those before (its own nearest neighbour among them);
/// features are scaled by their spread in the pool. All of them where there are fewer.
std::vector<std::size_t> farthest_points(const std::vector<std::vector<double>>& points, std::size_t count);

}  // namespace espalier
