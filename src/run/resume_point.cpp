#include "run/resume_point.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "run/checkpoint_changes.h"
#include "run/results.h"
#include "run/run_folder.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartial = ".partial-", kReplaced = ".replaced-";
constexpr std::size_t kLetters = 6;  // that mkdtemp puts behind it

bool holds_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kCheckpointName, ignored);
}

/// Where "PATH.partial-XXXXXX" is cut to be PATH; 0: it is no such name.
std::size_t end_of_name(std::string_view path, std::string_view what = kPartial) {
  if (path.size() <= what.size() + kLetters) return 0;
  const std::size_t end = path.size() - what.size() - kLetters;
  return path.substr(end, what.size()) == what ? end : 0;
}

/// Those of a run's folder that hold a file of that name, sorted.
std::vector<std::string> siblings(const std::string& path, std::string_view what, const char* file) {
  std::vector<std::string> found;
  const fs::path parent = fs::path(path).parent_path();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(parent.empty() ? "." : parent, ignored)) {
    const fs::path folder = parent / entry.path().filename();
    const std::string name = folder.string();
    if (end_of_name(name, what) != path.size() || !name.starts_with(path)) continue;
    if (fs::is_regular_file(folder / file, ignored)) found.push_back(name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> partial_folders(const std::string& path) { return siblings(path, kPartial, kCheckpointName); }

std::string file_in(const std::string& folder) { return (fs::path(folder) / kCheckpointName).string(); }

Checkpoint checkpoint_in(const std::string& folder) { return read_checkpoint(file_in(folder)); }

ResumePoint take_partial(const std::string& folder, const std::string& path) {
  std::optional<FolderLock> lock = FolderLock::take(folder);
  if (!lock) throw Error(fmt::format("{}: {} is still at work in it", folder, FolderLock::holder(folder)));
  return {folder, path, std::move(lock), checkpoint_in(folder)};
}

/// "out/ship.partial-Ab12Cd (step 120)", or why there is none to be told.
std::string with_step(const std::string& folder) {
  try {
    return fmt::format("{} (step {})", folder, checkpoint_in(folder).step);
  } catch (const Error&) {
    return folder + " (damaged)";
  }
}

[[noreturn]] void fail_for_choice(const std::string& path, const std::vector<std::string>& folders) {
  std::string list;
  for (const std::string& folder : folders) list += "\n  " + with_step(folder);
  throw Error(fmt::format("{}: there is more than one run to continue; name one of them:{}", path, list));
}

/// Whether one may be what the other became.
bool same_search(const ResumePoint& left, const Checkpoint& finished) {
  const Checkpoint& c = left.checkpoint;
  return c.inputs == finished.inputs &&
         setting_changes(scene_of(c, file_in(left.folder)), scene_of(finished, file_in(left.path))).empty();
}

/// With "." and ".." as the folders that they are: those have names of their own.
std::string path_of(const std::string& named) {
  const fs::path path(named), last = path.has_filename() ? path.filename() : path.parent_path().filename();
  std::error_code error;
  const fs::path real = last == "." || last == ".." ? fs::canonical(path, error) : path;
  return folder_path(error ? named : real.string(), "--resume");
}

}  // namespace

ResumePoint find_resume_point(const std::string& named) {
  const std::string path = path_of(named);
  if (const std::size_t end = end_of_name(path); end > 0 && fs::is_directory(path)) {
    if (holds_checkpoint(path)) return take_partial(path, path.substr(0, end));
    throw Error(fmt::format("{}: holds no checkpoint; runs keep them with --checkpoint-every", path));
  }
  const std::vector<std::string> partial = partial_folders(path);
  if (partial.size() > 1) fail_for_choice(path, partial);
  if (partial.empty()) {
    if (holds_checkpoint(path)) return {path, path, std::nullopt, checkpoint_in(path)};
    const std::vector<std::string> aside = siblings(path, kReplaced, kRunMarker);
    const std::string hint = aside.empty() ? "" : "\nAn earlier run of that name is in " + aside[0];
    throw Error(fmt::format("{}: holds no checkpoint, nor does any {}{}*; runs keep them with --checkpoint-every{}",
                            path, path, kPartial, hint));
  }
  ResumePoint left = take_partial(partial[0], path);
  if (!holds_checkpoint(path)) return left;
  // A finished run of that name too: what was left behind is its continuation, or the two have nothing to do with each
  // other. (What it was continued from is moved away under another name.)
  const Checkpoint finished = checkpoint_in(path);
  if (same_search(left, finished) && left.checkpoint.step >= finished.step) return left;
  throw Error(fmt::format("{}: is a finished run (step {}), and {} was left behind by another: name that to continue "
                          "it, or remove it to continue the finished one", path, finished.step, with_step(partial[0])));
}

std::vector<std::string> left_behind(const std::string& path) {
  std::vector<std::string> found;
  for (const std::string& folder : partial_folders(folder_path(path))) {
    try {
      if (FolderLock::take(folder)) found.push_back(with_step(folder));
    } catch (const Error&) {  // not ours to write: nor to continue
    }
  }
  return found;
}

std::vector<std::string> moved_aside(const std::string& path) {
  return siblings(folder_path(path), kReplaced, kRunMarker);
}

}  // namespace espalier
