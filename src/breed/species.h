#pragma once
// Species: many distinct siblings of one favourite, or many kinds that a grammar grows, all viable and within limits.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "breed/breed_problem.h"

namespace espalier {

struct SpeciesSettings {
  static constexpr std::uint32_t kMostSiblings = 1000, kTriesPerSibling = 60;

  std::uint32_t count = 20;         // 1..kMostSiblings
  double strength = 0.3;            // how far siblings may stray, 0..1 (variation.h); nothing without a favourite
  double least_distance = 0.01;     // of the features of any two (feature_distance), 0..1

  bool operator==(const SpeciesSettings&) const = default;
};

/// Throws Error stating rule and value.
void validate(const SpeciesSettings& settings);

struct Species {
  std::vector<Derivation> siblings;            // in the order in which they were found; at most `count`
  std::vector<std::uint32_t> drawn_as;         // which of the candidates each was
  std::vector<Appraisal> appraisals;           // of each
  std::uint32_t tried = 0;                     // candidates; at most count * kTriesPerSibling
  std::map<std::string, std::uint32_t> refused;  // candidates by the first reason why not: "too like another"
  double nearest = 0;                          // least distance of any two siblings; 0 where there are fewer than two
};

/// Candidate k is a function of problem.seed, problem.draw and k alone. The favourite itself is not among the siblings.
/// Throws Error for bad settings.
Species find_species(const BreedProblem& problem, const std::optional<Derivation>& favourite,
                     const SpeciesSettings& settings);

/// Why there are fewer than wanted, or what it took: "200 of 200 found among 412 candidates; 160 refused: triangles
/// (150), ...".
std::string summary(const Species& species, const SpeciesSettings& settings);

}  // namespace espalier
