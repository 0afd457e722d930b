// Holds every #include between rooms against src/LAYERS, and LAYERS against being a DAG.

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace {

namespace fs = std::filesystem;
using Layers = std::map<std::string, std::set<std::string>>;

const fs::path kSource = fs::path(ESPALIER_SOURCE_DIR) / "src";

Layers read_layers() {
  Layers layers;
  std::ifstream file(kSource / "LAYERS");
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    std::istringstream rest(line.substr(colon + 1));
    std::set<std::string>& allowed = layers[line.substr(0, colon)];
    for (std::string word; rest >> word;) allowed.insert(word);
  }
  return layers;
}

std::string room_of(const std::string& path) { return path.substr(0, path.find('/')); }

TEST(Layers, EveryIncludeFollowsTheArrows) {
  const Layers layers = read_layers();
  ASSERT_GE(layers.size(), 9u);
  const std::regex include("^\\s*#\\s*include\\s+\"([^\"]+)\"");
  int checked = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kSource)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    const std::string room = room_of(fs::relative(entry.path(), kSource).string());
    ASSERT_TRUE(layers.count(room)) << room << " is not in src/LAYERS";
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
      if (!std::regex_search(line, match, include)) continue;
      const std::string target = match[1];
      ++checked;
      EXPECT_TRUE(fs::exists(kSource / target)) << entry.path() << " includes " << target << " by another path";
      const std::set<std::string>& allowed = layers.at(room);
      const std::string other = room_of(target);
      EXPECT_TRUE(other == room || allowed.count(other) || allowed.count(target))
          << entry.path() << " may not include " << target;
    }
  }
  EXPECT_GT(checked, 100);
}

// Two types of one name in one namespace are undefined behaviour that no compiler or linker reports.
TEST(Layers, EveryTypeHasOneHeader) {
  const std::regex definition("^(?:class|struct|enum class) ([A-Za-z0-9_]+)[^;]*\\{");
  const std::regex opens("^namespace ([A-Za-z0-9_:]+) \\{");
  std::map<std::string, fs::path> home;
  for (const auto& entry : fs::recursive_directory_iterator(kSource)) {
    if (entry.path().extension() != ".h") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    std::string space;
    for (std::string line; std::getline(file, line);) {
      if (std::regex_search(line, match, opens)) space += std::string(match[1]) + "::";
      if (!std::regex_search(line, match, definition)) continue;
      const auto [it, fresh] = home.try_emplace(space + std::string(match[1]), entry.path());
      EXPECT_TRUE(fresh || it->second == entry.path())
          << it->first << " is defined in " << it->second << " and in " << entry.path();
    }
  }
  EXPECT_GT(home.size(), 100u);
}

TEST(Layers, AreADag) {
  const Layers layers = read_layers();
  std::set<std::string> done;
  while (done.size() < layers.size()) {
    const std::size_t before = done.size();
    for (const auto& [room, allowed] : layers) {
      bool ready = true;
      for (const std::string& other : allowed) ready &= room_of(other) == room || done.count(room_of(other)) > 0;
      if (ready) done.insert(room);
    }
    ASSERT_GT(done.size(), before) << "src/LAYERS has a circle";
  }
}

}  // namespace
