#include "breed/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_set>

#include <fmt/format.h>

#include "base/check.h"
#include "search/require.h"

namespace espalier {
namespace {

double mean_distance(const std::vector<std::vector<double>>& features) {
  double sum = 0, pairs = 0;
  for (std::size_t i = 0; i < features.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) sum += feature_distance(features[i], features[j]), ++pairs;
  }
  return pairs > 0 ? sum / pairs : 0;
}

/// A viable candidate of the hidden pool.
struct Hidden {
  Candidate candidate;
  std::vector<double> features;
  Forecast forecast;
  double hope = 0;
  bool shown = false;
};

class Pool {
 public:
  Pool(const BreedProblem& problem, const BreedSettings& settings, const ScreenSettings& screen,
       const std::vector<Member>& parents, const Taste& taste, std::uint32_t number)
      : problem_(problem), settings_(settings), screen_(screen), parents_(parents), taste_(taste), number_(number) {
    for (const Member& parent : parents) known_.insert(hash(parent.derivation));
  }

  void breed(NextGeneration& next) {
    for (std::uint32_t round = 0; round < screen_.rounds; ++round) {
      const std::uint32_t size = screen_.pool / screen_.rounds;
      // Later rounds breed from what promises most, as if it had been rated so.
      const std::vector<Promising> from = round == 0 ? of_parents() : promising();
      const auto newcomers = static_cast<std::uint32_t>(settings_.newcomers * size + 0.5);
      add(from, size - newcomers, false, next);
      add(from, newcomers, true, next);
    }
  }

  std::vector<Hidden>& hidden() { return hidden_; }

 private:
  /// One to breed from: a parent, or a hidden child with its own parents.
  struct Promising {
    Member member;
    std::vector<std::size_t> parents;
  };

  std::vector<Promising> of_parents() const {
    std::vector<Promising> all;
    for (std::size_t i = 0; i < parents_.size(); ++i) all.push_back({parents_[i], {i}});
    return all;
  }

  std::vector<Promising> promising() const {
    std::vector<std::size_t> order(hidden_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return hidden_[a].hope > hidden_[b].hope; });
    order.resize(std::min<std::size_t>(order.size(), settings_.population));
    std::vector<Promising> best;
    if (order.empty()) return of_parents();
    const double zero = hidden_[order.back()].hope;
    for (const std::size_t i : order) {
      Promising one;
      one.member.derivation = hidden_[i].candidate.derivation;
      one.member.rating = hidden_[i].hope - zero;
      one.member.rated = true;
      one.parents = hidden_[i].candidate.parents;
      best.push_back(std::move(one));
    }
    return best;
  }

  void add(const std::vector<Promising>& from, std::uint32_t count, bool newcomers, NextGeneration& next) {
    std::vector<Member> members;
    for (const Promising& one : from) members.push_back(one.member);
    std::vector<Candidate> candidates;
    std::vector<const Derivation*> derivations;
    for (std::uint32_t i = 0; i < count; ++i) {
      Candidate candidate = make_candidate(problem_, settings_, members, number_, made_++, newcomers);
      if (!known_.insert(hash(candidate.derivation)).second) continue;
      // Hidden ones between are not told of: its parents are those that a person has seen.
      std::vector<std::size_t> seen;
      for (const std::size_t parent : candidate.parents) {
        for (const std::size_t ancestor : from[parent].parents) {
          const bool known = std::find(seen.begin(), seen.end(), ancestor) != seen.end();
          if (!known && seen.size() < Member::kMostParents) seen.push_back(ancestor);
        }
      }
      candidate.parents = seen;
      candidates.push_back(std::move(candidate));
    }
    for (const Candidate& candidate : candidates) derivations.push_back(&candidate.derivation);
    std::vector<Appraisal> appraisals = problem_.appraiser->appraise(derivations);
    next.tried += static_cast<std::uint32_t>(candidates.size());
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      next.refused += !appraisals[i].viable;
      if (!appraisals[i].viable) continue;
      Hidden one;
      one.candidate = std::move(candidates[i]);
      one.forecast = taste_.forecast(appraisals[i].features);
      one.features = std::move(appraisals[i].features);
      one.hope = one.forecast.rating + screen_.daring * one.forecast.deviation + appraisals[i].score;
      hidden_.push_back(std::move(one));
    }
  }

  const BreedProblem& problem_;
  const BreedSettings& settings_;
  const ScreenSettings& screen_;
  const std::vector<Member>& parents_;
  const Taste& taste_;
  std::uint32_t number_, made_ = 0;
  std::vector<Hidden> hidden_;
  std::unordered_set<std::uint64_t> known_;
};

/// Distance to the nearest of those shown.
double apart(const Hidden& one, const std::vector<std::vector<double>>& shown) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<double>& other : shown) nearest = std::min(nearest, feature_distance(one.features, other));
  return nearest;
}

