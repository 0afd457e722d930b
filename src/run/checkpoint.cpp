#include "run/checkpoint.h"

#include <sstream>
#include <unordered_set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/hash.h"
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
    if (is_finished(one->derivation) && seen.insert(hash(one->derivation)).second) {
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

Checkpoint with_head(const json& head) {
  Checkpoint c;
  head.at("version").get_to(c.version);
  head.at("grammar").get_to(c.grammar);
  head.at("engine").get_to(c.engine);
  head.at("seed").get_to(c.seed);
  head.at("step").get_to(c.step);
  head.at("evaluations").get_to(c.evaluations);
  head.at("seconds").get_to(c.seconds);
  head.at("best").get_to(c.best);
  head.at("inputs").get_to(c.inputs);
  head.at("settings").get_to(c.settings);
  head.at("out").get_to(c.out);
  head.at("threads").get_to(c.threads);
  head.at("refresh_seconds").get_to(c.refresh_seconds);
  head.at("checkpoint_seconds").get_to(c.checkpoint_seconds);
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
    throw Error(fmt::format("{}: cannot be continued from: {}", path, error.what()));
  }
}

}  // namespace espalier
