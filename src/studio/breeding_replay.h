#pragma once
// Replay: all generations of a session of the breeding room made again from what was kept with them, and held against
// what they were.

#include <cstdint>
#include <string>
#include <vector>

#include "base/executor.h"
#include "studio/breeding_store.h"

namespace espalier::studio {

struct ReplayReport {
  std::int64_t generations = 0, individuals = 0;
  std::vector<std::int64_t> different;  // generations that did not come out the same, to the bit
};

/// Throws Error where a generation cannot be made at all, naming it.
ReplayReport replay(Store& store, std::int64_t project, std::int64_t session, Executor& executor);

/// "12 generations came out the same", or which did not.
std::string to_text(const ReplayReport& report);

}  // namespace espalier::studio