/// The hidden one, not yet shown, of the greatest value; none (size) where there is none above -infinity.
template <typename Value>
std::size_t greatest(const std::vector<Hidden>& hidden, Value value) {
  std::size_t best = hidden.size();
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hidden.size(); ++i) {
    if (hidden[i].shown) continue;
    const double v = value(hidden[i]);
    if (v > most) most = v, best = i;
  }
  return best;
}

}  // namespace

void validate(const ScreenSettings& s) {
  require_range("pool", s.pool, 100u, 2000u);
  require_range("rounds", s.rounds, 1u, 10u);
  require_range("daring", s.daring, 0.0, 5.0);
  require_range("spacing", s.spacing, 0.0, 1.0);
}

std::string_view name_of(ShownAs shown) {
  constexpr std::string_view kNames[] = {"kept", "best", "different", "uncertain"};
  return kNames[static_cast<std::size_t>(shown)];
}

Screen next_screen(const BreedProblem& problem, const BreedSettings& settings, const ScreenSettings& screen,
                   const std::vector<Member>& parents, const Taste& taste, std::uint32_t number, MemberId first_id) {
  CHECK(problem.graph && problem.appraiser);
  validate(settings);
  validate(screen);
  if (parents.empty()) throw Error("a generation needs parents, got none");
  Screen result;
  BreedSettings straight = settings;
  straight.lean = 0;  // the model knows the way better
  NextGeneration& next = result.generation;
  std::vector<std::vector<double>> shown;
  const auto say = [&](const std::vector<double>& features, ShownAs as) {
    result.shown_as.push_back(as);
    result.forecasts.push_back(taste.forecast(features));
    result.reasons.push_back(taste.reasons(features, problem.appraiser->feature_names()));
    shown.push_back(features);
  };
  keep_favourites(settings, parents, next);
  std::vector<const Derivation*> kept;
  for (const Member& member : next.members) kept.push_back(&member.derivation);
  for (const Appraisal& appraisal : problem.appraiser->appraise(kept)) say(appraisal.features, ShownAs::kept);

  Pool pool(problem, straight, screen, parents, taste, number);
  pool.breed(next);
  std::vector<Hidden>& hidden = pool.hidden();
  std::vector<std::vector<double>> features;
  for (const Hidden& one : hidden) features.push_back(one.features);
  const double least = screen.spacing * mean_distance(features);
  const auto show = [&](std::size_t i, ShownAs as) {
    hidden[i].shown = true;
    say(hidden[i].features, as);
    next.members.push_back(member_of(std::move(hidden[i].candidate), parents));
  };
  const std::size_t odd = settings.population - next.members.size() >= 3 ? 2 : 0;
  while (next.members.size() + odd < settings.population) {
    std::size_t best = greatest(hidden, [&](const Hidden& one) {
      return apart(one, shown) >= least ? one.hope : -std::numeric_limits<double>::infinity();
    });
    if (best == hidden.size()) best = greatest(hidden, [](const Hidden& one) { return one.hope; });
    if (best == hidden.size()) break;
    show(best, ShownAs::best);
  }
  if (odd > 0) {
    // Different, but of the better half: what is merely odd tells nobody anything.
    std::vector<double> hopes;
    for (const Hidden& one : hidden) hopes.push_back(one.hope);
    std::sort(hopes.begin(), hopes.end());
    const double middle = hopes.empty() ? 0 : hopes[hopes.size() / 2];
    const std::size_t different = greatest(hidden, [&](const Hidden& one) {
      return one.hope >= middle ? apart(one, shown) : -std::numeric_limits<double>::infinity();
    });
    if (different < hidden.size()) show(different, ShownAs::different);
    const std::size_t unsure = greatest(hidden, [](const Hidden& one) { return one.forecast.deviation; });
    if (unsure < hidden.size()) show(unsure, ShownAs::uncertain);
  }
  const std::size_t missing = settings.population - next.members.size();
  for (std::size_t i = 0; i < missing; ++i) {
    const Member& parent = parents[i % parents.size()];
    const Derivation* one[] = {&parent.derivation};
    say(problem.appraiser->appraise(one)[0].features, ShownAs::kept);
    next.members.push_back(kept_copy(parent, 0));
  }
  if (missing > 0) {
    next.note = fmt::format("{} places have copies of parents: of {} hidden candidates {} were not viable", missing,
                            next.tried, next.refused);
  }
  for (std::size_t i = 0; i < next.members.size(); ++i) next.members[i].id = first_id + i;
  return result;
}

double diversity(const std::vector<std::vector<double>>& features, const std::vector<std::vector<double>>& reference) {
  if (features.size() < 2) return 1;
  CHECK(reference.size() >= 2);
  const double usual = mean_distance(reference);
  return usual > 0 ? std::clamp(mean_distance(features) / usual, 0.0, 1.0) : 1;
}

}  // namespace espalier
