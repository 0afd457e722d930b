// espalier run: a scene, searched until its budget is spent or Ctrl-C.
#include "run/run.h"

#include <csignal>
#include <filesystem>
#include <iostream>

#include <unistd.h>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/verbs.h"
#include "io/mesh_import.h"
#include "run/scene_toml.h"

namespace espalier {
namespace {

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

// The first signal ends the search with the best so far; a second one has its usual effect.
extern "C" void request_stop(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

Scene load(const RunVerbOptions& options) {
  SceneOverrides overrides = {options.settings, options.attributes};
  if (options.engine) overrides.settings.push_back(fmt::format("search.engine=\"{}\"", *options.engine));
  if (options.seed) overrides.settings.push_back(fmt::format("seed={}", *options.seed));
  if (options.keep) overrides.settings.push_back(fmt::format("output.keep={}", *options.keep));
  if (options.threads) overrides.settings.push_back(fmt::format("threads={}", *options.threads));
  // A budget on the command line takes the place of the scene's, so that it alone ends the run.
  if (options.seconds || options.evaluations || options.generations) {
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

std::unique_ptr<RunObserver> make_observer(bool json) {
  if (json) return make_json_lines(std::cout);
  return isatty(STDOUT_FILENO) ? make_bar(std::cout) : make_lines(std::cout);
}

}  // namespace

int run_verb(const RunVerbOptions& options) {
  namespace fs = std::filesystem;
  const Scene scene = load(options);
  const std::unique_ptr<RunObserver> observer = make_observer(options.json);
  RunOptions run;
  run.out = options.out.empty() ? (fs::path("out") / fs::path(options.scene).stem()).string() : options.out;
  run.stop = &stop_requested;
  run.observer = observer.get();
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  AssimpMeshSource source;
  if (run_scene(scene, run, source)) return kDone;
  fmt::print(stderr, "espalier: interrupted before there was any result\n");
  return kDiffers;
}

}  // namespace espalier
