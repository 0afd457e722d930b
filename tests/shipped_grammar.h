#pragma once
// The grammars in grammars/, compiled for tests, with what they import.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "grammar/compiler.h"

namespace espalier::test {

inline std::filesystem::path grammar_folder() { return std::filesystem::path(ESPALIER_SOURCE_DIR) / "grammars"; }

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// File names, sorted; a test that finds none has failed.
inline std::vector<std::string> shipped_grammars() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(grammar_folder())) {
    if (entry.path().extension() == ".esp") names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_GE(names.size(), 17u) << "grammars are missing from " << grammar_folder();
  return names;
}

inline std::shared_ptr<const GeneratorGraph> compile_shipped(
    const std::string& name, const std::map<std::string, std::string>& attributes = {}) {
  const auto read = [](const std::string& path) { return text_of(grammar_folder() / path); };
  const CompileResult result = compile_grammar({name, text_of(grammar_folder() / name), attributes, read});
  EXPECT_TRUE(result.graph) << render(result.diagnostics, result.sources);
  EXPECT_TRUE(result.diagnostics.items().empty()) << render(result.diagnostics, result.sources);
  return result.graph;
}

}  // namespace espalier::test
