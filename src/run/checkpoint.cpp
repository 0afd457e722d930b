#include "run/checkpoint.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <unordered_set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/hash.h"
#include "base/printable.h"
#include "base/version.h"
#include "derivation/sample.h"
#include "io/file.h"
#include "run/founders.h"

namespace espalier {
namespace {

using nlohmann::json;

// Magic, version, length and checksum; the length is that of what follows.
constexpr std::string_view kMagic = "espalier checkpoint\n";
constexpr std::uint64_t kFormat = 1;
constexpr std::size_t kWord = 8, kHash = 32;
constexpr std::size_t kPrefix = kMagic.size() + 2 * kWord + kHash;
constexpr std::uint64_t kMostBytes = 8ull << 30;

// Of the population, for searches that cannot go on as they were: enough to start well, little to write.
constexpr std::size_t kMostModels = 64;
constexpr std::size_t kMostPopulationBytes = 4u << 20;

std::string word(std::uint64_t value) {
  std::string bytes(kWord, '\0');
  for (std::size_t i = 0; i < kWord; ++i) bytes[i] = static_cast<char>(value >> 8 * i & 0xff);
  return bytes;
}

/// Takes a piece off the front.
std::string_view take(std::string_view& bytes, std::uint64_t size) {
  if (size > bytes.size()) throw Error("it is damaged: it ends too early");
  const std::string_view piece = bytes.substr(0, size);
  bytes.remove_prefix(size);
  return piece;
}

std::uint64_t take_word(std::string_view& bytes) {
  const std::string_view piece = take(bytes, kWord);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < kWord; ++i) value |= std::uint64_t{static_cast<unsigned char>(piece[i])} << 8 * i;
  return value;
}

/// The best ever, the alternatives, then the population: each once, finished, the best first of each.
std::string population_of(const SearchSession& session) {
  std::vector<const Individual*> all = {&session.engine().best()};
  for (const Individual& one : session.archive().members()) all.push_back(&one);
  for (const Individual& one : session.engine().population()) all.push_back(&one);
  const GeneratorGraph& graph = session.setup().graph();
  std::unordered_set<std::uint64_t> seen;
  std::string lines;
  for (const Individual* one : all) {
    if (seen.size() == kMostModels || lines.size() > kMostPopulationBytes) break;
    const bool whole = session.engine().leaves_open() || is_finished(one->derivation);
    if (whole && seen.insert(hash(one->derivation)).second) {
      lines += to_line(graph, one->derivation) + "\n";
    }
  }
  return lines;
}

json head_of(const Checkpoint& c) {
  return {{"version", c.version},     {"grammar", c.grammar},
          {"engine", c.engine},       {"seed", c.seed},
          {"step", c.step},           {"evaluations", c.evaluations},
          {"seconds", c.seconds},     {"best", c.best},
          {"inputs", c.inputs},       {"settings", c.settings},
          {"out", c.out},             {"threads", c.threads},
          {"refresh_seconds", c.refresh_seconds}, {"checkpoint_seconds", c.checkpoint_seconds}};
}

constexpr std::uint64_t kMostWhole = std::numeric_limits<std::uint64_t>::max();
constexpr double kMostSeconds = 1e6, kAnything = std::numeric_limits<double>::max();

[[noreturn]] void fail_head(const char* key, const std::string& rule, const json& value) {
  constexpr std::size_t kMostShown = 60;
  const std::string got = value.dump(-1, ' ', true, json::error_handler_t::replace);
  throw Error(fmt::format("it is damaged: {} must be {}, got {}{}", key, rule, got.substr(0, kMostShown),
                          got.size() > kMostShown ? "..." : ""));
}

/// The library's own conversions wrap around and cut off silently.
std::uint64_t whole_in(const json& head, const char* key, std::uint64_t most) {
  const json& value = head.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) {
    fail_head(key, fmt::format("a whole number from 0 to {}", most), value);
  }
  return value.get<std::uint64_t>();
}

double number_in(const json& head, const char* key, double low, double high) {
  const json& value = head.at(key);
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(number >= low && number <= high)) fail_head(key, fmt::format("a number from {:g} to {:g}", low, high), value);
  return number;
}

