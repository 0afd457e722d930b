#pragma once
// What every contest tells of itself beside its scores.

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "run/contest.h"
#include "run/contest_machine.h"

namespace espalier {

struct ContestResult {
  std::string grammar;
  double optimum = 0;
  int threads = 1;
  ContestMachine machine;
  bool interrupted = false;
  std::size_t failed = 0;  // searches
  std::vector<std::string> warnings;
  std::string folder;
};

/// What is known before the first search, warnings included.
void begin_result(const Contest& contest, ContestSetups& setups, const std::string& folder, int threads,
                  ContestResult& result);
/// The members that begin the JSON of a contest; `kind` names the version of the format.
nlohmann::ordered_json head_json(const char* kind, const Contest& contest, const ContestResult& result);

}  // namespace espalier
