#pragma once
// Store: all projects in one SQLite file. What a call has changed is on disk when it returns: a crash at any moment loses
// nothing that was answered. Safe to use from any thread; calls wait for each other.
//
// A project is a line of states, each after a step that undo can take back; texts and files are kept once by their
// content, however many states share them.

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studio/database.h"

namespace espalier::studio {

struct StoredProject {
  std::int64_t id = 0;
  std::string name;
  double changed = 0;  // seconds since 1970
};

struct StoredFile {
  std::string path;
  std::string hash;  // content_hash of its bytes
  std::uint64_t bytes = 0;
  std::uint64_t triangles = 0;  // 0: no mesh
  std::array<float, 3> size = {};  // of the box around a mesh

  bool operator==(const StoredFile&) const = default;
};

/// What undo brings back.
struct StoredState {
  std::string grammar = {};
  std::string scene = "{}";       // JSON
  std::vector<StoredFile> files = {};  // by path

  bool operator==(const StoredState&) const = default;
};

/// A step from one state to the next.
struct StoredStep {
  std::string label = {};
  std::string gesture = {};  // steps of one gesture in a row are one; empty: it stands alone
  bool search = false;  // the search began anew with it
  /// Derivations, where the step made another model. One that a search found since is known once undo leaves it.
  std::optional<std::string> model_before = {}, model_after = {};
};

struct StoredProjectState {
  StoredProject project;
  StoredState state;
  std::int64_t revision = 0;               // counts every change
  std::optional<std::string> undo, redo;   // labels
};

/// What undo or redo did: the step, and whether the model is to be that before it or after it.
struct StoredMove {
  StoredProjectState now;
  bool search = false;
  std::optional<std::string> model;
};

struct StoredFavourite {
  std::int64_t id = 0;
  double score = 0;
  std::int64_t genes = 0;
  std::string words;
  std::string derivation;  // JSON
  std::string picture = {};  // bytes of a PNG, JPEG or WebP; "": none
};

class Store {
 public:
  static constexpr int kMostSteps = 500;
  static constexpr std::size_t kMostProjects = 10'000;
  static constexpr std::size_t kMostFavourites = 1000;   // of a project
  static constexpr std::size_t kMostPictureBytes = 32u << 10;  // of a favourite
  static constexpr std::size_t kMostFiles = 200;         // of a project
  static constexpr std::uint64_t kMostFileBytes = 64u << 20;
  static constexpr std::uint64_t kMostProjectBytes = 512u << 20;  // of files that some state names
  static constexpr std::uint64_t kMostHistoryBytes = 128u << 20;  // of texts; older steps go first
  static constexpr int kVersion = 4;

  /// Opens or makes the file, which only its owner may then read; older versions of it are brought up to date, newer ones
  /// refused. Throws Error, also where another server has it open. All calls throw Error where the disk fails; then nothing was changed.
  explicit Store(const std::string& path);
  ~Store();

  std::vector<StoredProject> projects();
  std::int64_t create(const std::string& name, const StoredState& state, const std::map<std::string, std::string>& blobs);
  void rename(std::int64_t project, const std::string& name);
  std::int64_t duplicate(std::int64_t project);
  void remove(std::int64_t project);

  StoredProjectState open(std::int64_t project);
  /// The state is now this one. `blobs`: bytes by hash of files that are new.
  StoredProjectState edit(std::int64_t project, const StoredState& state, const StoredStep& step,
                          const std::map<std::string, std::string>& blobs = {});
  /// Nothing where there is nothing to take back, or to do again. `shown`: the model that was made since a step that
  /// knows only the one before it (a search); redo brings it back.
  std::optional<StoredMove> undo(std::int64_t project, const std::optional<std::string>& shown = {});
  std::optional<StoredMove> redo(std::int64_t project);
  std::string blob(std::int64_t project, const std::string& hash);

  /// The model that is shown, as JSON; "" where there is none yet. It is no step.
  std::string shown(std::int64_t project);
  void set_shown(std::int64_t project, const std::string& derivation);

  std::vector<StoredFavourite> favourites(std::int64_t project);
  std::int64_t add_favourite(std::int64_t project, const StoredFavourite& favourite);
  /// "" where it has none, or there is no such favourite.
  std::string favourite_picture(std::int64_t project, std::int64_t favourite);
  void remove_favourite(std::int64_t project, std::int64_t favourite);

  /// For tables of others (breeding_store.h), and for much that belongs together: nobody else has the database meanwhile.
  /// All of this class may be called within.
  void alone(const std::function<void(Database&)>& work);

  /// What belongs to no project, by its name.
  std::optional<std::string> setting(const std::string& name);
  void set_setting(const std::string& name, const std::string& value);

 private:
  struct Head {
    std::int64_t number = 0;  // of the state
    std::string grammar, scene, files, gesture;  // hashes
  };

  [[noreturn]] static void fail_no_project(std::int64_t project);
  void migrate();
  Head head(std::int64_t project);
  std::string text(std::int64_t project, const std::string& hash);
  std::string keep_text(std::int64_t project, const std::string& text);
  std::string keep_files(std::int64_t project, const std::vector<StoredFile>& files,
                         const std::map<std::string, std::string>& blobs);
  void forget_text(std::int64_t project, const std::string& hash);
  void forget_blobs(std::int64_t project);
  void trim(std::int64_t project);
  void touch(std::int64_t project, std::int64_t number);
  StoredProjectState read(std::int64_t project);
  std::optional<StoredMove> move(std::int64_t project, bool back, const std::optional<std::string>& shown);
  std::string free_name(const std::string& name);

  std::recursive_mutex mutex_;  // reading or writing much at once is made of reading and writing little
  int lock_file_ = -1;
  std::optional<Database> database_;
};

/// As a state has them.
void sort_by_path(std::vector<StoredFile>& files);
/// The list of a state's files as text, and back. Throws Error.
std::string to_json(const std::vector<StoredFile>& files);
std::vector<StoredFile> parse_files(std::string_view json);

}  // namespace espalier::studio
