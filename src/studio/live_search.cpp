#include "studio/live_search.h"

#include <algorithm>
#include <chrono>
#include <exception>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/adapt.h"
#include "derivation/encode.h"
#include "run/budget.h"
#include "run/search_session.h"
#include "studio/free_growth.h"
#include "studio/model_message.h"
#include "studio/shown_text.h"

namespace espalier::studio {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFirstSlice = 0.015, kSlice = 0.02;  // seconds between looks at what is wished
constexpr double kShortestShow = 0.06;                // between two models of one search
constexpr double kShowShare = 3;                      // and this times what showing took
constexpr double kStateEvery = 0.1;
constexpr std::size_t kMostRises = 200;
constexpr std::uint32_t kMostShownGenes = 200'000;
constexpr double kDefaultSeconds = 2;
// A search of the guided engine that goes on from a model may be stuck with it: after so many seconds one from nothing
// has its turn, and goes on in its place if it has found something better by then.
constexpr double kRivalAfter = 0.25, kRivalFor = 0.12;
constexpr std::uint32_t kDrawnAtOnce = 4;

double seconds_since(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

std::int64_t ticks(Clock::time_point time) { return time.time_since_epoch().count(); }

/// The step of an engine was given up.
struct GivenUp {};

/// Runs tasks on another executor, unless the time has come to give up.
class PatientExecutor final : public Executor {
 public:
  PatientExecutor(std::unique_ptr<Executor> executor, const std::atomic<std::int64_t>& give_up_at)
      : executor_(std::move(executor)), give_up_at_(give_up_at) {}
  int workers() const override { return executor_->workers(); }
  void for_each(std::size_t n, const std::function<void(std::size_t, int)>& task) override {
    executor_->for_each(n, [&](std::size_t i, int worker) {
      const std::int64_t at = give_up_at_.load(std::memory_order_relaxed);
      if (at != 0 && ticks(Clock::now()) >= at) throw GivenUp();
      task(i, worker);
    });
  }

 private:
  std::unique_ptr<Executor> executor_;
  const std::atomic<std::int64_t>& give_up_at_;
};

/// One core is left to the server.
std::unique_ptr<Executor> make_executor() {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  return cores > 2 ? make_tbb_executor(cores - 1) : make_serial_executor();
}

}  // namespace

/// What the search's thread has.
class LiveSearch::Work {
 public:
  Work(LiveSearch& live, std::string shown)
      : live_(live), listener_(live.listener_), bench_(live.read_blob_), shown_(std::move(shown)),
        executor_(make_executor(), live.give_up_at_), free_(shown_.empty()) {}

  bool running() const { return running_; }

  void handle(const Wishes& wishes) {
    if (wishes.stop) end_search();
    if (wishes.state && !take(*wishes.state)) return;
    if (wishes.state) revision_ = wishes.revision;
    if (wishes.seconds) seconds_ = *wishes.seconds;
    if (!bench_.ready()) return;
    if (wishes.model) shown_ = *wishes.model, free_ = false;
    const LiveStart start = wishes.start.value_or(LiveStart::keep);
    if (start == LiveStart::onward && session_ && !wishes.state) {
      budget_ = session_->last().seconds + seconds_;
      running_ = true;
      tell_state(true);
    } else if (wishes.start && (start != LiveStart::keep || running_)) {
      const bool anew = start == LiveStart::nothing || start == LiveStart::onward;
      // What grew freely is no better a beginning than nothing.
      const bool from_nothing = anew || (free_ && bench_.scene().locks.empty());
      begin(from_nothing ? LiveStart::nothing : LiveStart::shown, anew, wishes.timed);
    } else if (wishes.state || wishes.model) {
      show_again();
    }
  }

  /// After an error that was not foreseen.
  void give_up(const char* why) {
    note(api::LogLevel::error, fmt::format("the search was given up: {}", why));
    forget_session();
    tell_state(true);
  }

