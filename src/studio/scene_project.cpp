#include "studio/scene_project.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "studio/file_kind.h"
#include "studio/scene_json.h"
#include "studio/web_guard.h"
#include "studio/workbench.h"

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTextBytes = 1'000'000;  // of a grammar or a scene, as edits of pages have them

constexpr const char* kEmptyGrammar = R"(grammar sketch 1
# A stem that bends and forks.
attr forks in 1..12 by 1 = 6 "Plant/Forks at most"
material wood = surface("#8a6a4f", roughness: 0.9)
start Plant

rule Plant { spawn Stem }

rule Stem when depth(Stem) < forks {
  spin ~ angle()
  bend ~ uniform(0deg, 40deg)
  turn y spin  turn x bend  scale 0.85
  bone (0, 0, 0) -> (0, 1, 0)
  { move y 0.5  size (0.16, 1, 0.16)  paint wood  emit cylinder(sides: 12) }
  move y 1
  spawn Stem
  maybe 0.5 spawn Stem
}
)";

/// Curves are followed by the guided engine; models it grows may be large.
constexpr const char* kGuidedScene = R"({"seed":1,"search":{"engine":"guided"},"limits":{"genes":{"min":1,"max":2000}}})";
constexpr const char* kPlainScene =
    R"({"seed":1,"search":{"engine":"ga"},"engine":{"ga":{"preset":"ga-local"}},"limits":{"genes":{"min":1,"max":400}}})";

bool draws_bones(std::string_view grammar) { return grammar.find("bone ") != std::string_view::npos; }

std::string read_text(const std::string& path, const ReadPath& read) {
  std::string text = read(path);
  if (text.size() > kMostTextBytes) throw Error(fmt::format("{}: must have at most {} bytes", path, kMostTextBytes));
  try {  // messages to pages are JSON
    nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception&) {
    throw Error(fmt::format("{}: must be UTF-8", path));
  }
  return text;
}

/// A file name of plain letters: "bäume.obj" -> "b--ume.obj".
std::string plain_name(const fs::path& path) {
  std::string name = path.filename().string();
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_plain_path(name.substr(i, 1)) && (i == 0 || !is_plain_path("a" + name.substr(i, 1)))) name[i] = '-';
  }
  return name.size() > 100 ? name.substr(name.size() - 100) : name;
}

/// Gathers the files of a project. Paths are as the grammar's and the scene's are; names are the project's.
class Gathering {
 public:
  Gathering(NewProject& project, const ReadPath& read, fs::path root)
      : project_(project), read_(read), root_(std::move(root)) {}

  /// The name of a file in the project, which takes it in when it is named first. `wanted`: where it may stay if plain.
  std::string add(const fs::path& path, const std::string& wanted) {
    const std::string key = path.lexically_normal().generic_string();
    if (const auto known = names_.find(key); known != names_.end()) return known->second;
    const std::string name = free_name(is_plain_path(wanted) ? wanted : plain_name(path));
    names_[key] = name;
    take_in(name, path, read_(key));
    return name;
  }

  /// The text of a grammar with the files that it names called as the project calls them. `own`: its name there.
  std::string adopt(const std::string& text, const fs::path& path, const std::string& own) {
    std::string adopted;
    std::size_t copied = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text[at] == '#') at = std::min(text.find('\n', at), text.size());
      if (at >= text.size() || text[at] != '"') continue;
      const std::size_t end = text.find_first_of("\"\n", at + 1);
      if (end == std::string::npos || text[end] != '"') break;  // the checker will say so
      const std::string named = text.substr(at + 1, end - at - 1);
      if (file_kind(named) != FileKind::other) {
        adopted += text.substr(copied, at + 1 - copied) + name_of(named, path, own);
        copied = end;
      }
      at = end;
    }
    return adopted + text.substr(copied);
  }

 private:
  /// What a grammar shall say for the file that it calls `named`: meshes and images are seen from where the first grammar
  /// lies, imports from the file that has them.
  std::string name_of(const std::string& named, const fs::path& path, const std::string& own) {
    if (file_kind(named) != FileKind::grammar) {
      return add(root_ / named, fs::path(named).lexically_normal().generic_string());
    }
    const fs::path file = (path.parent_path() / named).lexically_normal();
    const std::string wanted = file.lexically_relative(root_.lexically_normal()).generic_string();
    if (const auto shipped = find_shipped("grammars/" + wanted); shipped && *shipped == read_(file.generic_string())) return named;
    return fs::path(add(file, wanted)).lexically_relative(fs::path(own).parent_path()).generic_string();
  }

  void take_in(const std::string& name, const fs::path& path, std::string bytes) {
    if (file_kind(name) == FileKind::grammar) bytes = adopt(bytes, path, name);
    project_.state.files.push_back(describe_file(name, bytes));
    project_.blobs[project_.state.files.back().hash] = std::move(bytes);
  }

  /// "a.obj", or "a-2.obj" where there is one.
  std::string free_name(const std::string& name) {
    std::string free = name;
    const fs::path path(name);
    for (int n = 2; !taken_.insert(free).second; ++n) {
      free = (path.parent_path() / fmt::format("{}-{}{}", path.stem().string(), n, path.extension().string())).generic_string();
    }
    return free;
  }

  NewProject& project_;
  const ReadPath& read_;
  const fs::path root_;  // the folder of the grammar
  std::map<std::string, std::string> names_;  // by path
  std::set<std::string> taken_{kGrammarName};
};

}  // namespace

NewProject project_of_grammar(const std::string& path, const ReadPath& read) {
  NewProject project;
  Gathering gathering(project, read, fs::path(path).parent_path());
  project.state.grammar = gathering.adopt(read_text(path, read), path, kGrammarName);
  project.state.scene = draws_bones(project.state.grammar) ? kGuidedScene : kPlainScene;
  sort_by_path(project.state.files);
  return project;
}

NewProject project_of_scene(const std::string& path, const ReadPath& read) {
  const std::string toml = read_text(path, read);
  const fs::path folder = fs::path(path).parent_path();
  const fs::path grammar = (folder / grammar_of(toml, path)).lexically_normal();
  NewProject project;
  Gathering gathering(project, read, grammar.parent_path());
  project.state.grammar = gathering.adopt(read_text(grammar.generic_string(), read), grammar, kGrammarName);
  const std::string json = scene_json(toml, path);
  std::map<std::string, std::string> names;
  for (const std::string& file : files_of(json)) {
    if (file_kind(file) == FileKind::other) throw Error(fmt::format("{}: {} is neither a mesh nor an image", path, file));
    names[file] = gathering.add(folder / file, fs::path(file).filename().string());
  }
  project.state.scene = with_files(json, names);
  sort_by_path(project.state.files);
  return project;
}

NewProject make_empty_project() { return {{kEmptyGrammar, kGuidedScene, {}}, {}}; }

}  // namespace espalier::studio
