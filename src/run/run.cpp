#include "run/run.h"

#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "run/live_report.h"
#include "run/probes.h"
#include "run/results.h"
#include "run/run_folder.h"
#include "run/search_loop.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

RunStart start_of(const Setup& setup, const RunOptions& options, const RunFolder& folder, const Executor& executor) {
  RunStart start;
  start.grammar = setup.graph().name;
  start.engine = name_of(setup.scene.search.engine);
  start.out = options.out;
  start.seed = setup.scene.seed;
  start.optimum = setup.objective.optimum();
  start.budget = setup.scene.budget;
  start.threads = executor.workers();
  start.voxels = setup.volume ? setup.volume->grid().cell_count() : 0;
  for (const SilhouetteTarget* target : setup.silhouettes)
    start.pixels += std::uint64_t{target->settings().image.width} * target->settings().image.height;
  start.refresh_seconds = setup.scene.refresh_seconds;
  if (start.refresh_seconds > 0) start.live = (fs::path(folder.staging()) / "report.html").string();
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

bool run_scene(const Scene& scene, const RunOptions& options, MeshSource& source) {
  RunObserver silent;
  RunObserver& observer = options.observer ? *options.observer : silent;
  const std::unique_ptr<Executor> executor = make_tbb_executor(scene.threads);
  const std::unique_ptr<Setup> setup = set_up(scene, source);
  // Before the search, so that an unusable folder costs no search.
  RunFolder folder(options.out, kRunMarker);
  observer.started(start_of(*setup, options, folder, *executor));
  for (const std::string& warning : setup->warnings) observer.warning(warning);
  for (const std::string& warning : warn_of_reach(*setup, find_reach(*setup))) observer.warning(warning);

  SearchControl control;
  control.budget = scene.budget;
  control.stop = options.stop;
  control.observer = &observer;
  std::optional<LiveReport> live;
  if (scene.refresh_seconds > 0) {
    live.emplace(*setup, settings_text(*setup), folder.staging(), folder.path(), scene.refresh_seconds);
    control.watcher = &*live;
  }
  const std::optional<SearchResult> result = run_search(*setup, control, *executor);
  if (const std::string problem = live ? live->end() : ""; !problem.empty()) {
    observer.warning("the report could not be refreshed: " + problem);
  }
  if (!result) return false;

  observer.writing();
  ResultWriter writer(*setup, *result, *executor);
  finish(folder, write_all(writer, folder.staging()));
  observer.finished(end_of(*result, *setup, folder));
  return true;
}

}  // namespace espalier
