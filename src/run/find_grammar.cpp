#include "run/find_grammar.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "io/file.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

/// What a derivation says of its grammar.
struct GrammarName {
  std::string name, hash;
};

GrammarName named_by(const std::string& path) {
  const nlohmann::json document = nlohmann::json::parse(read_file(path), nullptr, false);
  GrammarName named;
  if (document.is_object()) {
    const auto text = [&](const char* member) {
      const auto it = document.find(member);
      return it != document.end() && it->is_string() ? it->get<std::string>() : "";
    };
    named = {text("grammar"), text("grammar_hash")};
  }
  const auto in_names = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (named.name.empty() || named.hash.empty() || !std::all_of(named.name.begin(), named.name.end(), in_names))
    throw Error(fmt::format("{}: does not say which grammar it belongs to; name it with --grammar", path));
  return named;
}

std::vector<fs::path> places_of(const std::string& name, const fs::path& folder) {
  std::string dashed = name;
  std::replace(dashed.begin(), dashed.end(), '_', '-');
  std::vector<fs::path> places;
  std::vector<fs::path> folders = {folder};
  if (folder.has_parent_path() && folder.parent_path() != folder) folders.push_back(folder.parent_path());
  for (const fs::path& one : folders) {
    places.push_back(one / (name + ".esp"));
    if (dashed != name) places.push_back(one / (dashed + ".esp"));
  }
  return places;
}

}  // namespace

LoadedGrammar find_grammar(const std::string& path, const std::map<std::string, std::string>& made_with,
                           const std::map<std::string, std::string>& attributes, const std::string& missing) {
  const GrammarName named = named_by(path);
  std::map<std::string, std::string> wanted = attributes;
  wanted.insert(made_with.begin(), made_with.end());
  std::string looked = missing;
  for (const fs::path& place : places_of(named.name, fs::absolute(path).lexically_normal().parent_path())) {
    std::error_code ignored;
    const bool there = fs::is_regular_file(place, ignored);
    const auto fits = [&](const std::map<std::string, std::string>& set) {
      const CompileResult found = compile_grammar_file(place.string(), set);
      return found.graph && found.graph->source_hash == named.hash;
    };
    if (there && (fits(made_with) || fits(wanted))) return load_grammar(place.string(), wanted);
    looked += fmt::format("{}{}{}", looked.empty() ? "" : ", ", place.string(), there ? " (another text)" : "");
  }
  throw Error(fmt::format("{}: its grammar, {} with the hash {}, was not found; looked for {}; name it with --grammar",
                          path, named.name, named.hash, looked));
}

}  // namespace espalier
