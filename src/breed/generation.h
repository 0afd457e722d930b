#pragma once
// The next generation: what a person's ratings, the targets and chance make of the present one. A pure function of its
// inputs, so that a history can be replayed to the byte.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "breed/breed_problem.h"
#include "breed/member.h"
#include "breed/settings.h"

namespace espalier {

/// One that may come into a generation. Not yet appraised.
struct Candidate {
  Derivation derivation;
  Origin origin = Origin::sampled;
  std::vector<std::size_t> parents;  // indices into the generation before
};

/// Candidate number `number` of a generation that is bred freely: a child of parents chosen by rating, or a newcomer.
Candidate make_candidate(const BreedProblem& problem, const BreedSettings& settings, const std::vector<Member>& parents,
                         std::uint32_t generation, std::uint32_t number, bool newcomer);

inline constexpr std::uint32_t kSurplus = 2, kMostTries = 12;  // per place: viable candidates, and all made

struct NextGeneration {
  std::vector<Member> members;  // settings.population of them, with ids first_id, first_id + 1, ...; kept ones first
  std::uint32_t tried = 0;      // children made and appraised
  std::uint32_t refused = 0;    // of these: not viable
  std::string note;             // what was short, in words; empty where nothing was
};

/// A member without an id, of a candidate and the generation before.
Member member_of(Candidate candidate, const std::vector<Member>& parents);

/// Adds copies of the favourites: the settings' `keep` best that were rated above neutral, best first, no two alike.
void keep_favourites(const BreedSettings& settings, const std::vector<Member>& parents, NextGeneration& next);

/// `parents`: the present generation, at least one, any number. `number`: of the generation made, from 1.
///
/// classic: Genesis on ratings (search/genesis_strings.h); all equal: everybody is as likely to have children. What
/// is not viable is replaced by its first parent; a child that is one of the parents to the bit is a copy of that one.
/// `worst_before`: the least ratings of the generations before `parents`, the nearest first, for the scaling window; as
/// many count as the window reaches back. free: the `keep` best that were rated are copied with their rating,
/// some newcomers are drawn, the rest are children of parents chosen by rating. Where there are targets, children are
/// bred in surplus and the better scores are taken; what is not viable is dropped; children equal to a parent or to
/// each other are bred again. Where viable children are not to be had in kMostTries per place, a copy of a parent
/// stands in. Copies keep their rating, so nobody is asked about them again. Throws Error for bad settings or no
/// parents, and for classic where why_not_start_draws (search/genesis_encoding.h) says something.
NextGeneration next_generation(const BreedProblem& problem, const BreedSettings& settings,
                               const std::vector<Member>& parents, std::uint32_t number, MemberId first_id,
                               std::span<const double> worst_before = {});

}  // namespace espalier
