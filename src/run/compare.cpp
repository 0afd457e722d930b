#include "run/compare.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/counted.h"
#include "base/error.h"
#include "io/file.h"
#include "run/compare_page.h"

namespace espalier {
namespace {

constexpr double kLikely = 0.05;  // what chance does so often is not told apart

/// Keeps what the summary needs; the best derivation of each variant is kept once.
void take_outcome(const Contest& contest, ContestOutcome outcome, CompareResult& result) {
  keep_best(result.bests[outcome.variant], outcome);
  const auto seed = std::find(contest.seeds.begin(), contest.seeds.end(), outcome.seed) - contest.seeds.begin();
  outcome.best.derivation = {};
  outcome.steps.clear();
  std::optional<ContestOutcome>& place = result.outcomes[outcome.variant][static_cast<std::size_t>(seed)];
  place = std::move(outcome);
}

class CompareFolder {
 public:
  CompareFolder(const CompareRequest& request, const CompareResult& result, ContestSetups& setups, Executor& executor)
      : contest_(request.contest), result_(result) {
    page_.command = request.command;
    for (std::size_t v = 0; v < contest_.variants.size(); ++v) {
      bests_.emplace_back();
      page_.settings.emplace_back(), page_.pictures.emplace_back();
      if (result.bests[v]) bests_[v].emplace(setups.of(v), contest_.variants[v], *result.bests[v], executor);
    }
    page_.inputs = &setups.first().inputs;
  }

  std::vector<FolderFile> files() {
    std::vector<FolderFile> files;
    const auto text = [&](const char* name, std::string (*make)(const Contest&, const CompareResult&)) {
      files.emplace_back(name, [=, this](const std::string& path) { write_file(path, make(contest_, result_)); });
    };
    text(kCompareMarker, compare_json);
    text("summary.csv", compare_summary_csv);
    text("searches.csv", compare_searches_csv);
    text("reach.csv", compare_reach_csv);
    text("compare.csv", compare_csv);
    files.emplace_back("inputs", [this](const std::string& path) {
      page_.inputs->write(std::filesystem::path(path).parent_path().string());
    });
    for (std::size_t v = 0; v < bests_.size(); ++v) {
      if (bests_[v]) add_best(v, files);
    }
    files.emplace_back("compare.html", [this](const std::string& path) {
      for (std::size_t v = 0; v < bests_.size(); ++v) {
        if (bests_[v]) page_.settings[v] = bests_[v]->settings(), page_.pictures[v] = &bests_[v]->picture();
      }
      write_file(path, compare_page(contest_, result_, page_));
    });
    return files;
  }

 private:
  void add_best(std::size_t v, std::vector<FolderFile>& files) {
    const std::string& name = contest_.variants[v].name;
    BestFiles* const best = &*bests_[v];
    for (const char* ending : {".best.derivation.json", ".best.glb"})
      files.emplace_back(name + ending, [best](const std::string& path) { best->write(path); });
    files.emplace_back(name + ".toml", [best](const std::string& path) { write_file(path, best->settings()); });
    files.emplace_back(name + ".png", [best](const std::string& path) { best->write_picture(path); });
  }

  const Contest& contest_;
  const CompareResult& result_;
  std::vector<std::optional<BestFiles>> bests_;
  ComparePageParts page_;
};

}  // namespace

std::optional<CompareResult> compare_variants(const CompareRequest& request, MeshSource& source) {
  const Contest& contest = request.contest;
  if (contest.variants.size() > ContestSetups::kMostKept) {
    throw Error(fmt::format("compare takes at most {} variants, got {}; espalier sweep takes more",
                            ContestSetups::kMostKept, contest.variants.size()));
  }
  ContestObserver silent;
  ContestObserver& observer = request.observer ? *request.observer : silent;
  const std::unique_ptr<Executor> executor = make_tbb_executor(request.threads);
  ContestSetups setups(contest, source);
  Setup& first = setups.first();
  RunFolder folder(request.out, kCompareMarker);
  observer.started(contest_start("compare", request.contest, first, folder.path(), executor->workers()));
  CompareResult result;
  begin_result(contest, setups, folder.path(), executor->workers(), result);
  result.bests.resize(contest.variants.size());
  result.outcomes.assign(contest.variants.size(), std::vector<std::optional<ContestOutcome>>(contest.seeds.size()));
  for (const std::string& warning : result.warnings) observer.warning(warning);

  const ContestControl control = {request.slice_seconds, request.stop, &observer};
  const auto take = [&](ContestOutcome outcome) { take_outcome(contest, std::move(outcome), result); };
  result.interrupted = !run_contest(contest, setups, *executor, control, take);
  if (std::none_of(result.bests.begin(), result.bests.end(), [](const auto& best) { return best.has_value(); }))
    return std::nullopt;
  for (std::size_t v = 0; v < contest.variants.size(); ++v) {
    const std::string failures = failures_in_words(contest.variants[v].name, result.outcomes[v]);
    if (!failures.empty()) result.warnings.push_back(failures);
    result.failed += failed_of(result.outcomes[v]);
  }
  result.summary = summarise_contest(result.outcomes, contest.budget, request.marks);
  observer.writing();
  write_folder(folder, CompareFolder(request, result, setups, *executor).files());
  observer.written();
  return result;
}

std::string interruption_in_words(const Contest& contest, const CompareResult& result) {
  if (!result.interrupted) return "";
  const CompareSummary& summary = result.summary;
  if (summary.partial) {
    return fmt::format("no seed was completed: these are of seed {}, cut short after {}",
                       contest.seeds[summary.counted[0]], in_words(summary.effort, summary.marks.back().at));
  }
  return fmt::format("stopped by hand: these are of the {} of {} that all variants completed", summary.counted.size(),
                     counted(contest.seeds.size(), "seed"));
}

std::string told_apart_in_words(const Contest& contest, const CompareMark& mark) {
  if (mark.ranking.size() < 2) return "";
  const std::size_t seeds = mark.scores[0].count;
  if (least_chance(seeds, mark.ranking.size()) > kLikely)
    return fmt::format("; {} too few to tell it from chance",
                       seeds == 1 ? "one seed is" : fmt::format("{} seeds are", seeds));
  std::vector<std::string> names;
  for (const std::size_t v : mark.ranking) {
    if (v != mark.ranking[0] && mark.chance[v] > kLikely) names.push_back(contest.variants[v].name);
  }
  if (names.empty()) return fmt::format(", told apart from all others (p at most {})", kLikely);
  return fmt::format("; not told apart from it (p above {}): {}", kLikely, fmt::join(names, ", "));
}

}  // namespace espalier