  void slice() {
    const bool first = session_->last().step == 0;
    const Clock::time_point began = Clock::now();
    std::string spent;
    try {
      do {
        session_->step();
        spent = budget_spent({.seconds = budget_, .evaluations = {}, .generations = {}}, session_->last());
      } while (spent.empty() && seconds_since(began) < (first ? kFirstSlice : kSlice) && live_.give_up_at_ == 0);
      session_->pause();
      if (may_have_rival_ && session_->last().seconds >= kRivalAfter && spent.empty()) meet_rival();
    } catch (const GivenUp&) {
      forget_session();
      tell_state(true);
      return;
    } catch (const Error& error) {
      forget_session();
      note(api::LogLevel::error, error.what());
      tell_state(true);
      return;
    }
    note_rise();
    const double score = session_->engine().best_score();
    const bool better = !published_ || score > *published_;
    const bool due = first || !spent.empty() || seconds_since(showed_at_) >= std::max(kShortestShow, kShowShare * show_took_);
    if (better && due) publish(session_->engine().best().derivation, session_->last().step);
    if (spent.empty()) return tell_state(false);
    running_ = false;
    tell_state(true);
  }

 private:
  bool take(const StoredState& state) {
    try {
      bench_.take(state);
      if (!bench_.scene().has_targets) forget_session();
      return true;
    } catch (const GrammarFault&) {
      problem("");
    } catch (const Error& error) {
      problem(error.what());
    }
    return false;
  }

  void problem(const std::string& words) {
    const std::string text = bench_.as_named(words);
    if (text == problem_) return;
    problem_ = text;
    listener_.scene_problem(text);
  }

  void note(api::LogLevel level, const std::string& text) { listener_.noted(level, bench_.as_named(text)); }

  void end_search() {
    if (session_ && session_->last().step > 0) {
      const double score = session_->engine().best_score();
      if (!published_ || score > *published_) publish(session_->engine().best().derivation, session_->last().step);
    }
    running_ = false;
    tell_state(true);
  }

  void forget_session() {
    session_.reset();
    running_ = false;
  }

  /// A setup that starts from the shown model if it can, with its locks if they lead anywhere.
  std::shared_ptr<const Setup> set_up_from_shown() {
    const std::vector<std::string>& locks = bench_.scene().locks;
    if (shown_.empty()) return bench_.set_up({});
    std::string why;
    for (const bool locked : {true, false}) {
      if (!locked && locks.empty()) continue;
      try {
        std::shared_ptr<const Setup> setup = bench_.set_up(StartModel{shown_, locked ? locks : std::vector<std::string>()});
        if (!locked) note(api::LogLevel::warning, "locks are left out: " + why);
        return setup;
      } catch (const Error& error) {
        why = error.what();
      }
    }
    std::shared_ptr<const Setup> setup = bench_.set_up({});  // throws what has nothing to do with the start
    note(api::LogLevel::info, "the search starts from nothing: " + why);
    return setup;
  }

  /// `anew`: without targets another model is wanted. `timed`: for the seconds that were asked for; else the scene's come first.
  void begin(LiveStart start, bool anew, bool timed) {
    forget_session();
    try {
      if (!bench_.scene().has_targets) {
        if (anew) shown_.clear(), drawn_ += kDrawnAtOnce;
        show_again();
        return;
      }
      setup_ = start == LiveStart::shown ? set_up_from_shown() : bench_.set_up({});
      problem("");
      tell_warnings();
      // Steps of the guided engine are short, and one thread is quicker there than several.
      session_ = std::make_unique<SearchSession>(*setup_, executor_);
      const double before = seconds_ > 0 ? seconds_ : kDefaultSeconds;
      budget_ = timed ? before : bench_.scene().scene.budget.seconds.value_or(before);
      running_ = true;
      published_.reset();
      rises_.clear();
      earlier_ = 0;
      const EngineKind engine = bench_.scene().scene.search.engine;
      may_have_rival_ = engine == EngineKind::guided && !setup_->founders.empty() && setup_->locks.empty();
    } catch (const GivenUp&) {
      forget_session();
    } catch (const Error& error) {
      forget_session();
      problem(error.what());
    }
    tell_state(true);
  }

  /// The shown model as the grammar has it now, or one that is freely grown where it has no place there any more.
  void show_again() {
    forget_session();
    try {
      setup_ = bench_.set_up({});
      problem("");
      tell_warnings();
      std::optional<Derivation> derivation = adapted();
      free_ = free_ || !derivation;
      publish(derivation ? std::move(*derivation) : freely_grown(), 0);
    } catch (const Error& error) {
      problem(error.what());
    }
    tell_state(true);
  }

