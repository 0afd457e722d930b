#include "studio/live_work.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/adapt.h"
#include "derivation/encode.h"
#include "run/budget.h"
#include "studio/free_growth.h"

namespace espalier::studio {
namespace {

constexpr double kFirstSlice = 0.015, kSlice = 0.02;  // seconds between looks at what is wished
constexpr double kShortestShow = 0.06;                // between two models of one search
constexpr double kShowShare = 3;                      // and this times what showing took
constexpr double kStateEvery = 0.1;
constexpr std::uint32_t kMostShownGenes = 200'000;
constexpr double kDefaultSeconds = 2;
// A search of the guided engine that goes on from a model may be stuck with it: after so many seconds one from nothing
// has its turn, and goes on in its place if it has found something better by then.
constexpr double kRivalAfter = 0.25, kRivalFor = 0.12;
constexpr std::uint32_t kDrawnAtOnce = 4;

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace

LiveWork::LiveWork(ReadBlob read_blob, LiveListener& listener, const std::atomic<std::int64_t>& give_up_at,
                   std::string shown)
    : listener_(listener), give_up_at_(give_up_at), bench_(std::move(read_blob)), shown_(std::move(shown)),
      executor_(give_up_at_), free_(shown_.empty()) {}

void LiveWork::handle(const LiveWishes& wishes) {
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

void LiveWork::give_up(const char* why) {
  note(api::LogLevel::error, fmt::format("the search was given up: {}", why));
  forget_session();
  tell_state(true);
}

void LiveWork::slice() {
  const bool first = session_->last().step == 0;
  const Clock::time_point began = Clock::now();
  std::string spent;
  try {
    do {
      session_->step();
      note_best();
      spent = budget_spent({.seconds = budget_, .evaluations = {}, .generations = {}}, session_->last());
    } while (spent.empty() && seconds_since(began) < (first ? kFirstSlice : kSlice) && give_up_at_ == 0);
    session_->pause();
    if (may_have_rival_ && session_->last().seconds >= kRivalAfter && spent.empty()) meet_rival();
  } catch (const GivenUp&) {
    // The step is lost, and with it the search; what was found before is not.
    if (best_ && (!published_ || best_->score > *published_)) publish(std::move(best_->derivation), best_->steps);
    forget_session();
    tell_state(true);
    return;
  } catch (const Error& error) {
    forget_session();
    note(api::LogLevel::error, error.what());
    tell_state(true);
    return;
  }
  rises_.note(earlier_ + session_->last().seconds, session_->last().best);
  const double score = session_->engine().best_score();
  const bool better = !published_ || score > *published_;
  const bool due = first || !spent.empty() || seconds_since(showed_at_) >= std::max(kShortestShow, kShowShare * show_took_);
  if (better && due) publish(session_->engine().best().derivation, session_->last().step);
  if (spent.empty()) return tell_state(false);
  running_ = false;
  tell_state(true);
}

bool LiveWork::take(const StoredState& state) {
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

void LiveWork::problem(const std::string& words) {
  const std::string text = bench_.as_named(words);
  if (text == problem_) return;
  problem_ = text;
  listener_.scene_problem(text);
}

void LiveWork::end_search() {
  if (session_ && session_->last().step > 0) {
    const double score = session_->engine().best_score();
    if (!published_ || score > *published_) publish(session_->engine().best().derivation, session_->last().step);
  }
  running_ = false;
  tell_state(true);
}

void LiveWork::note_best() {
  const double score = session_->engine().best_score();
  if (best_ && score <= best_->score) return;
  best_ = Best{score, session_->engine().best().derivation, session_->last().step};
}

void LiveWork::forget_session() {
  session_.reset();
  best_.reset();
  running_ = false;
}

std::shared_ptr<const Setup> LiveWork::set_up_from_shown() {
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

void LiveWork::begin(LiveStart start, bool anew, bool timed) {
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

void LiveWork::show_again() {
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

Derivation LiveWork::freely_grown() const {
  Derivation largest;
  for (std::uint32_t i = 0; i < kDrawnAtOnce; ++i) {
    Derivation one = grow_freely(setup_->graph(), setup_->scene, drawn_ + i);
    if (one.size() > largest.size()) largest = std::move(one);
  }
  return largest;
}

void LiveWork::meet_rival() {
  may_have_rival_ = false;
  std::shared_ptr<const Setup> setup = bench_.set_up({});
  auto rival = std::make_unique<SearchSession>(*setup, executor_);
  do {
    rival->step();
  } while (rival->last().seconds < kRivalFor && give_up_at_ == 0);
  rival->pause();
  if (rival->engine().best_score() <= session_->engine().best_score()) return;
  // What the search had spent stays spent.
  budget_ -= session_->last().seconds;
  earlier_ += session_->last().seconds;
  session_ = std::move(rival);
  setup_ = std::move(setup);
  note_best();
}

std::optional<Derivation> LiveWork::adapted() const {
  if (shown_.empty()) return std::nullopt;
  try {
    std::optional<Adapted> fitting =
        adapt(setup_->graph(), decode(setup_->graph(), shown_, kMostShownGenes, Fit::adaptable));
    if (fitting) return std::move(fitting->derivation);
  } catch (const Error&) {  // of another grammar
  }
  return std::nullopt;
}

void LiveWork::publish(Derivation derivation, std::uint64_t steps) {
  if (derivation.size() == 0) return;
  const Clock::time_point began = Clock::now();
  const Published made = publisher_.publish(bench_, setup_, revision_, std::move(derivation), steps);
  shown_ = made.model->encoded;
  if (steps > 0) free_ = false;
  if (session_) published_ = session_->engine().best_score();
  listener_.shown(made.model, made.packet);
  showed_at_ = Clock::now();
  show_took_ = seconds_since(began);
}

void LiveWork::tell_warnings() {
  if (setup_->warnings == warned_) return;
  warned_ = setup_->warnings;
  for (const std::string& warning : warned_) note(api::LogLevel::warning, warning);
}

void LiveWork::tell_state(bool at_once) {
  if (!at_once && seconds_since(told_at_) < kStateEvery) return;
  told_at_ = Clock::now();
  api::SearchState state;
  state.running = running_;
  state.engine = name_of(bench_.scene().scene.search.engine);
  state.rises = rises_.pairs();
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

}  // namespace espalier::studio
