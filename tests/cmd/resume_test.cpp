// --resume, --from, --lock and inspect --genes as a person types them; the examples of docs/scenes.md too.
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cmd/program_test.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::ChildResult;
using testing::read_text;

class ResumeCommand : public testing::ProgramTest {
 protected:
  /// The words of the command lines of a section of docs/scenes.md, without their comments.
  static std::vector<std::vector<std::string>> commands_of(const std::string& section) {
    const std::string page = read_text(std::string(ESPALIER_SOURCE_DIR) + "/docs/scenes.md");
    std::size_t begin = page.find("```sh\n", page.find(section));
    EXPECT_NE(begin, std::string::npos);
    begin += 6;
    std::istringstream lines(page.substr(begin, page.find("```", begin) - begin));
    std::vector<std::vector<std::string>> commands;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream in(line.substr(0, line.find(" #")));
      std::vector<std::string> words;
      for (std::string word; in >> word;) words.push_back(word);
      EXPECT_EQ(words.at(0), "espalier");
      words.erase(words.begin());
      for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i].starts_with("scenes/")) words[i] = std::string(ESPALIER_SOURCE_DIR) + "/" + words[i];
      }
      commands.push_back(std::move(words));
    }
    return commands;
  }
  /// In steps instead of seconds, so that nothing depends on the clock; of scenes, with few and small pictures.
  static std::vector<std::string> in_steps(std::vector<std::string> words, const std::string& steps) {
    if (words.at(1) != "--resume") words.insert(words.end(), {"--keep", "0", "--set", "output.picture=[32, 24]"});
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
      if (words[i] == "--time") words[i] = "--generations", words[i + 1] = steps;
    }
    return words;
  }
};

TEST_F(ResumeCommand, TheExampleOfStartingFromAModelWorks) {
  const auto commands = commands_of("## Starting from a model");
  ASSERT_EQ(commands.size(), 3u);
  const ChildResult first = espalier(in_steps(commands[0], "150"));
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const ChildResult genes = espalier(commands[1]);
  EXPECT_THAT(genes.out, HasSubstr("    0  Ship  "));
  EXPECT_THAT(genes.out, HasSubstr("  Ship/Body/Body  "));
  EXPECT_THAT(genes.out, HasSubstr("       k "));
  std::vector<std::string> third = commands[2];
  third.insert(third.end(), {"--time", "1"});
  const ChildResult second = espalier(in_steps(third, "20"));
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const auto list = [&](const char* run) {
    return nlohmann::json::parse(espalier({"inspect", run, "--genes", "--json"}).out);
  };
  const auto before = list("out/first"), after = list("out/second");
  const auto draws_of = [](const nlohmann::json& genes_of, const std::string& path) {
    for (const auto& gene : genes_of) {
      if (gene["path"] == path) return gene["draws"].dump();
    }
    return std::string("none");
  };
  for (const auto& gene : before) {
    const std::string path = gene["path"];
    if (path != "Ship/Body" && !path.starts_with("Ship/Body/Body")) continue;
    EXPECT_EQ(draws_of(after, path), draws_of(before, path)) << path;
  }
  const ChildResult again = espalier({"reproduce", "out/second/best.glb"});
  EXPECT_EQ(again.exit_code, 0) << again.out << again.err;
  EXPECT_THAT(again.out, HasSubstr("same: inputs/start/best.derivation.json"));
}

TEST_F(ResumeCommand, TheExampleOfGoingOnWorks) {
  const auto commands = commands_of("### Checkpoints, and going on");
  ASSERT_EQ(commands.size(), 4u);
  const ChildResult first = espalier(in_steps(commands[0], "20"));
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const ChildResult spent = espalier(commands[1]);
  EXPECT_EQ(spent.exit_code, 2);
  EXPECT_THAT(spent.err, HasSubstr("20 of 20 generations are done"));
  const ChildResult more = espalier(in_steps(commands[2], "30"));
  ASSERT_EQ(more.exit_code, 0) << more.err;
  EXPECT_THAT(more.out, HasSubstr("continues from step 20 of out/ship\n"));
  const ChildResult shown = espalier(commands[3]);
  EXPECT_EQ(shown.exit_code, 0) << shown.err;
  EXPECT_THAT(shown.out, HasSubstr("seed 1, step 30, "));
}

TEST_F(ResumeCommand, WhatDoesNotGoTogetherIsRefused) {
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    const ChildResult result = espalier(arguments);
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_THAT(refused({}), HasSubstr("run takes a scene, or --resume with the folder of a run"));
  EXPECT_THAT(refused({"a.toml", "--resume", "out"}), HasSubstr("one of them"));
  EXPECT_THAT(refused({"a.toml", "--force"}), HasSubstr("--force goes with --resume"));
  EXPECT_THAT(refused({"--resume", "out", "--seed", "3"}), HasSubstr("--seed does not go with --resume"));
  EXPECT_THAT(refused({"--resume", "out", "--set", "search.population=3"}), HasSubstr("--set does not go with"));
  EXPECT_THAT(refused({"--resume", "out", "--lock", "A"}), HasSubstr("--lock does not go with"));
  EXPECT_THAT(refused({"--resume", "out", "--time", "-1"}), HasSubstr("--time must be"));
  EXPECT_THAT(refused({"--resume", "out", "--generations", "0"}), HasSubstr("must be at least 1"));
  EXPECT_THAT(refused({"--resume", "out", "--checkpoint-every", "nan"}), HasSubstr("--checkpoint-every must be"));
  EXPECT_THAT(refused({"--resume", "/"}), HasSubstr("--resume must name a folder of its own, got \"/\""));
  EXPECT_THAT(refused({"a.toml", "--checkpoint-every", "0"}), HasSubstr("--checkpoint-every"));
  EXPECT_THAT(refused({"--resume", "nowhere"}), HasSubstr("nowhere: holds no checkpoint"));
}

TEST_F(ResumeCommand, AnEmptyValueIsNotAnOptionThatWasNotGiven) {
  const std::string scene = std::string(ESPALIER_SOURCE_DIR) + "/scenes/spaceship.toml";
  for (const char* option : {"--from", "--out", "--engine", "--lock", "--resume", "--set", "--time"}) {
    for (const bool joined : {false, true}) {
      std::vector<std::string> words = {"run", scene, "--generations", "1", "--keep", "0"};
      if (joined) words.push_back(std::string(option) + "=");
      else words.insert(words.end(), {option, ""});
      const ChildResult result = espalier(words);
      EXPECT_EQ(result.exit_code, 2) << option;
      EXPECT_THAT(result.err, HasSubstr(option));
    }
  }
  const ChildResult result = espalier({"run", "", "--resume", "out"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("scene: must not be empty"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

}  // namespace
}  // namespace espalier
