#include "run/contest.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/check.h"
#include "base/error.h"
#include "run/budget.h"
#include "run/model_files.h"

namespace espalier {
namespace {

/// A search that takes turns with others.
struct Contender {
  std::size_t variant = 0;
  std::unique_ptr<SearchSession> session;
  Rises rises;
  bool over = false;
};

double share_spent(const SceneBudget& budget, const StepReport& report) {
  double share = 0;
  if (budget.generations) share = static_cast<double>(report.step) / static_cast<double>(*budget.generations);
  if (budget.evaluations) share = static_cast<double>(report.evaluations) / static_cast<double>(*budget.evaluations);
  if (budget.seconds) share = report.seconds / *budget.seconds;
  return std::min(share, 1.0);
}

class ContestRun {
 public:
  ContestRun(const Contest& contest, ContestSetups& setups, Executor& executor, const ContestControl& control,
             const std::function<void(ContestOutcome)>& take)
      : contest_(contest), setups_(setups), executor_(executor), control_(control), take_(take) {
    if (control.watcher) watcher_ = control.watcher;
  }

  bool run() {
    const std::size_t count = contest_.variants.size();
    for (const std::uint64_t seed : contest_.seeds) {
      for (std::size_t begin = 0; begin < count; begin += ContestSetups::kMostKept) {
        race(begin, std::min(count, begin + ContestSetups::kMostKept), seed);
        if (stopped()) return false;
        setups_.rest();
      }
    }
    if (!any_found_ && !problem_.empty()) throw Error(problem_);
    return true;
  }

 private:
  bool stopped() const { return control_.stop && control_.stop->load(); }

  void race(std::size_t begin, std::size_t end, std::uint64_t seed) {
    seed_ = seed;
    contenders_.clear();
    for (std::size_t variant = begin; variant < end && !stopped(); ++variant) enter(variant);
    const auto goes_on = [](const Contender& contender) { return !contender.over; };
    while (!stopped() && std::any_of(contenders_.begin(), contenders_.end(), goes_on)) {
      for (Contender& contender : contenders_) {
        if (!contender.over && !stopped()) turn(contender);
      }
    }
    for (Contender& contender : contenders_) {
      if (!contender.over && contender.session->last().step > 0) end_of(contender, "interrupt");
    }
    contenders_.clear();
  }

  void enter(std::size_t variant) {
    Contender& contender = contenders_.emplace_back();
    contender.variant = variant;
    try {
      Setup& setup = setups_.of(variant);
      setup.scene.seed = seed_;
      setup.scene.output.keep = 0;  // alternatives are no part of the contest
      contender.session = std::make_unique<SearchSession>(setup, executor_, contest_.clock);
    } catch (const Error& error) {
      fail(contender, error.what());
    }
  }

  void turn(Contender& contender) {
    SearchSession& session = *contender.session;
    const double begin = session.last().seconds;
    std::string reason;
    try {
      do {
        contender.rises.add(session.step());
        reason = budget_spent(contest_.budget, session.last());
      } while (reason.empty() && session.last().seconds - begin < control_.slice_seconds && !stopped());
    } catch (const Error& error) {
      return fail(contender, error.what());
    }
    session.pause();
    if (!reason.empty()) end_of(contender, reason);
    watcher_->turn({contender.variant, seed_, contender.over ? last_ : session.last(), share_done()});
  }

  void end_of(Contender& contender, const std::string& reason) {
    last_ = contender.session->last();
    SearchResult result = contender.session->finish(reason);
    ContestOutcome outcome;
    outcome.variant = contender.variant, outcome.seed = seed_;
    outcome.rises = std::move(contender.rises);
    outcome.steps = result.log.steps();
    outcome.best = std::move(result.best);
    outcome.genes = outcome.best.derivation.size(), outcome.derivation = hash_text(outcome.best.derivation);
    outcome.step_count = result.steps, outcome.evaluations = result.evaluations, outcome.seconds = last_.seconds;
    outcome.stopped_by = reason;
    outcome.score = outcome.rises.best();
    if (reason == "seconds") outcome.score = outcome.rises.at(Effort::seconds, *contest_.budget.seconds);
    if (reason == "evaluations")
      outcome.score = outcome.rises.at(Effort::evaluations, static_cast<double>(*contest_.budget.evaluations));
    hand_over(contender, std::move(outcome));
  }

