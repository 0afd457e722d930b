#pragma once
// Workbench: a private folder in which the files of one project lie as the readers of scenes and grammars want them, and
// the way from a project's state to a Setup there. Of one thread at a time.

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/error.h"
#include "io/mesh_import.h"
#include "run/setup.h"
#include "run/temporary_folder.h"
#include "studio/scene_json.h"
#include "studio/store.h"

namespace espalier::studio {

/// The bytes of a project's file by their hash. Throws Error.
using ReadBlob = std::function<std::string(const std::string& hash)>;

/// Imports of a grammar: the project's own .esp files first, then those that come along.
ReadImport import_reader(const std::vector<StoredFile>& files, ReadBlob read_blob);

inline constexpr const char* kGrammarName = "grammar.esp";

/// The grammar has errors: the checker tells of them.
class GrammarFault : public Error {
 public:
  GrammarFault() : Error("the grammar has errors") {}
};

/// What a search starts from, as JSON; and which of its genes stay.
struct StartModel {
  std::string derivation;
  std::vector<std::string> locks;
};

class Workbench {
 public:
  explicit Workbench(ReadBlob read_blob);
  ~Workbench();

  /// The state becomes what setups are made of: its files are written, its grammar is compiled, where they changed.
  /// Throws Error for a grammar or a scene that is not right; then the state before stays.
  void take(const StoredState& state);
  bool ready() const { return grammar_.graph != nullptr; }

  const LoadedGrammar& grammar() const { return grammar_; }
  const ReadScene& scene() const { return scene_; }
  /// Counts the grammars that were compiled: another number may mean other meshes.
  std::uint32_t grammar_number() const { return grammar_number_; }

  /// The text with the files of the project called as it calls them: the folder that they are put into for now says
  /// nothing to people.
  std::string as_named(std::string text) const;

  /// The state made ready to run, with the scene's seed or another. Throws Error. Only when ready.
  std::shared_ptr<const Setup> set_up(const std::optional<StartModel>& start, std::optional<std::uint64_t> seed = {});

 private:
  class Meshes;

  void place_files(const StoredState& state);
  LoadedGrammar compile(const StoredState& state);

  TemporaryFolder folder_;
  std::string real_folder_;  // the same without links
  ReadBlob read_blob_;
  std::unique_ptr<Meshes> meshes_;
  std::map<std::string, std::string> placed_;  // hash by path
  std::string compiled_text_;                  // of the grammar, ...
  std::map<std::string, std::string> compiled_attributes_;
  std::map<std::string, std::string> compiled_files_;
  std::map<std::string, Kind> kinds_;
  LoadedGrammar grammar_;
  std::uint32_t grammar_number_ = 0;
  ReadScene scene_;
  std::shared_ptr<const Setup> probed_;  // the last whose stage came from probes
};

}  // namespace espalier::studio
