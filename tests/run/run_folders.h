#pragma once
// Runs of scenes in folders, and what of them must be equal for equal seeds.

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <string>
#include <string_view>

#include "io/mesh_import.h"
#include "run/fixtures.h"
#include "run/report_page.h"
#include "run/run.h"
#include "run/scene_toml.h"

namespace espalier::testing {

/// Runs FOLDER/scene.toml into FOLDER/out.
/// Those that the grammar of the fixtures suits. Genesis wants genomes that are one gene:
/// tests/run/genesis_run_test.cpp.
inline constexpr auto kGrowingEngines = [] {
  std::array<std::string_view, kEngineNames.size() - 1> names;
  std::copy_if(kEngineNames.begin(), kEngineNames.end(), names.begin(), [](auto name) { return name != "genesis"; });
  return names;
}();

inline bool run_in(const TemporaryFolder& folder, const std::string& out, int threads = 1,
                   RunObserver* observer = nullptr, const std::atomic<bool>* stop = nullptr,
                   const SceneOverrides& overrides = {}) {
  AssimpMeshSource source;
  Scene scene = load_scene(folder / "scene.toml", overrides);
  scene.threads = threads;
  return run_scene(scene, {folder / out, stop, observer}, source);
}

inline std::string without_times(const std::string& name, std::string text) {
  std::string kept;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (name == "result.json" && (line.find("\"wall_seconds\"") != std::string::npos ||
                                  line.find("\"evaluations_per_second\"") != std::string::npos)) {
      continue;
    }
    if (name == "convergence.csv") {
      const std::size_t second = line.find(',', line.find(',') + 1), third = line.find(',', second + 1);
      line.erase(second, third - second);
    }
    if (name == "diagnostics.csv") line.erase(0, line.find(',', line.find(',', line.find(',', line.find(',') + 1) + 1) + 1));
    kept += line + "\n";
  }
  return kept;
}

inline std::map<std::string, std::string> comparable(const std::string& folder) {
  std::map<std::string, std::string> files = read_tree(folder);
  for (auto& [name, text] : files) {
    if (name == "result.json" || name.ends_with(".csv")) text = without_times(name, text);
    if (name == "report.html") text = without_report_times(text);
  }
  return files;
}

}  // namespace espalier::testing
