// Every grammar of the corpus: those in pass/ check, those in fail/ do not, and each gives exactly the diagnostics that
// its
// `#! CODE LINE:COLUMN` comments announce, warnings included.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "grammar/checker.h"
#include "base/error.h"
#include "grammar/imports.h"

namespace espalier {
namespace {

namespace fs = std::filesystem;

const fs::path kGrammarTests = fs::path(ESPALIER_SOURCE_DIR) / "tests" / "grammar";

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<fs::path> grammars(const std::string& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(kGrammarTests / "corpus" / folder))
    if (entry.path().extension() == ".esp") paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::multiset<std::string> announced(const std::string& source) {
  std::multiset<std::string> result;
  std::istringstream lines(source);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("#! ")) result.insert(line.substr(3));
  return result;
}

struct Outcome {
  bool accepted;
  std::multiset<std::string> found;
  std::string text;
};

Outcome outcome_of(const fs::path& path, const std::string& source) {
  Diagnostics diagnostics;
  std::vector<SourceText> sources{{path.filename().string(), source}};
  const auto read_import = [&](const std::string& name) {
    const fs::path file = path.parent_path() / name;
    if (!fs::exists(file)) throw Error("no such file");
    return read(file);
  };
  ast::Grammar grammar = parse_with_imports(sources, read_import, diagnostics);
  const bool accepted = check(std::move(grammar), {}, diagnostics).has_value();
  Outcome outcome{accepted, {}, render(diagnostics, sources)};
  for (const Diagnostic& d : diagnostics.items())
    outcome.found.insert(d.span.file == 0
                             ? fmt::format("{} {}:{}", d.code, d.span.line, d.span.column)
                             : fmt::format("{} {} {}:{}", d.code, sources[d.span.file].name, d.span.line, d.span.column));
  return outcome;
}

void check_folder(const std::string& folder, bool accepted) {
  const std::vector<fs::path> paths = grammars(folder);
  ASSERT_FALSE(paths.empty()) << folder << " holds no grammar";
  for (const fs::path& path : paths) {
    const std::string source = read(path);
    const Outcome outcome = outcome_of(path, source);
    EXPECT_EQ(outcome.accepted, accepted) << path << "\n" << outcome.text;
    EXPECT_EQ(outcome.found, announced(source)) << path << "\n" << outcome.text;
  }
}

TEST(Corpus, WhatShouldPassPasses) { check_folder("pass", true); }

TEST(Corpus, WhatShouldFailFailsAsAnnounced) {
  check_folder("fail", false);
  for (const fs::path& path : grammars("fail")) EXPECT_FALSE(announced(read(path)).empty()) << path;
}

/// Codes like "E0203" in a text.
std::set<std::string> codes_in(const std::string& text) {
  std::set<std::string> codes;
  for (std::size_t i = 0; i + 5 <= text.size(); ++i) {
    const bool letter =
        (text[i] == 'E' || text[i] == 'W') && (i == 0 || !std::isalnum(static_cast<unsigned char>(text[i - 1])));
    if (letter && std::all_of(text.begin() + static_cast<long>(i) + 1, text.begin() + static_cast<long>(i) + 5,
                              [](unsigned char c) { return std::isdigit(c); }))
      codes.insert(text.substr(i, 5));
  }
  return codes;
}

/// Codes that the front half of src/grammar reports; those of the compiler (E09..) are its own.
std::set<std::string> codes_reported() {
  std::set<std::string> codes;
  for (const auto& entry : fs::directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / "src" / "grammar"))
    if (entry.path().extension() == ".cpp")
      for (const std::string& code : codes_in(read(entry.path())))
        if (!code.starts_with("E09")) codes.insert(code);
  return codes;
}

std::string difference(const std::set<std::string>& a, const std::set<std::string>& b) {
  std::string only_in_a;
  for (const std::string& code : a)
    if (!b.contains(code)) only_in_a += code + " ";
  return only_in_a;
}

TEST(Corpus, ShowsEveryDiagnostic) {
  // Shown by other tests: too long a text, too deep, too many parameters, too many rules, overrides of attrs.
  std::set<std::string> shown = {"E0105", "E0106", "E0107", "E0605", "E0703", "E0704", "E0705"};
  for (const std::string folder : {"pass", "fail"})
    for (const fs::path& path : grammars(folder))
      for (const std::string& line : announced(read(path))) shown.insert(line.substr(0, 5));
  EXPECT_EQ(difference(codes_reported(), shown), "") << "never shown";
  EXPECT_EQ(difference(shown, codes_reported()), "") << "shown, but never reported";
}

TEST(Corpus, LanguagePageListsEveryDiagnostic) {
  const std::string page = read(fs::path(ESPALIER_SOURCE_DIR) / "docs" / "language.md");
  std::set<std::string> listed;
  for (const std::string& code : codes_in(page))
    if (!code.starts_with("E09")) listed.insert(code);
  EXPECT_EQ(difference(codes_reported(), listed), "") << "not on the page";
  EXPECT_EQ(difference(listed, codes_reported()), "") << "on the page, but never reported";
}

}  // namespace
}  // namespace espalier