  void fail(Contender& contender, const std::string& why) {
    const std::string text = fmt::format("{}, seed {}: {}", contest_.variants[contender.variant].name, seed_, why);
    if (problem_.empty()) problem_ = text;
    watcher_->warning(text);
    ContestOutcome outcome;
    outcome.variant = contender.variant, outcome.seed = seed_, outcome.problem = why;
    hand_over(contender, std::move(outcome));
  }

  void hand_over(Contender& contender, ContestOutcome outcome) {
    contender.over = true;
    contender.session.reset();
    if (outcome.problem.empty()) any_found_ = true;
    ++done_;
    watcher_->ended(outcome);
    take_(std::move(outcome));
  }

  double share_done() const {
    double done = static_cast<double>(done_);
    for (const Contender& contender : contenders_) {
      if (!contender.over) done += share_spent(contest_.budget, contender.session->last());
    }
    return done / static_cast<double>(contest_.variants.size() * contest_.seeds.size());
  }

  const Contest& contest_;
  ContestSetups& setups_;
  Executor& executor_;
  const ContestControl& control_;
  const std::function<void(ContestOutcome)>& take_;
  ContestWatcher silent_;
  ContestWatcher* watcher_ = &silent_;
  std::vector<Contender> contenders_;
  std::uint64_t seed_ = 0;
  StepReport last_;
  std::size_t done_ = 0;
  bool any_found_ = false;
  std::string problem_;  // of the first that failed
};

}  // namespace

Setup& ContestSetups::of(std::size_t variant) {
  CHECK(variant < contest_.variants.size());
  if (!first_) first();
  return make(variant);
}

Setup& ContestSetups::first() {
  if (first_) return make(*first_);
  std::string problem;
  for (std::size_t variant = 0; variant < contest_.variants.size(); ++variant) {
    try {
      Setup& setup = make(variant);
      first_ = variant, settled_ = setup.scene.silhouettes;
      return setup;
    } catch (const Error& error) {
      if (problem.empty()) problem = error.what();
    }
  }
  throw Error(problem);
}

Setup& ContestSetups::make(std::size_t variant) {
  setups_.resize(contest_.variants.size());
  if (setups_[variant]) return *setups_[variant];
  Scene scene = contest_.variants[variant].scene;
  const std::vector<SceneSilhouette>& as_first = contest_.variants[first_.value_or(variant)].scene.silhouettes;
  for (std::size_t i = 0; i < std::min(settled_.size(), scene.silhouettes.size()); ++i) {
    if (scene.silhouettes[i] == as_first[i]) scene.silhouettes[i].camera = settled_[i].camera;
  }
  setups_[variant] = set_up(scene, source_);
  return *setups_[variant];
}

void ContestSetups::rest() {
  if (setups_.size() > kMostKept) setups_.clear();
}

bool run_contest(const Contest& contest, ContestSetups& setups, Executor& executor, const ContestControl& control,
                 const std::function<void(ContestOutcome)>& take) {
  return ContestRun(contest, setups, executor, control, take).run();
}

std::size_t failed_of(std::span<const std::optional<ContestOutcome>> searches) {
  return static_cast<std::size_t>(std::count_if(searches.begin(), searches.end(), [](const auto& search) {
    return search && !search->problem.empty();
  }));
}

std::string failures_in_words(const std::string& name, std::span<const std::optional<ContestOutcome>> searches) {
  const std::size_t failed = failed_of(searches);
  if (failed == 0) return "";
  const auto begun = std::count_if(searches.begin(), searches.end(), [](const auto& one) { return one.has_value(); });
  const auto first = std::find_if(searches.begin(), searches.end(), [](const auto& search) {
    return search && !search->problem.empty();
  });
  return fmt::format("{}: {} of {} came to nothing; seed {}: {}", name, failed,
                     begun == 1 ? "1 search" : fmt::format("{} searches", begun), (*first)->seed, (*first)->problem);
}

std::vector<std::string> warn_of_other_scores(const Contest& contest) {
  std::vector<std::string> lines;
  const Scene& first = contest.variants.front().scene;
  for (const ContestVariant& variant : contest.variants) {
    const Scene& scene = variant.scene;
    if (scene.volume == first.volume && scene.silhouettes == first.silhouettes && scene.limits == first.limits)
      continue;
    lines.push_back(fmt::format("{} has other targets or limits than {}: their scores do not compare", variant.name,
                                contest.variants.front().name));
  }
  return lines;
}

}  // namespace espalier
