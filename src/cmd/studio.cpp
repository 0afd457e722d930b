// espalier studio: the local web editor's server, until Ctrl-C.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/interrupt.h"
#include "cmd/verbs.h"
#include "io/file.h"
#include "studio/project_file.h"
#include "studio/scene_project.h"
#include "studio/studio.h"
#include "studio/web_server.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// Where projects are kept unless --data says otherwise.
std::string standard_data() {
  const char* const data = std::getenv("XDG_DATA_HOME");
  const char* const home = std::getenv("HOME");
  if ((!data || !*data) && (!home || !*home)) throw Error("there is no HOME to keep projects in: name a file with --data");
  const fs::path folder = data && *data ? fs::path(data) / "espalier" : fs::path(home) / ".local/share/espalier";
  return (folder / "studio.sqlite").string();
}

/// The page beside the program.
std::string standard_page() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return (program.parent_path() / "studio-page").string();
}

/// Only the owner may look into a folder that is made.
void make_folder(const std::string& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  if (fs::exists(folder)) return;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("{}: cannot be made: {}", folder.string(), error.message()));
  chmod(folder.c_str(), 0700);
}

/// Shows the link in the desktop's browser, if there is one.
void open_browser(const std::string& link) {
  const char* const display = std::getenv("DISPLAY");
  const char* const wayland = std::getenv("WAYLAND_DISPLAY");
  if ((!display || !*display) && (!wayland || !*wayland)) return;
  std::string program = "xdg-open", argument = link;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  if (posix_spawnp(&child, program.c_str(), nullptr, nullptr, arguments, environ) == 0) {
    std::thread([child] { waitpid(child, nullptr, 0); }).detach();
  }
}

/// A project file, a scene or a grammar is taken in as a new project; anything else is the name of one.
std::int64_t project_of(studio::Studio& studio, const std::string& named) {
  if (named.ends_with(".espalier") || named.ends_with(".zip")) return studio.import(read_file(named, studio::kMostProjectFileBytes));
  const auto read = [](const std::string& path) { return read_file(path, studio::Store::kMostFileBytes); };
  const std::string name = fs::path(named).stem().string();
  if (named.ends_with(".toml")) return studio.add(name, studio::project_of_scene(named, read));
  if (named.ends_with(".esp")) return studio.add(name, studio::project_of_grammar(named, read));
  return studio.find_or_create(named);
}

}  // namespace

int studio_verb(const StudioOptions& options) {
  const std::string data = options.data.empty() ? standard_data() : options.data;
  make_folder(data);
  studio::Studio studio(data);
  std::string place;
  if (!options.project.empty()) place = fmt::format("&project={}", project_of(studio, options.project));
  studio::WebServerSettings settings;
  settings.port = options.port;
  settings.token = studio.token(options.new_token);
  settings.page_folder = options.page.empty() ? standard_page() : options.page;
  const std::atomic<bool>* const stop = stop_on_signals();
  const studio::WebServer server(settings, studio);
  const std::string link = fmt::format("http://127.0.0.1:{}/?token={}{}", server.port(), settings.token, place);
  fmt::print("Espalier studio: {}\nProjects are kept in {}. Ctrl-C ends the server.\n", link, data);
  std::fflush(stdout);
  if (options.open) open_browser(link);
  while (!*stop) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  // All that was answered is on disk; a search that does not end at once need not be waited for.
  std::thread([] {
    std::this_thread::sleep_for(std::chrono::seconds(5));
    _exit(kDone);
  }).detach();
  return kDone;
}

}  // namespace espalier
