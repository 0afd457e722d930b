#pragma once
// What the tests of runs share: a folder that goes away, a small grammar, a box to fill, a scene that joins them.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace espalier::testing {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() : path_((fs::temp_directory_path() / "espalier-test-XXXXXX").string()) {
    if (!mkdtemp(path_.data())) std::abort();
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return (fs::path(path_) / name).string(); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline void write_text(const std::string& path, const std::string& text) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Every file below a folder, by its path within.
inline std::map<std::string, std::string> read_tree(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).generic_string()] = read_text(entry.path().string());
    }
  }
  return files;
}

inline constexpr const char* kPileGrammar = R"(grammar pile 1
attr widest in 1..3 = 1.4 "Widest"
start Pile
rule Pile { spawn Block }
rule Block {
  k ~ uniform(vec(0.7), (widest, 1.2, 1.2))
  resize k  move y scope.y / 2  emit box
  { move y scope.y / 2  maybe 0.5 spawn Block }
  { move x scope.x / 2  maybe 0.2 spawn Block }
  { move x -scope.x / 2  maybe 0.2 spawn Block }
}
)";

/// A closed box from `low` to `high`.
inline std::string box_obj(double lx, double ly, double lz, double hx, double hy, double hz) {
  std::ostringstream out;
  for (int i = 0; i < 8; ++i) {
    out << "v " << (i & 1 ? hx : lx) << ' ' << (i & 2 ? hy : ly) << ' ' << (i & 4 ? hz : lz) << '\n';
  }
  out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  return out.str();
}

inline std::string pile_scene(const std::string& budget = "generations = 6") {
  return "espalier = 1\ngrammar = \"pile.esp\"\nseed = 3\n[budget]\n" + budget +
         "\n[search]\npopulation = 24\nelitism = 4\ninitial_length = [5, 15]\n"
         "[limits.genes]\nmin = 2\nmax = 40\nfrom = 30\nto = 40\nweight = 5\n"
         "[volume]\ncells = 20000\noverlap_weight = 0.5\n[[volume.mesh]]\nfile = \"meshes/tower.obj\"\n"
         "[output]\nkeep = 2\npicture = [64, 48]\n";
}

/// pile.esp, meshes/tower.obj and scene.toml in a folder.
inline void write_pile(const TemporaryFolder& folder, const std::string& scene = pile_scene()) {
  write_text(folder / "pile.esp", kPileGrammar);
  write_text(folder / "meshes/tower.obj", box_obj(-1, 0, -0.5, 1, 4, 0.5));
  write_text(folder / "scene.toml", scene);
}

}  // namespace espalier::testing
