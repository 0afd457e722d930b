#include "breed/generation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "breed/newcomer.h"
#include "breed/streams.h"
#include "breed/variation.h"
#include "search/genesis_strings.h"

namespace espalier {
namespace {

// Chosen with bench/breeding_study on favourites other than those that docs/experiments.md reports (--first 1000, 100
// of them, median ratings of the steady user): without leaning 57, with one pair 52, with three 43. Mutating every
// crossed child: 43; three in ten: 39.
constexpr int kLeanPairs = 3;
constexpr double kLean = 0.5;  // of the way from the worse to the better, on average, all pairs together
constexpr double kMutateCrossed = 0.4;

std::vector<double> ratings_of(const BreedSettings& settings, const std::vector<Member>& members) {
  std::vector<double> ratings;
  for (const Member& member : members) ratings.push_back(settings.use_ratings && member.rated ? member.rating : 0);
  return ratings;
}

std::vector<Appraisal> appraise(const BreedProblem& problem, const std::vector<Candidate>& candidates) {
  std::vector<const Derivation*> derivations;
  for (const Candidate& candidate : candidates) derivations.push_back(&candidate.derivation);
  return problem.appraiser->appraise(derivations);
}

void take_ids(std::vector<Member>& members, MemberId first_id) {
  for (std::size_t i = 0; i < members.size(); ++i) members[i].id = first_id + i;
}

/// Per bit, whether its gene is held: the same for all derivations, as they are one gene each.
std::vector<std::uint8_t> held_bits(const BreedProblem& problem, const GenesisEncoding& encoding,
                                    const Derivation& derivation) {
  const std::vector<std::uint8_t> is_held = held_draws(*problem.graph, derivation, problem.held);
  std::vector<std::uint8_t> bits;
  for (std::size_t gene = 0; gene < encoding.genes(); ++gene) {
    bits.insert(bits.end(), encoding.bits_of(gene), is_held[gene]);
  }
  return bits;
}

/// Of the parents and of what came before them, as far as the scaling window reaches.
double worst_of_window(const BreedSettings& settings, const std::vector<double>& ratings,
                       std::span<const double> worst_before) {
  double worst = *std::min_element(ratings.begin(), ratings.end());
  const std::size_t reach = std::min<std::size_t>(worst_before.size(), settings.genesis.window);
  for (const double before : worst_before.first(reach)) worst = std::min(worst, settings.use_ratings ? before : 0.0);
  return worst;
}

NextGeneration classic_generation(const BreedProblem& problem, const BreedSettings& settings,
                                  const std::vector<Member>& parents, std::uint32_t number,
                                  std::span<const double> worst_before) {
  const GenesisEncoding encoding(*problem.graph, settings.genesis.bits, settings.genesis.gray);
  std::vector<BitString> strings;
  for (const Member& parent : parents) strings.push_back(encoding.encode(parent.derivation));
  const std::vector<double> ratings = ratings_of(settings, parents);
  RandomStream random = stream_of(problem, BreedStream::select, number, 0);
  const std::vector<GenesisChild> children =
      next_strings(strings, ratings, settings.population, worst_of_window(settings, ratings, worst_before),
                   settings.genesis, held_bits(problem, encoding, parents[0].derivation), random);

  std::unordered_map<std::uint64_t, std::size_t> known;  // parents
  for (std::size_t i = 0; i < parents.size(); ++i) known.emplace(hash(parents[i].derivation), i);
  std::vector<Candidate> candidates;
  std::vector<std::optional<std::size_t>> copied;  // per child, the parent that it is
  for (const GenesisChild& child : children) {
    copied.emplace_back();
    if (!child.changed) {
      copied.back() = child.parent;
      continue;
    }
    Candidate candidate;
    candidate.derivation = encoding.inherit(child.string, parents[child.parent].derivation,
                                            parents[child.partner].derivation);
    // Two parents that differ between the two points alone are swapped whole.
    const auto twin = known.find(hash(candidate.derivation));
    if (twin != known.end() && parents[twin->second].derivation == candidate.derivation) {
      copied.back() = twin->second;
      continue;
    }
    candidate.origin = child.partner == child.parent ? Origin::mutated : Origin::crossed;
    candidate.parents = {child.parent};
    if (child.partner != child.parent) candidate.parents.push_back(child.partner);
    candidates.push_back(std::move(candidate));
  }
  const std::vector<Appraisal> appraisals = appraise(problem, candidates);

  NextGeneration next;
  next.tried = static_cast<std::uint32_t>(candidates.size());
  for (std::size_t i = 0, at = 0; i < children.size(); ++i) {
    if (copied[i]) {
      next.members.push_back(kept_copy(parents[*copied[i]], 0));
      continue;
    }
    const bool viable = appraisals[at].viable;
    next.members.push_back(viable ? member_of(std::move(candidates[at]), parents)
                                  : kept_copy(parents[children[i].parent], 0));
    next.refused += !viable;
    ++at;
  }
  if (next.refused > 0) next.note = fmt::format("{} children were not viable: parents stand in", next.refused);
  return next;
}

/// Who has children, and how likely: as the root of what they are liked; where nobody is, all that are not disliked
/// alike; where all are disliked, all alike.
std::vector<double> chances_of(const std::vector<double>& ratings) {
  std::vector<double> chances;
  const double best = *std::max_element(ratings.begin(), ratings.end());
  for (const double rating : ratings) {
    chances.push_back(best > 0 ? std::sqrt(std::max(rating, 0.0)) : rating >= 0 || best < 0);
  }
  return chances;
}

std::size_t pick(const std::vector<double>& chances, RandomStream& random) {
  double point = random.next_unit() * std::accumulate(chances.begin(), chances.end(), 0.0);
  std::size_t last = 0;
  for (std::size_t i = 0; i < chances.size(); ++i) {
    if (chances[i] <= 0) continue;
    last = i;
    if (point < chances[i]) return i;
    point -= chances[i];
  }
  return last;  // rounding
}

/// A mixture of several parents at a random point between them.
Derivation mixture(const GeneratorGraph& graph, const std::vector<Member>& parents, const std::vector<std::size_t>& who,
                   const Held& held, RandomStream& random) {
  std::vector<const Derivation*> derivations;
  std::vector<double> weights;
  for (const std::size_t i : who) {
    derivations.push_back(&parents[i].derivation);
    weights.push_back(0.1 + random.next_unit());
  }
  return blend(graph, derivations, weights, held);
}

/// Moves a child the way that ratings point: from those rated below the mean to those that have children.
void lean_by_ratings(const GeneratorGraph& graph, const BreedSettings& settings, const std::vector<Member>& parents,
                     const Held& held, RandomStream& random, Derivation& child) {
  const std::vector<double> ratings = ratings_of(settings, parents);
  double sum = 0, rated = 0;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (parents[i].rated) sum += ratings[i], ++rated;
  }
  std::vector<double> worse;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    worse.push_back(parents[i].rated ? std::max(sum / rated - ratings[i], 0.0) : 0);
  }
  if (*std::max_element(worse.begin(), worse.end()) <= 0) return;
  const std::vector<double> better = chances_of(ratings);
  for (int pair = 0; pair < kLeanPairs; ++pair) {
    const std::size_t away = pick(worse, random), toward = pick(better, random);
    const double amount = 2 * kLean / kLeanPairs * random.next_unit();
    lean(graph, parents[toward].derivation, parents[away].derivation, amount, held, child);
  }
}

