#pragma once
// LiveSearch: a thread of a project's own that keeps a model shown. It sets up whatever state the project has come to,
// searches while it is asked to, and publishes the best so far. Whoever asks never waits for it.

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <studio_types.h>

#include "studio/outbox.h"
#include "studio/workbench.h"

namespace espalier::studio {

/// A model as it was published. Never changes; whoever holds it may look into it from any thread.
struct ShownModel {
  std::uint32_t number = 0;
  std::int64_t revision = 0;           // of the document
  std::shared_ptr<const Setup> setup;  // its grammar, meshes and targets
  Derivation derivation;
  std::string encoded;                 // the derivation as JSON
  std::optional<double> score;         // none without targets
  double optimum = 0;
  std::string words;
  std::vector<std::string> locks;      // paths
  /// Found by the search of `setup` in so many steps, so that the same search finds it again; 0: made otherwise.
  std::uint64_t steps = 0;
};
using ShownModelPtr = std::shared_ptr<const ShownModel>;

/// Is told, on the search's thread.
class LiveListener {
 public:
  virtual ~LiveListener() = default;
  virtual void shown(const ShownModelPtr& model, const ModelPacket& packet) = 0;
  virtual void searched(const api::SearchState& state) = 0;
  /// "" once it is mended.
  virtual void scene_problem(const std::string& text) = 0;
  virtual void noted(api::LogLevel level, const std::string& text) = 0;
};

enum class LiveStart : std::uint8_t {
  keep,     // the model that is shown stays as far as it can; a search that runs begins anew from it
  shown,    // search from the model that is shown
  nothing,  // search from nothing
  onward,   // go on with the search that was stopped; where there is none, a new one
};

class LiveSearch {
 public:
  /// The listener must outlive it. `shown`: the model to begin with as JSON, or "".
  LiveSearch(ReadBlob read_blob, LiveListener& listener, std::string shown);
  ~LiveSearch();

  /// The project has come to this state. `model`: to be shown instead, as JSON.
  void take(const StoredState& state, std::int64_t revision, LiveStart start, std::optional<std::string> model = {});
  /// Searches for so many seconds (more). Searches that `take` begins have the seconds of the scene's budget, else those of
  /// the last start.
  void start(LiveStart start, double seconds);
  void stop();

 private:
  class Work;

  struct Wishes {
    std::optional<StoredState> state;
    std::int64_t revision = 0;  // of the state
    std::optional<std::string> model;
    std::optional<LiveStart> start;
    std::optional<double> seconds;
    bool timed = false;  // the search that begins has these seconds, whatever the scene says
    bool stop = false, end = false;
    bool any() const { return state || model || start || stop || end; }
  };

  void wish(bool leaves_search);
  void run(std::string shown);

  ReadBlob read_blob_;
  LiveListener& listener_;
  std::mutex mutex_;
  std::condition_variable changed_;
  Wishes wishes_;
  /// When the step that runs is given up, as a time of the steady clock; 0: not at all.
  std::atomic<std::int64_t> give_up_at_{0};
  std::thread thread_;
};

}  // namespace espalier::studio
