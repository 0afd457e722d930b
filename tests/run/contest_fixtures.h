#pragma once
// Contests on the pile of tests/run/fixtures.h.

#include <string>
#include <vector>

#include "io/mesh_import.h"
#include "run/compare.h"
#include "run/fixtures.h"
#include "run/sweep.h"

namespace espalier::testing {

inline constexpr const char* kSmallEngines[] = {"engine.sosmc.particles=30", "engine.smc.particles=30",
                                                "engine.hybrid.turn=200", "engine.rjmcmc.chains=4"};

inline ContestWords pile_words(const TemporaryFolder& folder, std::uint64_t evaluations = 700) {
  ContestWords words;
  words.scene = folder / "scene.toml";
  for (const char* setting : kSmallEngines) words.settings.emplace_back(setting);
  words.seeds = "2";
  words.evaluations = evaluations;
  return words;
}

inline CompareRequest pile_comparison(const TemporaryFolder& folder, const std::string& out,
                                      const std::vector<VariantWords>& variants, std::uint64_t evaluations = 700) {
  CompareRequest request;
  request.contest = make_contest(pile_words(folder, evaluations), variants, false);
  request.marks = default_marks(request.contest.budget);
  request.command = "espalier compare scene.toml";
  request.out = folder / out;
  request.threads = 1;
  return request;
}

inline SweepRequest pile_sweep(const TemporaryFolder& folder, const std::string& out,
                               const std::vector<std::string>& varied, const ContestWords& words) {
  SweepRequest request;
  request.varied = parse_varied(varied);
  request.combinations = plan_combinations(request.varied, std::nullopt, 1);
  request.contest = make_contest(words, sweep_variants(request.varied, request.combinations, std::nullopt), true);
  check_sweep(request.varied, request.contest);
  request.out = folder / out;
  request.threads = 1;
  return request;
}

/// The lines of a text that hold `part`.
inline std::string lines_with(const std::string& text, const std::string& part) {
  std::string kept;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (line.find(part) != std::string::npos) kept += line + "\n";
  return kept;
}

}  // namespace espalier::testing
