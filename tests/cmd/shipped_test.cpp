// Every shipped grammar is well-formed and can be sampled, every shipped scene runs and scores the same again.

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

namespace {

namespace fs = std::filesystem;
const fs::path kSource = ESPALIER_SOURCE_DIR;

struct Outcome {
  int code = -1;
  std::string text;
};

Outcome espalier(const std::string& arguments) {
  Outcome outcome;
  FILE* pipe = popen((std::string(ESPALIER_PROGRAM) + " " + arguments + " 2>&1").c_str(), "r");
  if (!pipe) return outcome;
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) outcome.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

std::vector<fs::path> files(const char* folder, const char* ending) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(kSource / folder))
    if (entry.path().extension() == ending) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

class Shipped : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("espalier-shipped-" + std::to_string(getpid()));
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(Shipped, GrammarsAreWellFormedAndMakeModels) {
  const auto grammars = files("grammars", ".esp");
  ASSERT_GE(grammars.size(), 17u);
  for (const fs::path& grammar : grammars) {
    SCOPED_TRACE(grammar);
    const Outcome check = espalier("check " + grammar.string());
    EXPECT_EQ(check.code, 0) << check.text;
    EXPECT_EQ(check.text.find("warning"), std::string::npos) << check.text;
    const fs::path out = folder_ / grammar.stem();
    const Outcome sample = espalier("sample " + grammar.string() + " -n 1 --grow 8 --size 64,48 --out " + out.string());
    EXPECT_EQ(sample.code, 0) << sample.text;
    EXPECT_GT(fs::file_size(out / "samples.png"), 1000u);
  }
}

/// The first and the last value of the column "best".
std::pair<double, double> first_and_last_best(const fs::path& convergence) {
  std::ifstream in(convergence);
  std::string line;
  std::vector<double> best;
  std::getline(in, line);
  EXPECT_EQ(line, "step,evaluations,seconds,best,mean");
  while (std::getline(in, line)) {
    std::istringstream columns(line);
    std::string column;
    for (int i = 0; i < 4; ++i) std::getline(columns, column, ',');
    best.push_back(std::stod(column));
  }
  return best.empty() ? std::pair(0.0, 0.0) : std::pair(best.front(), best.back());
}

TEST_F(Shipped, ScenesRunAndScoreTheSameAgain) {
  auto scenes = files("scenes", ".toml");
  ASSERT_GE(scenes.size(), 14u);
  const auto published = files("scenes/published", ".toml");
  ASSERT_GE(published.size(), 12u);
  scenes.insert(scenes.end(), published.begin(), published.end());
  for (const fs::path& scene : scenes) {
    SCOPED_TRACE(scene);
    const fs::path out = folder_ / scene.stem();
    const Outcome run = espalier("run " + scene.string() + " --evaluations 1500 --keep 0 --set output.picture=[64,48] --out " +
                                 out.string());
    ASSERT_EQ(run.code, 0) << run.text;
    EXPECT_EQ(run.text.find("warning"), std::string::npos) << run.text;
    const auto result = nlohmann::json::parse(std::ifstream(out / "result.json"));
    EXPECT_GT(result.at("evaluations").get<int>(), 1000);
    const auto [first, last] = first_and_last_best(out / "convergence.csv");
    EXPECT_GT(last, first) << "a start of something";
    const Outcome score = espalier("score " + scene.string() + " " + (out / "best.derivation.json").string() + " --json");
    ASSERT_EQ(score.code, 0) << score.text;
    EXPECT_EQ(nlohmann::json::parse(score.text).at("score"), result.at("score"));
  }
}

}  // namespace