/// The best that were rated above neutral, best first, of equals the first.
std::vector<std::size_t> favourites(const BreedSettings& settings, const std::vector<Member>& parents) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    if (settings.use_ratings && parents[i].rated && parents[i].rating > 0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parents[a].rating > parents[b].rating; });
  std::vector<std::size_t> best;
  for (const std::size_t i : order) {
    const bool twin = std::any_of(best.begin(), best.end(),
                                  [&](std::size_t k) { return parents[k].derivation == parents[i].derivation; });
    if (!twin && best.size() < settings.keep) best.push_back(i);
  }
  return best;
}

}  // namespace

Member member_of(Candidate candidate, const std::vector<Member>& parents) {
  Member member;
  member.derivation = std::move(candidate.derivation);
  member.origin = candidate.origin;
  for (const std::size_t parent : candidate.parents) member.parents.push_back(parents[parent].id);
  return member;
}

void keep_favourites(const BreedSettings& settings, const std::vector<Member>& parents, NextGeneration& next) {
  for (const std::size_t favourite : favourites(settings, parents)) {
    next.members.push_back(kept_copy(parents[favourite], 0));
  }
}

Candidate make_candidate(const BreedProblem& problem, const BreedSettings& settings, const std::vector<Member>& parents,
                         std::uint32_t generation, std::uint32_t number, bool newcomer) {
  RandomStream random = stream_of(problem, newcomer ? BreedStream::newcomer : BreedStream::child, generation, number);
  const GeneratorGraph& graph = *problem.graph;
  const std::vector<double> chances = chances_of(ratings_of(settings, parents));
  const std::size_t first = pick(chances, random);
  const Derivation& host = parents[first].derivation;
  Candidate candidate;
  if (newcomer) {
    candidate.derivation = draw_newcomer(graph, host, problem.held, random);
    candidate.origin = Origin::sampled;
    if (!problem.held.empty()) candidate.parents = {first};
    return candidate;
  }
  candidate.parents = {first};
  candidate.origin = Origin::mutated;
  candidate.derivation = host;
  if (random.chance(settings.crossover)) {
    const bool mix = random.chance(settings.blend);
    for (std::size_t i = 1; i < (mix ? Member::kMostParents : 2); ++i) {
      const std::size_t other = pick(chances, random);
      std::vector<std::size_t>& chosen = candidate.parents;
      if (std::find(chosen.begin(), chosen.end(), other) == chosen.end()) chosen.push_back(other);
    }
    if (candidate.parents.size() > 1) {
      candidate.derivation = mix ? mixture(graph, parents, candidate.parents, problem.held, random)
                                 : cross(graph, host, parents[candidate.parents[1]].derivation, problem.held, random);
      candidate.origin = mix ? Origin::blended : Origin::crossed;
    }
  }
  if (random.chance(settings.lean)) {
    lean_by_ratings(graph, settings, parents, problem.held, random, candidate.derivation);
  }
  if (candidate.parents.size() > 1 && !random.chance(kMutateCrossed)) return candidate;
  candidate.derivation = mutate(graph, candidate.derivation, problem.held, settings.strength, random);
  return candidate;
}

