#pragma once
// LiveSearch: a thread of a project's own that keeps a model shown. It sets up whatever state the project has come to,
// searches while it is asked to, and publishes the best so far. Whoever asks never waits for it.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "studio/live_work.h"

namespace espalier::studio {

class LiveSearch {
 public:
  /// The listener must outlive it. `shown`: the model to begin with as JSON, or "".
  LiveSearch(ReadBlob read_blob, LiveListener& listener, std::string shown);
  ~LiveSearch();

  /// The project has come to this state. `model`: to be shown instead, as JSON. `seconds`: of the search that begins,
  /// whatever the scene says.
  void take(const StoredState& state, std::int64_t revision, LiveStart start, std::optional<std::string> model = {},
            std::optional<double> seconds = {});
  /// Searches for so many seconds (more). Searches that `take` begins have the seconds of the scene's budget, else those of
  /// the last start.
  void start(LiveStart start, double seconds);
  void stop();

 private:
  void wish(bool leaves_search);
  void run(std::string shown);

  ReadBlob read_blob_;
  LiveListener& listener_;
  std::mutex mutex_;
  std::condition_variable changed_;
  LiveWishes wishes_;
  /// When the step that runs is given up, as a time of the steady clock; 0: not at all.
  std::atomic<std::int64_t> give_up_at_{0};
  std::thread thread_;
};

}  // namespace espalier::studio
