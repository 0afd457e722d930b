#pragma once
// LiveReport: best.png and report.html of a search that goes on, refreshed in its folder by a thread of their own. The
// search only hands over copies; it never waits. Refreshes become rarer where they would take more than a
// tenth of the search's computing, however busy the machine is.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "run/search_loop.h"
#include "run/setup.h"

namespace espalier {

class LiveReport final : public SearchWatcher {
 public:
  /// Files are written into `folder`, which will be called `final_folder` in the end: both paths, side by side.
  /// `setup` must outlive it; `settings` is the text of run.toml; `refresh_seconds` > 0.
  LiveReport(const Setup& setup, std::string settings, std::string folder, const std::string& final_folder,
             double refresh_seconds);
  /// Waits for the refresh that is under way.
  ~LiveReport() override;

  /// Goes on with the log of a search that was continued; before the first step.
  void continue_with(const SearchLog& log) { log_ = log; }

  void stepped(const StepReport& report, const Individual& best) override;
  /// Ends refreshing; afterwards nothing is written any more. Returns what went wrong, empty: nothing.
  std::string end();

 private:
  class Painter;
  struct Snapshot {
    Individual best;
    SearchLog log;
  };

  void work();
  bool affordable() const;  // with the mutex held

  const double refresh_seconds_;
  const double before_s_;  // computing time of the process before the search
  std::unique_ptr<Painter> painter_;
  SearchLog log_;  // the search's own

  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Snapshot> snapshot_;  // to be shown next
  bool ended_ = false;
  bool idle_ = true;
  double due_s_;                       // of the search's clock
  double painted_s_ = 0, last_s_ = 0;  // computing time of all refreshes, of the last
  std::string problem_;
  std::thread thread_;
};

}  // namespace espalier
