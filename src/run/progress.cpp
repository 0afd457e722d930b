#include "run/progress.h"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

namespace espalier {
namespace {

std::string targets_of(const RunStart& start) {
  std::string text;
  if (start.voxels > 0) text += fmt::format(", {} voxels", start.voxels);
  if (start.pixels > 0) text += fmt::format(", {} pixels", start.pixels);
  return text;
}

std::string headline(const RunStart& start) {
  std::string text = fmt::format("{} with {}, seed {}, {} thread{}{}", start.grammar, start.engine, start.seed,
                                 start.threads, start.threads == 1 ? "" : "s", targets_of(start));
  if (start.optimum > 0) text += fmt::format(", optimum {:.6g}", start.optimum);
  return text;
}

std::string progress_line(const RunStart& start, const StepReport& report) {
  std::string line = fmt::format("{:6.1f} s  step {}  {} evaluations  best {:.6g}", report.seconds, report.step,
                                 report.evaluations, report.best);
  if (start.optimum > 0) line += fmt::format(" ({:.1f} %)", 100 * report.best / start.optimum);
  return line + fmt::format("  mean {:.6g}", report.mean);
}

// How much of the budget is spent, by the part that is nearest its end.
double share_spent(const SceneBudget& budget, const StepReport& report) {
  double share = 0;
  if (budget.seconds) share = std::max(share, report.seconds / *budget.seconds);
  if (budget.evaluations) {
    share = std::max(share, static_cast<double>(report.evaluations) / static_cast<double>(*budget.evaluations));
  }
  if (budget.generations) {
    share = std::max(share, static_cast<double>(report.step) / static_cast<double>(*budget.generations));
  }
  return std::min(share, 1.0);
}

class Lines : public RunObserver {
 public:
  explicit Lines(std::ostream& out, double interval_s = 1) : out_(out), interval_s_(interval_s) {}

  void started(const RunStart& start) override {
    start_ = start;
    print(headline(start));
    if (start.resumed_from > 0) {
      print(fmt::format("continues from step {} of {}", start.resumed_from, start.resumed_folder));
    }
    if (!start.live.empty()) {
      print(fmt::format("watch it in {} (refreshed every {:g} s)", start.live, start.refresh_seconds));
    }
  }
  void step(const StepReport& report) override {
    if (shown_ && report.seconds - last_s_ < interval_s_) return;
    shown_ = true;
    last_s_ = report.seconds;
    show(report);
  }
  void warning(const std::string& text) override { print("warning: " + text); }
  void finished(const RunEnd& end) override { print(summary(end)); }

 protected:
  virtual void show(const StepReport& report) { print(progress_line(start_, report)); }
  void print(const std::string& text) {
    out_ << text << (text.ends_with('\n') ? "" : "\n");
    out_.flush();
  }

  std::ostream& out_;
  RunStart start_;

 private:
  double interval_s_;
  double last_s_ = 0;
  bool shown_ = false;
};

class Bar final : public Lines {
 public:
  explicit Bar(std::ostream& out) : Lines(out, 0.1) {}

  void warning(const std::string& text) override {
    clear();
    Lines::warning(text);
  }
  void writing() override {
    clear();
    out_ << "writing results ..." << std::flush;
    dirty_ = true;
  }
  void finished(const RunEnd& end) override {
    clear();
    Lines::finished(end);
  }

 protected:
  void show(const StepReport& report) override {
    constexpr int kWidth = 24;
    const int filled = static_cast<int>(kWidth * share_spent(start_.budget, report));
    out_ << "\r\x1b[K[" << std::string(static_cast<std::size_t>(filled), '=')
         << std::string(static_cast<std::size_t>(kWidth - filled), ' ') << "] " << progress_line(start_, report)
         << std::flush;
    dirty_ = true;
  }

 private:
  void clear() {
    if (dirty_) out_ << "\r\x1b[K" << std::flush;
    dirty_ = false;
  }
  bool dirty_ = false;
};

}  // namespace

std::unique_ptr<RunObserver> make_bar(std::ostream& out) { return std::make_unique<Bar>(out); }
std::unique_ptr<RunObserver> make_lines(std::ostream& out) { return std::make_unique<Lines>(out); }

std::string summary(const RunEnd& end) {
  std::string text = fmt::format("score {:.6g}", end.score);
  if (end.optimum > 0) text += fmt::format(" of at most {:.6g}", end.optimum);
  if (end.percent) text += fmt::format(" ({:.1f} %)", *end.percent);
  if (!end.words.empty()) text += ": " + end.words;
  text += fmt::format("\n{} evaluations in {} steps and {:.1f} s ({:.0f} per second), ended by {}\n", end.evaluations,
                      end.steps, end.seconds,
                      end.seconds > 0 ? static_cast<double>(end.evaluations) / end.seconds : 0.0, end.stopped_by);
  if (end.alternatives > 0) {
    text += fmt::format("{} alternative{}, on average {:.2f} apart (0: alike, 1: nothing in common)\n", end.alternatives,
                        end.alternatives == 1 ? "" : "s", end.spread);
  }
  for (const std::string& file : end.files) text += "wrote " + file + "\n";
  return text;
}

}  // namespace espalier
