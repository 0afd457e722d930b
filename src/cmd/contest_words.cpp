#include "cmd/contest_words.h"

#include <filesystem>
#include <iostream>

#include <unistd.h>

#include <fmt/format.h>

namespace espalier {

ContestWords contest_words(const ContestOptions& options) {
  ContestWords words;
  words.scene = options.scene;
  words.settings = options.settings, words.attributes = options.attributes;
  words.seed = options.seed, words.seeds = options.seeds;
  words.seconds = options.seconds, words.evaluations = options.evaluations, words.generations = options.generations;
  words.clock = options.clock;
  return words;
}

std::string shell_word(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                             "0123456789-_./=,:+@%") == std::string::npos;
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string options_again(const ContestOptions& options) {
  std::string text = " --seeds " + shell_word(options.seeds);
  if (options.seed) text += fmt::format(" --seed {}", *options.seed);
  if (options.seconds) text += fmt::format(" --time {}", *options.seconds);
  if (options.evaluations) text += fmt::format(" --evaluations {}", *options.evaluations);
  if (options.generations) text += fmt::format(" --generations {}", *options.generations);
  for (const std::string& setting : options.settings) text += " --set " + shell_word(setting);
  for (const std::string& attribute : options.attributes) text += " -D " + shell_word(attribute);
  if (options.clock != "wall") text += " --clock " + shell_word(options.clock);
  if (options.threads > 0) text += fmt::format(" --threads {}", options.threads);
  return text;
}

std::string failed_in_words(std::size_t failed) {
  return fmt::format("{} came to nothing: the warnings say why, and they count as the worst\n",
                     failed == 1 ? "1 search" : fmt::format("{} searches", failed));
}

std::unique_ptr<ContestObserver> make_contest_observer(bool json) {
  if (json) return make_contest_json(std::cout);
  return isatty(STDOUT_FILENO) ? make_contest_bar(std::cout) : make_contest_lines(std::cout);
}

std::string contest_folder(const ContestOptions& options, const char* what) {
  namespace fs = std::filesystem;
  if (!options.out.empty()) return options.out;
  return (fs::path("out") / fmt::format("{}-{}", fs::path(options.scene).stem().string(), what)).string();
}

}  // namespace espalier
