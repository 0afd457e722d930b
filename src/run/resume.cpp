// Going on from checkpoints.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/printable.h"
#include "io/file.h"
#include "run/checkpoint_changes.h"
#include "run/founders.h"
#include "run/partial_folder.h"
#include "run/results.h"
#include "run/resume_point.h"
#include "run/run_job.h"
#include "run/scene_toml.h"
#include "run/temporary_folder.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

bool is_given(const SceneBudget& budget) { return budget.seconds || budget.evaluations || budget.generations; }

/// The scene of the folder as it lies there, with what was asked for.
Scene scene_in(const ResumePoint& point, const ResumeRequest& request) {
  Scene scene = load_scene((fs::path(point.folder) / kRunMarker).string());
  const Checkpoint& c = point.checkpoint;
  scene.threads = request.threads.value_or(c.threads);
  scene.refresh_seconds = c.refresh_seconds;
  scene.checkpoint_seconds = request.checkpoint_seconds.value_or(c.checkpoint_seconds);
  if (!(scene.checkpoint_seconds > 0)) {  // a run that goes on without keeping any would lose the one that there is
    throw Error(fmt::format("seconds between checkpoints must be above 0, got {}", scene.checkpoint_seconds));
  }
  if (is_given(request.budget)) scene.budget = request.budget;
  return scene;
}

/// A finished run whose budget is spent has nothing to go on for.
void expect_budget_left(const ResumePoint& point, const SceneBudget& budget) {
  if (!point.finished()) return;
  const Checkpoint& c = point.checkpoint;
  std::string spent;
  if (budget.generations && c.step >= *budget.generations) {
    spent = fmt::format("{} of {} generations are done", c.step, *budget.generations);
  } else if (budget.evaluations && c.evaluations >= *budget.evaluations) {
    spent = fmt::format("{} of {} evaluations are done", c.evaluations, *budget.evaluations);
  } else if (budget.seconds && c.seconds >= *budget.seconds) {
    spent = fmt::format("{:.1f} of {:g} seconds are over", c.seconds, *budget.seconds);
  }
  if (spent.empty()) return;
  throw Error(fmt::format("{}: is a finished run: {}. Give it more in all with --time, --evaluations or --generations",
                          point.folder, spent));
}

/// The lines of an error that may repeat bytes of the checkpoint.
std::string told_safely(const Error& error) { return printable(error.what(), true); }

class Resumption {
 public:
  Resumption(const ResumeRequest& request, const RunOptions& options, MeshSource& source)
      : request_(request), options_(options), source_(source), point_(find_resume_point(request.folder)),
        path_(options.out.empty() ? point_.path : folder_path(options.out)), scene_(scene_in(point_, request)) {}

  bool run() {
    std::vector<std::string> changes = folder_changes(point_.folder, scene_, point_.checkpoint);
    if (!changes.empty()) return run_changed(changes);
    expect_budget_left(point_, scene_.budget);
    executor_ = make_tbb_executor(scene_.threads);
    const std::unique_ptr<Setup> setup = set_up(scene_, source_);
    changes = input_changes(setup->inputs.hashes(), point_.checkpoint.inputs);
    if (!changes.empty()) return run_changed(changes);
    SearchSession session(*setup, *executor_);
    try {
      std::istringstream state(point_.checkpoint.state);
      session.load(state);
    } catch (const Error& error) {
      return run_changed({told_safely(error)});
    }
    return go_on(*setup, session);
  }

 private:
  /// In the folder that was left behind, if the results are to take its place.
  bool go_on(const Setup& setup, SearchSession& session) {
    const std::string from = point_.folder;
    const bool adopted = point_.lock && path_ == point_.path;
    // First of all: where the path cannot be taken, nothing is touched.
    RunFolder folder =
        adopted ? RunFolder(path_, kRunMarker, from, std::move(*point_.lock)) : RunFolder(path_, kRunMarker);
    std::vector<std::string> notes;
    std::optional<PartialFolder> partial;
    if (!point_.finished()) partial.emplace(from, point_.checkpoint.inputs);
    if (partial) warn_of_foreign(*partial, adopted, notes);
    warn_of_moved(path_, notes);
    if (adopted) partial->tidy();
    const bool done = do_run({setup, folder, *executor_, session, observer_of(options_), options_.stop, from, notes});
    if (done && partial && !adopted) partial->remove();
    return done;
  }

  void warn_of_foreign(const PartialFolder& partial, bool adopted, std::vector<std::string>& warnings) const {
    if (partial.foreign().empty()) return;
    warnings.push_back(fmt::format("{} holds what no run wrote, {} in all: {}; {}", point_.folder,
                                   partial.foreign().size(), printable(partial.foreign().front()),
                                   adopted ? "it comes along into " + path_ : "it stays there"));
  }

  bool run_changed(const std::vector<std::string>& changes) {
    std::string list;
    for (const std::string& change : changes) list += "\n  " + change;
    if (!request_.force) {
      const std::string& models = point_.checkpoint.population;
      throw Error(fmt::format("{}: the search cannot go on as it was:{}\n--force begins a new one with the best {} of "
                              "its models", point_.folder, list, std::count(models.begin(), models.end(), '\n')));
    }
    const TemporaryFolder temporary;
    return begin_anew(temporary, list);
  }

  bool begin_anew(const TemporaryFolder& temporary, const std::string& changes) {
    const std::string grammar = (fs::path(scene_.folder) / scene_.grammar).string();
    const LoadedGrammar loaded = load_grammar(grammar, scene_.attributes);
    const std::string models = adapted_lines(*loaded.graph, point_.checkpoint.population);
    if (models.empty()) throw Error(fmt::format("{}: none of the checkpoint's models can stand in it", grammar));
    scene_.start.derivation = temporary.file("population" + std::string(kManyDerivations));
    write_file(scene_.start.derivation, models);
    executor_ = make_tbb_executor(scene_.threads);
    const std::unique_ptr<Setup> setup = set_up(scene_, source_);
    setup->warnings.push_back(fmt::format("this is a new search, from step 1 on, that begins with {} models of {} "
                                          "(step {}). What has changed:{}", setup->founders.size(), point_.folder,
                                          point_.checkpoint.step, changes));
    RunFolder folder(path_, kRunMarker);
    SearchSession session(*setup, *executor_);
    return do_run({*setup, folder, *executor_, session, observer_of(options_), options_.stop});
  }

  RunObserver& observer_of(const RunOptions& options) { return options.observer ? *options.observer : silent_; }

  const ResumeRequest& request_;
  const RunOptions& options_;
  MeshSource& source_;
  ResumePoint point_;
  std::string path_;
  Scene scene_;
  std::unique_ptr<Executor> executor_;
  RunObserver silent_;
};

}  // namespace

bool resume_run(const ResumeRequest& request, const RunOptions& options, MeshSource& source) {
  return Resumption(request, options, source).run();
}

}  // namespace espalier
