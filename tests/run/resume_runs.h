#pragma once
// Runs that are continued: a small scene whose files are quickly written, and what of two folders must be equal.

#include <algorithm>

#include <gtest/gtest.h>

#include "run/checkpoint.h"
#include "run/drawing_fixtures.h"
#include "run/run_folders.h"

namespace espalier::testing {

inline void write_resumable(const TemporaryFolder& folder, std::uint64_t generations) {
  write_drawing(folder);
  write_text(folder / "scene.toml",
             "espalier = 1\ngrammar = \"pile.esp\"\nseed = 3\n[budget]\ngenerations = " + std::to_string(generations) +
                 "\n[search]\npopulation = 24\nelitism = 4\ninitial_length = [5, 15]\n[engine.hybrid]\nturn = 200\n"
                 "start_evaluations = 300\n[engine.sosmc]\nparticles = 30\n[engine.smc]\nparticles = 30\n"
                 "[limits.genes]\nmin = 2\nmax = 40\n[limits.height]\nmax = 3.5\n"
                 "[output]\nkeep = 1\npicture = [16, 16]\nrefresh_seconds = 0\n" +
                 std::string(kParallel).replace(std::string(kParallel).find("[80, 120]"), 9, "[24, 36]"));
}

/// Of a run's folder, what must be equal: all but times, and the checkpoint, which holds some.
inline std::map<std::string, std::string> results(const std::string& folder) {
  std::map<std::string, std::string> files = comparable(folder);
  files.erase(kCheckpointName);
  files.erase(".lock");  // stays where a process is killed between giving the folder its name and ending
  return files;
}

/// By name: the whole files would be pages.
inline void expect_same_results(const std::string& folder, const std::string& expected) {
  const std::map<std::string, std::string> is = results(folder), should = results(expected);
  for (const auto& [name, text] : should) {
    const auto there = is.find(name);
    if (there == is.end()) {
      ADD_FAILURE() << name << " is missing";
      continue;
    }
    if (there->second == text) continue;
    const auto [a, b] = std::mismatch(text.begin(), text.end(), there->second.begin(), there->second.end());
    const auto at = static_cast<std::size_t>(a - text.begin()), begin = at - std::min<std::size_t>(at, 60);
    ADD_FAILURE() << name << " differs at byte " << at << ": " << there->second.substr(begin, 120) << "\nexpected: "
                  << text.substr(begin, 120);
  }
  for (const auto& [name, text] : is) EXPECT_TRUE(should.contains(name)) << name << " should not be there";
}

inline std::vector<std::string> partial_folders(const TemporaryFolder& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    if (entry.path().filename().string().find(".partial-") != std::string::npos) found.push_back(entry.path().string());
  }
  return found;
}

}  // namespace espalier::testing
