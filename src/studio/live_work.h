#pragma once
// LiveWork: what a search that keeps a model shown does, one wish and one slice of time after the other. Of one thread.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <studio_types.h>

#include "run/search_session.h"
#include "studio/patient_executor.h"
#include "studio/publisher.h"
#include "studio/rises.h"
#include "studio/workbench.h"

namespace espalier::studio {

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

/// What is wanted of a search since it was looked at last.
struct LiveWishes {
  std::optional<StoredState> state;
  std::int64_t revision = 0;  // of the state
  std::optional<std::string> model;
  std::optional<LiveStart> start;
  std::optional<double> seconds;
  bool timed = false;  // the search that begins has these seconds, whatever the scene says
  bool stop = false, end = false;
  bool any() const { return state || model || start || stop || end; }
};

class LiveWork {
 public:
  /// `give_up_at`: see PatientExecutor; other than 0, somebody waits and a slice ends early. `shown`: the model to begin
  /// with as JSON, or "".
  LiveWork(ReadBlob read_blob, LiveListener& listener, const std::atomic<std::int64_t>& give_up_at, std::string shown);

  bool running() const { return running_; }
  void handle(const LiveWishes& wishes);
  /// After an error that was not foreseen.
  void give_up(const char* why);
  void slice();

 private:
  using Clock = std::chrono::steady_clock;

  bool take(const StoredState& state);
  void problem(const std::string& words);
  void note(api::LogLevel level, const std::string& text) { listener_.noted(level, bench_.as_named(text)); }
  /// After each step: what is found is not lost with a step that is given up.
  void note_best();
  void end_search();
  void forget_session();
  /// A setup that starts from the shown model if it can, with its locks if they lead anywhere.
  std::shared_ptr<const Setup> set_up_from_shown();
  /// `anew`: without targets another model is wanted. `timed`: for the seconds that were asked for; else the scene's come first.
  void begin(LiveStart start, bool anew, bool timed);
  /// The shown model as the grammar has it now, or one that is freely grown where it has no place there any more.
  void show_again();
  /// The largest of a few: many grammars may end at once.
  Derivation freely_grown() const;
  /// See kRivalAfter.
  void meet_rival();
  std::optional<Derivation> adapted() const;
  void publish(Derivation derivation, std::uint64_t steps);
  void tell_warnings();
  void tell_state(bool at_once);

  LiveListener& listener_;
  const std::atomic<std::int64_t>& give_up_at_;
  Workbench bench_;
  std::string shown_;  // JSON
  PatientExecutor executor_;
  std::shared_ptr<const Setup> setup_;
  std::unique_ptr<SearchSession> session_;  // of setup_
  bool running_ = false, may_have_rival_ = false;
  bool free_;               // what is shown grew freely
  double earlier_ = 0;      // seconds of a search that gave way to its rival
  double seconds_ = 0, budget_ = 0;  // as last asked for, 0: never; when the search is over
  std::uint32_t drawn_ = 0;
  std::int64_t revision_ = 0;
  struct Best {
    double score;
    Derivation derivation;
    std::uint64_t steps;
  };
  std::optional<Best> best_;  // of the session
  std::optional<double> published_;  // best score of the session that was shown
  Rises rises_;
  std::vector<std::string> warned_;
  std::string problem_;
  Publisher publisher_;
  Clock::time_point showed_at_{}, told_at_{};
  double show_took_ = 0;
};

}  // namespace espalier::studio
