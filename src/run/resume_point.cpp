#include "run/resume_point.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "run/checkpoint_changes.h"
#include "run/run_folder.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPartial = ".partial-";
constexpr std::size_t kLetters = 6;  // that mkdtemp puts behind it

bool holds_checkpoint(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kCheckpointName, ignored);
}

/// Where "PATH.partial-XXXXXX" is cut to be PATH; 0: it is no such name.
std::size_t end_of_name(const std::string& path) {
  if (path.size() <= kPartial.size() + kLetters) return 0;
  const std::size_t end = path.size() - kPartial.size() - kLetters;
  return std::string_view(path).substr(end, kPartial.size()) == kPartial ? end : 0;
}

/// Those of a run's folder that hold checkpoints, sorted.
std::vector<std::string> partial_folders(const std::string& path) {
  std::vector<std::string> found;
  const fs::path parent = fs::path(path).parent_path();
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(parent.empty() ? "." : parent, ignored)) {
    const std::string name = (parent / entry.path().filename()).string();
    if (end_of_name(name) == path.size() && name.starts_with(path) && holds_checkpoint(name)) found.push_back(name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

Checkpoint checkpoint_in(const std::string& folder) {
  return read_checkpoint((fs::path(folder) / kCheckpointName).string());
}

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
bool same_search(const Checkpoint& a, const Checkpoint& b) {
  return a.inputs == b.inputs && setting_changes(scene_of(a), scene_of(b)).empty();
}

}  // namespace

ResumePoint find_resume_point(const std::string& named) {
  const std::string path = folder_path(named);
  if (const std::size_t end = end_of_name(path); end > 0 && fs::is_directory(path)) {
    if (holds_checkpoint(path)) return take_partial(path, path.substr(0, end));
    throw Error(fmt::format("{}: holds no checkpoint; runs keep them with --checkpoint-every", path));
  }
  const std::vector<std::string> partial = partial_folders(path);
  if (partial.size() > 1) fail_for_choice(path, partial);
  if (partial.empty()) {
    if (holds_checkpoint(path)) return {path, path, std::nullopt, checkpoint_in(path)};
    throw Error(fmt::format("{}: holds no checkpoint, nor does any {}{}*; runs keep them with --checkpoint-every",
                            path, path, kPartial));
  }
  ResumePoint left = take_partial(partial[0], path);
  if (!holds_checkpoint(path)) return left;
  // A finished run of that name too: what was left behind is its continuation, or the two have nothing to do with each
  // other. (What it was continued from is moved away under another name.)
  const Checkpoint finished = checkpoint_in(path);
  if (same_search(left.checkpoint, finished) && left.checkpoint.step >= finished.step) return left;
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

}  // namespace espalier
