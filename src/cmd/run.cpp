// espalier run: a scene, searched until its budget is spent or Ctrl-C.
#include "run/run.h"

#include <filesystem>
#include <iostream>

#include <unistd.h>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/interrupt.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/find_derivation.h"
#include "run/founders.h"
#include "run/scene_toml.h"
#include "run/toml_value.h"

namespace espalier {
namespace {

/// What is found behind a name that may be a run's folder or a model too.
std::string start_at(const std::string& from) {
  namespace fs = std::filesystem;
  return fs::absolute(from.ends_with(kManyDerivations) ? from : find_derivation(from)).string();
}

std::string list_of(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + quote_toml(text);
  return list;
}

SceneBudget budget_of(const RunVerbOptions& options) {
  return {options.seconds, options.evaluations, options.generations};
}

Scene load(const RunVerbOptions& options) {
  SceneOverrides overrides = {options.settings, options.attributes};
  const auto set = [&](const char* key, const std::string& value) {
    overrides.settings.push_back(fmt::format("{}={}", key, value));
  };
  if (options.engine) set("search.engine", quote_toml(*options.engine));
  if (options.seed) set("seed", fmt::format("{}", *options.seed));
  if (options.keep) set("output.keep", fmt::format("{}", *options.keep));
  if (options.threads) set("threads", fmt::format("{}", *options.threads));
  if (options.checkpoint_seconds) set("output.checkpoint_seconds", fmt::format("{}", *options.checkpoint_seconds));
  if (!options.from.empty()) set("start.derivation", quote_toml(start_at(options.from)));
  if (!options.locks.empty()) set("start.locks", fmt::format("[{}]", list_of(options.locks)));
  // A budget on the command line takes the place of the scene's, so that it alone ends the run.
  if (budget_of(options) != SceneBudget()) {
    std::string budget;
    const auto add = [&](const char* key, const auto& value) {
      if (value) budget += fmt::format("{}{} = {}", budget.empty() ? "" : ", ", key, *value);
    };
    add("seconds", options.seconds);
    add("evaluations", options.evaluations);
    add("generations", options.generations);
    overrides.settings.push_back(fmt::format("budget={{{}}}", budget));
  }
  return load_scene(options.scene, overrides);
}

ResumeRequest request_of(const RunVerbOptions& options) {
  const std::pair<bool, const char*> others[] = {
      {options.engine.has_value(), "--engine"}, {options.seed.has_value(), "--seed"},
      {options.keep.has_value(), "--keep"},     {!options.settings.empty(), "--set"},
      {!options.attributes.empty(), "-D"},      {!options.from.empty(), "--from"},
      {!options.locks.empty(), "--lock"}};
  for (const auto& [given, name] : others) {
    if (given) throw Error(fmt::format("{} does not go with --resume: that goes on with the same search", name));
  }
  // The rules that scenes and the parser have; but NaN is within any range of the latter.
  if (options.seconds && !(*options.seconds >= 1e-3 && *options.seconds <= 1e7)) {
    throw Error(fmt::format("--time must be a number from 0.001 to 1e7, got {}", *options.seconds));
  }
  const std::optional<double>& every = options.checkpoint_seconds;
  if (every && !(*every >= 1e-3 && *every <= 1e6)) {
    throw Error(fmt::format("--checkpoint-every must be a number from 0.001 to 1e6, got {}", *every));
  }
  if (options.evaluations == 0u || options.generations == 0u) {
    throw Error("--evaluations and --generations must be at least 1, got 0");
  }
  return {options.resume, budget_of(options), options.threads, options.checkpoint_seconds, options.force};
}

std::unique_ptr<RunObserver> make_observer(bool json) {
  if (json) return make_json_lines(std::cout);
  return isatty(STDOUT_FILENO) ? make_bar(std::cout) : make_lines(std::cout);
}

}  // namespace

int run_verb(const RunVerbOptions& options) {
  namespace fs = std::filesystem;
  const bool resumes = !options.resume.empty();
  if (resumes != options.scene.empty()) {
    throw Error("run takes a scene, or --resume with the folder of a run: one of them");
  }
  if (options.force && !resumes) throw Error("--force goes with --resume");
  const std::unique_ptr<RunObserver> observer = make_observer(options.json);
  RunOptions run;
  run.out = options.out;
  run.stop = stop_on_signals();
  run.observer = observer.get();
  AssimpMeshSource source;
  if (resumes) return resume_run(request_of(options), run, source) ? kDone : kDiffers;
  if (run.out.empty()) run.out = (fs::path("out") / fs::path(options.scene).stem()).string();
  if (run_scene(load(options), run, source)) return kDone;
  fmt::print(stderr, "espalier: interrupted before there was any result\n");
  return kDiffers;
}

}  // namespace espalier
