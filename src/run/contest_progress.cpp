#include "run/contest_progress.h"

#include <algorithm>
#include <chrono>
#include <ostream>

#include <fmt/format.h>

#include "base/counted.h"

namespace espalier {
namespace {

constexpr std::size_t kWidth = 110;

std::string time_in_words(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string score_in_words(double score, double optimum) {
  return optimum > 0 ? fmt::format("{:.1f} %", 100 * score / optimum) : fmt::format("{:.6g}", score);
}

/// "seeds 1 to 5", "seeds 3, 7, 9".
std::string seeds_in_words(const std::vector<std::uint64_t>& seeds) {
  if (seeds.size() == 1) return fmt::format("seed {}", seeds[0]);
  if (seeds.back() - seeds[0] == seeds.size() - 1 && std::is_sorted(seeds.begin(), seeds.end()))
    return fmt::format("seeds {} to {}", seeds[0], seeds.back());
  return fmt::format("seeds {}", fmt::join(seeds, ", "));
}

class ContestLines : public ContestObserver {
 public:
  explicit ContestLines(std::ostream& out, double interval_s = 10) : out_(out), interval_s_(interval_s) {}

  void started(const ContestStart& start) override {
    start_ = start;
    begin_ = shown_ = Clock::now();
    best_.assign(start.names.size(), "");
    print(fmt::format("{}: {}", start.grammar, plan_in_words(start)));
  }
  void turn(const ContestTurn& turn) override {
    if (turn.seed != seed_) best_.assign(start_.names.size(), "");
    seed_ = turn.seed;
    best_[turn.variant] = score_in_words(turn.report.best, start_.optimum);
    const Clock::time_point now = Clock::now();
    if (std::chrono::duration<double>(now - shown_).count() < interval_s_) return;
    shown_ = now;
    show(turn.share);
  }
  void ended(const ContestOutcome& outcome) override {
    clear();
    const std::string& name = start_.names[outcome.variant];
    if (!outcome.problem.empty()) return print(fmt::format("seed {}  {}  failed", outcome.seed, name));
    print(fmt::format("seed {}  {}  {:.6g} ({}), {} evaluations in {} steps, {:.1f} s{}", outcome.seed, name,
                      outcome.rises.best(), score_in_words(outcome.rises.best(), start_.optimum),
                      grouped(outcome.evaluations), grouped(outcome.step_count), outcome.seconds,
                      outcome.complete() ? "" : ", interrupted"));
  }
  void warning(const std::string& text) override {
    clear();
    print("warning: " + text);
  }

 protected:
  virtual void show(double share) { print(status(share)); }
  virtual void clear() {}
  void print(const std::string& text) { out_ << text << (text.ends_with('\n') ? "" : "\n") << std::flush; }

  std::string status(double share) const {
    std::string line = fmt::format("{:.0f} %  seed {} ", 100 * share, seed_);
    for (std::size_t i = 0; i < best_.size(); ++i) {
      if (best_[i].empty()) continue;
      const std::string one = fmt::format(" {} {}", start_.names[i], best_[i]);
      if (line.size() + one.size() + 20 > kWidth) {
        line += " ...";
        break;
      }
      line += one;
    }
    const double spent = std::chrono::duration<double>(Clock::now() - begin_).count();
    if (share > 0.02) line += fmt::format("  {} left", time_in_words(spent * (1 - share) / share));
    return line;
  }

  std::ostream& out_;

 private:
  using Clock = std::chrono::steady_clock;
  ContestStart start_;
  double interval_s_;
  Clock::time_point begin_, shown_;
  std::uint64_t seed_ = 0;
  std::vector<std::string> best_;  // of each variant with this seed, in words
};

class ContestBar final : public ContestLines {
 public:
  explicit ContestBar(std::ostream& out) : ContestLines(out, 0.1) {}

  void writing() override {
    clear();
    out_ << "writing results ..." << std::flush;
    dirty_ = true;
  }
  void written() override { clear(); }

 protected:
  void show(double share) override {
    constexpr int kBar = 16;
    const auto filled = static_cast<std::size_t>(kBar * share);
    out_ << "\r\x1b[K[" << std::string(filled, '=') << std::string(kBar - filled, ' ') << "] " << status(share)
         << std::flush;
    dirty_ = true;
  }
  void clear() override {
    if (dirty_) out_ << "\r\x1b[K" << std::flush;
    dirty_ = false;
  }

 private:
  bool dirty_ = false;
};

}  // namespace

std::string plan_in_words(const ContestStart& start) {
  const std::size_t searches = start.names.size() * start.seeds.size();
  std::string text = fmt::format("{}, {}, {} each", counted(start.names.size(), start.what == "sweep" ? "combination" : "variant"),
                                 seeds_in_words(start.seeds), in_words(start.budget));
  text += fmt::format(" with {}", counted(static_cast<std::size_t>(start.threads), "thread"));
  if (!start.budget.seconds || searches == 1) return text;
  return text + fmt::format(": about {}", time_in_words(*start.budget.seconds * static_cast<double>(searches)));
}

std::unique_ptr<ContestObserver> make_contest_bar(std::ostream& out) { return std::make_unique<ContestBar>(out); }
std::unique_ptr<ContestObserver> make_contest_lines(std::ostream& out) { return std::make_unique<ContestLines>(out); }

ContestStart contest_start(const char* what, const Contest& contest, const Setup& setup, const std::string& out,
                           int threads) {
  ContestStart start;
  start.what = what;
  start.grammar = setup.graph().name;
  for (const ContestVariant& variant : contest.variants) start.names.push_back(variant.name);
  start.seeds = contest.seeds;
  start.budget = contest.budget;
  start.threads = threads;
  start.optimum = setup.objective.optimum();
  start.out = out;
  return start;
}

}  // namespace espalier
