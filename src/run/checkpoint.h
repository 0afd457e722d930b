#pragma once
// Checkpoint: a search that can go on later, in a file: its state, and what it belongs to (docs/formats.md).

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "run/search_session.h"

namespace espalier {

/// The name of the file in a run's folder.
inline constexpr const char* kCheckpointName = "checkpoint";

struct Checkpoint {
  std::string version;                        // of the program
  std::string grammar, engine;                // names
  std::uint64_t seed = 0, step = 0, evaluations = 0;
  double seconds = 0, best = 0;
  std::map<std::string, std::string> inputs;  // by name in the run's folder, their content_hash
  std::string settings;                       // the text of run.toml
  // How the run went on, which no result depends on:
  std::string out;                            // the folder that it is for
  int threads = 0;
  double refresh_seconds = 0, checkpoint_seconds = 0;
  std::string population;                     // the best models as JSON, one a line: where the state is of no use
  std::string state;                          // of the session

  bool operator==(const Checkpoint&) const = default;
};

/// Of a session after its first step.
Checkpoint make_checkpoint(const SearchSession& session, std::string settings, std::string out);

std::string encode_checkpoint(const Checkpoint& checkpoint);
/// Throws Error for anything that is not whole, or of another version of the format. Not for a state that does not suit
/// the search: SearchSession::load finds that.
Checkpoint parse_checkpoint(std::string_view bytes);
/// Throws Error naming the file.
Checkpoint read_checkpoint(const std::string& path);
/// Whether bytes begin as checkpoints do.
bool is_checkpoint(std::string_view bytes);

}  // namespace espalier
