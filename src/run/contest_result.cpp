#include "run/contest_result.h"

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "run/probes.h"

namespace espalier {

using nlohmann::ordered_json;

void begin_result(const Contest& contest, ContestSetups& setups, const std::string& folder, int threads,
                  ContestResult& result) {
  Setup& first = setups.first();
  result.grammar = first.graph().name, result.optimum = first.objective.optimum();
  result.machine = this_machine(), result.threads = threads;
  result.folder = folder;
  result.warnings = first.warnings;
  for (const std::string& line : warn_of_reach(first, find_reach(first))) result.warnings.push_back(line);
  for (const std::string& line : warn_of_other_scores(contest)) result.warnings.push_back(line);
}

ordered_json head_json(const char* kind, const Contest& contest, const ContestResult& result) {
  ordered_json budget = ordered_json::object();
  if (contest.budget.seconds) budget["seconds"] = *contest.budget.seconds;
  if (contest.budget.evaluations) budget["evaluations"] = *contest.budget.evaluations;
  if (contest.budget.generations) budget["generations"] = *contest.budget.generations;
  return {{kind, 1},
          {"version", kVersion},
          {"grammar", result.grammar},
          {"scene", contest.scene_path},
          {"optimum", result.optimum},
          {"budget", budget},
          {"threads", result.threads},
          {"machine", json_of(result.machine)},
          {"clock", contest.clock == StopwatchClock::wall ? "wall" : "computing"},
          {"seeds", contest.seeds}};
}

}  // namespace espalier