/// Names are of files below the run's folder, each in one way of writing only.
void check_names(const std::map<std::string, std::string>& inputs) {
  for (const auto& [name, hash] : inputs) {
    std::string_view rest = name;
    bool sound = name.starts_with("inputs/") && name.find('\0') == std::string::npos;
    for (bool more = true; more && sound;) {
      const std::size_t slash = rest.find('/');
      const std::string_view part = rest.substr(0, slash);
      sound = !part.empty() && part != "." && part != "..";
      more = slash != std::string_view::npos;
      if (more) rest.remove_prefix(slash + 1);
    }
    if (!sound) throw Error(fmt::format("it is damaged: inputs must be files below inputs/, got \"{}\"", name));
  }
}

Checkpoint with_head(const json& head) {
  Checkpoint c;
  head.at("version").get_to(c.version);
  head.at("grammar").get_to(c.grammar);
  head.at("engine").get_to(c.engine);
  c.seed = whole_in(head, "seed", kMostWhole);
  c.step = whole_in(head, "step", kMostWhole);
  c.evaluations = whole_in(head, "evaluations", kMostWhole);
  c.seconds = number_in(head, "seconds", 0, kAnything);
  c.best = number_in(head, "best", -kAnything, kAnything);
  head.at("inputs").get_to(c.inputs);
  check_names(c.inputs);
  head.at("settings").get_to(c.settings);
  head.at("out").get_to(c.out);
  // As scenes have them.
  c.threads = static_cast<int>(whole_in(head, "threads", 1024));
  c.refresh_seconds = number_in(head, "refresh_seconds", 0, kMostSeconds);
  c.checkpoint_seconds = number_in(head, "checkpoint_seconds", 0, kMostSeconds);
  if (c.checkpoint_seconds == 0) fail_head("checkpoint_seconds", "above 0", head.at("checkpoint_seconds"));
  return c;
}

}  // namespace

Checkpoint make_checkpoint(const SearchSession& session, std::string settings, std::string out) {
  const Setup& setup = session.setup();
  const StepReport& last = session.last();
  Checkpoint c;
  c.version = kVersion;
  c.grammar = setup.graph().name;
  c.engine = name_of(setup.scene.search.engine);
  c.seed = setup.scene.seed;
  c.step = last.step, c.evaluations = last.evaluations, c.seconds = last.seconds, c.best = last.best;
  c.inputs = setup.inputs.hashes();
  c.settings = std::move(settings);
  c.out = std::move(out);
  c.threads = setup.scene.threads;
  c.refresh_seconds = setup.scene.refresh_seconds, c.checkpoint_seconds = setup.scene.checkpoint_seconds;
  c.population = population_of(session);
  std::ostringstream state;
  session.save(state);
  c.state = std::move(state).str();
  return c;
}

std::string encode_checkpoint(const Checkpoint& checkpoint) {
  const std::string head = head_of(checkpoint).dump(-1, ' ', true, json::error_handler_t::replace);
  std::string body;
  for (const std::string* part : {&head, &checkpoint.population, &checkpoint.state}) {
    body += word(part->size());
    body += *part;
  }
  return std::string(kMagic) + word(kFormat) + word(body.size()) + content_hash(body) + body;
}

bool is_checkpoint(std::string_view bytes) { return bytes.starts_with(kMagic); }

Checkpoint parse_checkpoint(std::string_view bytes) {
  if (!is_checkpoint(bytes)) throw Error("it is no checkpoint");
  bytes.remove_prefix(kMagic.size());
  if (const std::uint64_t format = take_word(bytes); format != kFormat) {
    throw Error(fmt::format("version of the format must be {}, got {}", kFormat, format));
  }
  const std::uint64_t length = take_word(bytes);
  const std::string_view checksum = take(bytes, kHash);
  if (length != bytes.size()) {
    throw Error(fmt::format("it is damaged: {} bytes must follow its first {}, got {}", length, kPrefix, bytes.size()));
  }
  if (content_hash(bytes) != checksum) throw Error("it is damaged: its checksum does not match");
  Checkpoint checkpoint;
  try {
    checkpoint = with_head(json::parse(take(bytes, take_word(bytes))));
  } catch (const json::exception& error) {
    throw Error(fmt::format("it is damaged: {}", error.what()));
  }
  checkpoint.population = take(bytes, take_word(bytes));
  checkpoint.state = take(bytes, take_word(bytes));
  if (!bytes.empty()) throw Error("it is damaged: more follows after its end");
  return checkpoint;
}

Checkpoint read_checkpoint(const std::string& path) {
  const std::string bytes = read_file(path, kMostBytes);
  try {
    return parse_checkpoint(bytes);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: cannot be continued from: {}", path, printable(error.what())));
  }
}

}  // namespace espalier
