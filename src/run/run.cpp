#include "run/run_job.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "run/checkpoint_writer.h"
#include "run/live_report.h"
#include "run/probes.h"
#include "run/resume_point.h"
#include "run/results.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

RunStart start_of(const RunJob& job) {
  const Setup& setup = job.setup;
  RunStart start;
  start.grammar = setup.graph().name;
  start.engine = name_of(setup.scene.search.engine);
  start.out = job.folder.path();
  start.seed = setup.scene.seed;
  start.optimum = setup.objective.optimum();
  start.budget = setup.scene.budget;
  start.threads = job.executor.workers();
  start.voxels = setup.volume ? setup.volume->grid().cell_count() : 0;
  for (const SilhouetteTarget* target : setup.silhouettes)
    start.pixels += std::uint64_t{target->settings().image.width} * target->settings().image.height;
  start.refresh_seconds = setup.scene.refresh_seconds;
  if (start.refresh_seconds > 0) start.live = (fs::path(job.folder.staging()) / "report.html").string();
  start.resumed_from = job.session.last().step;
  start.resumed_folder = job.resumed_folder;
  return start;
}

// Tries every file, so that a disk that is nearly full still takes the small ones. Returns the first error's message.
std::string write_all(ResultWriter& writer, const std::string& folder) {
  std::string first_error;
  for (const std::string& name : writer.names()) {
    try {
      writer.write(name, (fs::path(folder) / name).string());
    } catch (const Error& error) {
      if (first_error.empty()) first_error = error.what();
    }
  }
  return first_error;
}

void finish(RunFolder& folder, const std::string& problem) {
  if (problem.empty()) return folder.commit();
  if (!fs::exists(fs::path(folder.staging()) / "best.derivation.json")) throw Error(problem);
  folder.keep();
  throw Error(fmt::format("{}\nThe results are incomplete; what could be written is kept in {}", problem,
                          folder.staging()));
}

RunEnd end_of(const SearchResult& result, const Setup& setup, const RunFolder& folder) {
  RunEnd end;
  end.folder = folder.path();
  std::vector<std::string> names = {"report.html", "best.glb", "best.obj", "best.png"};
  for (const std::string& name : outcome_names(setup)) names.push_back(name);
  names.insert(names.end(), {"alternatives.png", "result.json"});
  for (const std::string& name : names) end.files.push_back((fs::path(folder.path()) / name).string());
  end.score = result.best.score;
  end.optimum = result.explanation.optimum;
  end.percent = result.explanation.percent;
  end.words = result.explanation.words;
  end.alternatives = result.alternatives.size();
  end.spread = result.spread;
  end.steps = result.steps;
  end.evaluations = result.evaluations;
  end.seconds = result.seconds;
  end.stopped_by = result.stopped_by;
  return end;
}

}  // namespace

bool do_run(const RunJob& job) {
  const Setup& setup = job.setup;
  const Scene& scene = setup.scene;
  job.observer.started(start_of(job));
  for (const auto* warnings : {&setup.warnings, &job.notes})
    for (const std::string& warning : *warnings) job.observer.warning(warning);

  SearchControl control;
  control.budget = scene.budget;
  control.stop = job.stop;
  control.observer = &job.observer;
  std::optional<LiveReport> live;
  if (scene.refresh_seconds > 0) {
    live.emplace(setup, settings_text(setup), job.folder.staging(), job.folder.path(), scene.refresh_seconds);
    live->continue_with(job.session.log());
    control.watcher = &*live;
  }
  std::optional<CheckpointWriter> keeper;
  if (scene.checkpoint_seconds > 0) {
    keeper.emplace(job.folder, job.observer, settings_text(setup), scene.checkpoint_seconds,
                   job.session.last().seconds);
    control.keeper = &*keeper;
  }
  const std::optional<SearchResult> result = run_search(job.session, control);
  if (const std::string problem = live ? live->end() : ""; !problem.empty()) {
    job.observer.warning("the report could not be refreshed: " + problem);
  }
  if (!result) return false;

  job.observer.writing();
  ResultWriter writer(setup, *result, job.executor);
  finish(job.folder, write_all(writer, job.folder.staging()));
  job.observer.finished(end_of(*result, setup, job.folder));
  return true;
}

void warn_of_moved(const std::string& path, std::vector<std::string>& warnings) {
  for (const std::string& moved : moved_aside(path)) {
    warnings.push_back(fmt::format("{} is an earlier run of that name, which another was to replace when it was "
                                   "killed; delete it, or give it a name", moved));
  }
}

bool run_scene(const Scene& scene, const RunOptions& options, MeshSource& source) {
  RunObserver silent;
  RunObserver& observer = options.observer ? *options.observer : silent;
  const std::unique_ptr<Executor> executor = make_tbb_executor(scene.threads);
  const std::unique_ptr<Setup> setup = set_up(scene, source);
  // Before the search, so that an unusable folder costs no search.
  RunFolder folder(options.out, kRunMarker);
  for (std::string& warning : warn_of_reach(*setup, find_reach(*setup))) setup->warnings.push_back(std::move(warning));
  std::vector<std::string> notes;
  for (const std::string& left : left_behind(options.out)) {
    notes.push_back(fmt::format("an interrupted run left {} behind; `espalier run --resume` continues it", left));
  }
  warn_of_moved(options.out, notes);
  SearchSession session(*setup, *executor);
  return do_run({*setup, folder, *executor, session, observer, options.stop, "", notes});
}

}  // namespace espalier