namespace {

/// Fills the places of a generation with candidates that are viable and new.
class Filler {
 public:
  Filler(const BreedProblem& problem, const BreedSettings& settings, const std::vector<Member>& parents,
         std::uint32_t number)
      : problem_(problem), settings_(settings), parents_(parents), number_(number) {
    for (const Member& parent : parents) known_.insert(hash(parent.derivation));
  }

  /// Of `surplus` viable candidates per place, the one with the best score. At most kMostTries candidates per place.
  void fill(std::uint32_t places, bool newcomers, std::uint32_t surplus, NextGeneration& next) {
    std::vector<std::pair<double, Candidate>> found;
    const std::size_t wanted = std::size_t{places} * surplus;
    for (std::uint32_t tries = 0; tries < kMostTries && found.size() < wanted; tries += surplus) {
      std::vector<Candidate> candidates;
      for (std::size_t i = found.size(); i < wanted; ++i) {
        candidates.push_back(make_candidate(problem_, settings_, parents_, number_, made_++, newcomers));
      }
      const std::vector<Appraisal> appraisals = appraise(problem_, candidates);
      next.tried += static_cast<std::uint32_t>(candidates.size());
      for (std::size_t i = 0; i < candidates.size(); ++i) {
        next.refused += !appraisals[i].viable;
        if (!appraisals[i].viable || !known_.insert(hash(candidates[i].derivation)).second) continue;
        found.emplace_back(appraisals[i].score, std::move(candidates[i]));
      }
    }
    // Neighbours compete, so that chance keeps a say.
    for (std::uint32_t place = 0; place < places; ++place) {
      std::size_t best = found.size();
      for (std::size_t i = place; i < found.size(); i += places) {
        if (best == found.size() || found[i].first > found[best].first) best = i;
      }
      if (best < found.size()) next.members.push_back(member_of(std::move(found[best].second), parents_));
    }
  }

 private:
  const BreedProblem& problem_;
  const BreedSettings& settings_;
  const std::vector<Member>& parents_;
  std::uint32_t number_, made_ = 0;
  std::unordered_set<std::uint64_t> known_;
};

NextGeneration free_generation(const BreedProblem& problem, const BreedSettings& settings,
                               const std::vector<Member>& parents, std::uint32_t number) {
  NextGeneration next;
  keep_favourites(settings, parents, next);
  const auto left = static_cast<std::uint32_t>(settings.population - next.members.size());
  const auto wanted = static_cast<std::uint32_t>(settings.newcomers * settings.population + 0.5);
  const std::uint32_t newcomers = std::min(wanted, left);
  Filler filler(problem, settings, parents, number);
  filler.fill(left - newcomers, false, problem.appraiser->has_targets() ? kSurplus : 1, next);
  filler.fill(newcomers, true, 1, next);
  const std::size_t missing = settings.population - next.members.size();
  for (std::size_t i = 0; i < missing; ++i) next.members.push_back(kept_copy(parents[i % parents.size()], 0));
  if (missing > 0) {
    next.note = fmt::format("{} places have copies of parents: of {} children {} were not viable", missing, next.tried,
                            next.refused);
  }
  return next;
}

}  // namespace

NextGeneration next_generation(const BreedProblem& problem, const BreedSettings& settings,
                               const std::vector<Member>& parents, std::uint32_t number, MemberId first_id,
                               std::span<const double> worst_before) {
  CHECK(problem.graph && problem.appraiser);
  validate(settings);
  if (parents.empty()) throw Error("a generation needs parents, got none");
  NextGeneration next = settings.method == BreedMethod::classic
                            ? classic_generation(problem, settings, parents, number, worst_before)
                            : free_generation(problem, settings, parents, number);
  take_ids(next.members, first_id);
  return next;
}

}  // namespace espalier