  /// The largest of a few: many grammars may end at once.
  Derivation freely_grown() const {
    Derivation largest;
    for (std::uint32_t i = 0; i < kDrawnAtOnce; ++i) {
      Derivation one = grow_freely(setup_->graph(), setup_->scene, drawn_ + i);
      if (one.size() > largest.size()) largest = std::move(one);
    }
    return largest;
  }

  /// See kRivalAfter.
  void meet_rival() {
    may_have_rival_ = false;
    std::shared_ptr<const Setup> setup = bench_.set_up({});
    auto rival = std::make_unique<SearchSession>(*setup, executor_);
    do {
      rival->step();
    } while (rival->last().seconds < kRivalFor && live_.give_up_at_ == 0);
    rival->pause();
    if (rival->engine().best_score() <= session_->engine().best_score()) return;
    // What the search had spent stays spent.
    budget_ -= session_->last().seconds;
    earlier_ += session_->last().seconds;
    session_ = std::move(rival);
    setup_ = std::move(setup);
  }

  std::optional<Derivation> adapted() const {
    if (shown_.empty()) return std::nullopt;
    try {
      std::optional<Adapted> fitting =
          adapt(setup_->graph(), decode(setup_->graph(), shown_, kMostShownGenes, Fit::adaptable));
      if (fitting) return std::move(fitting->derivation);
    } catch (const Error&) {  // of another grammar
    }
    return std::nullopt;
  }

  void publish(Derivation derivation, std::uint64_t steps) {
    if (derivation.size() == 0) return;
    const Clock::time_point began = Clock::now();
    const GeneratorGraph& graph = setup_->graph();
    auto model = std::make_shared<ShownModel>();
    model->number = ++number_;
    model->revision = revision_;
    model->setup = setup_;
    model->derivation = std::move(derivation);
    model->encoded = encode(graph, model->derivation);
    model->steps = steps;
    model->locks = bench_.scene().locks;
    Expander expander(graph);
    expander.expand(model->derivation, ExpandTo::full, model_);
    const Explanation explanation = explain(*model, expander);
    if (bench_.scene().has_targets) model->score = explanation.score, model->optimum = explanation.optimum;
    model->words = explanation.words;
    ModelPacket packet;
    packet.table = table();
    packet.meshes = meshes_;
    SentModel sent = model_message(model->number, packet.table, graph, model->derivation, model_);
    packet.shown = std::make_shared<const std::string>(to_text(shown_text(*model, explanation, model_, sent)));
    packet.model = std::make_shared<const std::string>(std::move(sent.bytes));
    shown_ = model->encoded;
    if (steps > 0) free_ = false;
    if (session_) published_ = session_->engine().best_score();
    listener_.shown(model, packet);
    showed_at_ = Clock::now();
    show_took_ = seconds_since(began);
  }

  Explanation explain(const ShownModel& shown, Expander& expander) {
    const Objective& objective = setup_->objective;
    Objective::Scratch scratch(objective);
    const Model* seen = &model_;
    switch (objective.view()) {
      case TargetView::genes: view_.clear(), seen = &view_; break;
      case TargetView::bones: expander.expand(shown.derivation, ExpandTo::bones, view_), seen = &view_; break;
      case TargetView::parts: expander.expand(shown.derivation, ExpandTo::parts, view_), seen = &view_; break;
      case TargetView::full: break;
    }
    return objective.explain(shown.derivation, *seen, scratch);
  }

  /// Of the setup's meshes; a new number whenever they may have changed.
  std::uint32_t table() {
    if (meshes_of_ == bench_.grammar_number()) return table_;
    std::string message = mesh_message(table_ + 1, setup_->meshes);
    const bool same = meshes_ && std::string_view(*meshes_).substr(12) == std::string_view(message).substr(12);
    if (!same) meshes_ = std::make_shared<const std::string>(std::move(message)), ++table_;
    meshes_of_ = bench_.grammar_number();
    return table_;
  }

  void tell_warnings() {
    if (setup_->warnings == warned_) return;
    warned_ = setup_->warnings;
    for (const std::string& warning : warned_) note(api::LogLevel::warning, warning);
  }

  void note_rise() {
    const StepReport& last = session_->last();
    if (!rises_.empty() && last.best <= rises_.back()[1]) return;
    rises_.push_back({earlier_ + last.seconds, last.best});
    if (rises_.size() <= kMostRises) return;
    std::vector<std::array<double, 2>> thinned;
    for (std::size_t i = 0; i < rises_.size(); ++i) {
      if (i % 2 == 0 || i + 1 == rises_.size()) thinned.push_back(rises_[i]);
    }
    rises_ = std::move(thinned);
  }

