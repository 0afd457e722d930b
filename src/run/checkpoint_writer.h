#pragma once
// CheckpointWriter: keeps checkpoints of a search in the staging folder of its run, each whole or not there at all: the
// one before stays until the next has its name. With the first come run.toml and inputs/, so that nothing is missing.

#include <string>

#include "run/checkpoint.h"
#include "run/run_folder.h"
#include "run/search_loop.h"

namespace espalier {

class CheckpointWriter final : public SearchKeeper {
 public:
  /// All must outlive it. `settings` is the text of run.toml; `seconds` > 0 of the search between checkpoints, or more
  /// where writing them would take above a tenth of the time; `begin_s`: on the search's clock already.
  CheckpointWriter(RunFolder& folder, RunObserver& observer, std::string settings, double seconds, double begin_s = 0);

  void stepped(const SearchSession& session) override;
  void ending(const SearchSession& session) override { write(session); }

 private:
  void write(const SearchSession& session);

  RunFolder& folder_;
  RunObserver& observer_;
  std::string settings_;
  double seconds_, due_s_;
  bool begun_ = false, failed_ = false;
};

}  // namespace espalier
