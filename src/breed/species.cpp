#include "breed/species.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/check.h"
#include "breed/newcomer.h"
#include "breed/streams.h"
#include "breed/variation.h"
#include "search/require.h"

namespace espalier {
namespace {

constexpr std::uint32_t kBatch = 64;

/// A reason without its figures: "23 % of it grows below the ground" is the same reason as 41 %.
std::string kind_of(const std::string& reason) {
  const std::string_view share = " % of it ";
  const std::size_t at = reason.find(share);
  if (at != std::string::npos) return reason.substr(at + share.size());
  // "height 7.1 m is above max 6 m", "9000 triangles are above max 5000 triangles": the words of it.
  std::string words;
  for (std::size_t i = 0; i < reason.size();) {
    const std::size_t end = std::min(reason.find(' ', i), reason.size());
    const std::string word = reason.substr(i, end - i);
    const bool figure = word.find_first_of("0123456789") != std::string::npos;
    if (figure && (words.ends_with("max") || words.ends_with("min"))) break;
    if (!figure) words += (words.empty() ? "" : " ") + word;
    i = end + 1;
  }
  return words;
}

double nearest_of(const std::vector<Appraisal>& others, const Appraisal& one) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Appraisal& other : others) nearest = std::min(nearest, feature_distance(one.features, other.features));
  return nearest;
}

}  // namespace

void validate(const SpeciesSettings& s) {
  require_range("count", s.count, 1u, SpeciesSettings::kMostSiblings);
  require_range("strength", s.strength, 0.0, 1.0);
  require_range("least_distance", s.least_distance, 0.0, 1.0);
}

Species find_species(const BreedProblem& problem, const std::optional<Derivation>& favourite,
                     const SpeciesSettings& settings) {
  CHECK(problem.graph && problem.appraiser);
  validate(settings);
  Species species;
  species.nearest = std::numeric_limits<double>::infinity();
  const std::uint32_t most = settings.count * SpeciesSettings::kTriesPerSibling;
  while (species.siblings.size() < settings.count && species.tried < most) {
    const std::uint32_t first = species.tried, size = std::min(kBatch, most - first);
    std::vector<Derivation> drawn;
    std::vector<const Derivation*> candidates;
    for (std::uint32_t i = 0; i < size; ++i) {
      RandomStream random = stream_of(problem, BreedStream::sibling, 0, first + i);
      drawn.push_back(favourite ? make_sibling(*problem.graph, *favourite, problem.held, settings.strength, random)
                                : draw_newcomer(*problem.graph, random));
    }
    for (const Derivation& derivation : drawn) candidates.push_back(&derivation);
    std::vector<Appraisal> appraisals = problem.appraiser->appraise(candidates);
    for (std::uint32_t i = 0; i < size && species.siblings.size() < settings.count; ++i) {
      ++species.tried;
      if (!appraisals[i].viable) {
        ++species.refused[kind_of(appraisals[i].reasons.front())];
        continue;
      }
      const double apart = nearest_of(species.appraisals, appraisals[i]);
      const bool is_favourite = favourite && drawn[i].genes == favourite->genes && drawn[i].draws == favourite->draws;
      if (apart < settings.least_distance || apart == 0 || is_favourite) {
        ++species.refused["too like another"];
        continue;
      }
      species.nearest = std::min(species.nearest, apart);
      species.siblings.push_back(std::move(drawn[i]));
      species.drawn_as.push_back(first + i);
      species.appraisals.push_back(std::move(appraisals[i]));
    }
  }
  if (species.siblings.size() < 2) species.nearest = 0;
  return species;
}

std::string summary(const Species& species, const SpeciesSettings& settings) {
  std::string text = fmt::format("{} of {} found among {} candidates", species.siblings.size(), settings.count,
                                 species.tried);
  std::vector<std::pair<std::string, std::uint32_t>> reasons(species.refused.begin(), species.refused.end());
  std::stable_sort(reasons.begin(), reasons.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    text += fmt::format("{}{} ({})", i == 0 ? "; refused: " : ", ", reasons[i].first, reasons[i].second);
  }
  return text;
}

}  // namespace espalier