  void tell_state(bool at_once) {
    if (!at_once && seconds_since(told_at_) < kStateEvery) return;
    told_at_ = Clock::now();
    api::SearchState state;
    state.running = running_;
    state.engine = name_of(bench_.scene().scene.search.engine);
    state.rises = rises_;
    state.onward = session_ != nullptr;
    if (session_) {
      const StepReport& last = session_->last();
      state.steps = static_cast<std::int64_t>(last.step);
      state.evaluations = static_cast<std::int64_t>(last.evaluations);
      state.seconds = earlier_ + last.seconds;
      if (last.step > 0) state.best = last.best;
    }
    listener_.searched(state);
  }

  LiveSearch& live_;
  LiveListener& listener_;
  Workbench bench_;
  std::string shown_;  // JSON
  PatientExecutor executor_;
  std::shared_ptr<const Setup> setup_;
  std::unique_ptr<SearchSession> session_;  // of setup_
  bool running_ = false, may_have_rival_ = false;
  bool free_;               // what is shown grew freely
  double earlier_ = 0;      // seconds of a search that gave way to its rival
  double seconds_ = 0, budget_ = 0;  // as last asked for, 0: never; when the search is over
  std::uint32_t number_ = 0, drawn_ = 0;
  std::int64_t revision_ = 0;
  std::optional<double> published_;  // best score of the session that was shown
  std::vector<std::array<double, 2>> rises_;
  std::vector<std::string> warned_;
  std::string problem_;
  Bytes meshes_;
  std::uint32_t table_ = 0, meshes_of_ = 0;
  Model model_, view_;
  Clock::time_point showed_at_{}, told_at_{};
  double show_took_ = 0;
};

LiveSearch::LiveSearch(ReadBlob read_blob, LiveListener& listener, std::string shown)
    : read_blob_(std::move(read_blob)), listener_(listener), thread_([this, shown] { run(shown); }) {}

LiveSearch::~LiveSearch() {
  {
    const std::lock_guard lock(mutex_);
    wishes_.end = true;
    give_up_at_ = 1;
  }
  changed_.notify_all();
  thread_.join();
}

void LiveSearch::wish(bool leaves_search) {
  constexpr auto kPatience = std::chrono::milliseconds(200);
  if (leaves_search && give_up_at_ == 0) give_up_at_ = ticks(Clock::now() + kPatience);
  changed_.notify_all();
}

void LiveSearch::take(const StoredState& state, std::int64_t revision, LiveStart start, std::optional<std::string> model) {
  const std::lock_guard lock(mutex_);
  wishes_.state = state;
  wishes_.revision = revision;
  if (model) wishes_.model = std::move(model);
  // An edit that asks for a search is not undone by one after it that does not.
  if (!wishes_.start || start != LiveStart::keep) wishes_.start = start, wishes_.timed = false;
  wish(true);
}

void LiveSearch::start(LiveStart start, double seconds) {
  const std::lock_guard lock(mutex_);
  wishes_.start = start;
  wishes_.seconds = seconds;
  wishes_.timed = true;
  wishes_.stop = false;
  wish(start != LiveStart::onward);
}

void LiveSearch::stop() {
  const std::lock_guard lock(mutex_);
  wishes_.stop = true;
  if (!wishes_.state) wishes_.start.reset();
  else wishes_.start = LiveStart::keep;
  wish(true);
}

void LiveSearch::run(std::string shown) {
  std::unique_ptr<Work> work;
  try {
    work = std::make_unique<Work>(*this, std::move(shown));
  } catch (const std::exception& error) {
    listener_.noted(api::LogLevel::error, error.what());
    return;
  }
  for (;;) {
    Wishes wishes;
    {
      std::unique_lock lock(mutex_);
      if (!work->running()) changed_.wait(lock, [&] { return wishes_.any(); });
      if (wishes_.end) return;
      std::swap(wishes, wishes_);
      give_up_at_ = 0;
    }
    try {
      if (wishes.any()) work->handle(wishes);
      if (work->running()) work->slice();
    } catch (const std::exception& error) {
      work->give_up(error.what());
    }
  }
}

}  // namespace espalier::studio
