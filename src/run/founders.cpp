#include "run/founders.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/executor.h"
#include "derivation/adapt.h"
#include "derivation/encode.h"
#include "derivation/sample.h"
#include "run/scene_scorer.h"

namespace espalier {
namespace {

constexpr std::uint32_t kMostGenes = 4'000'000;

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

Adapted read_one(const GeneratorGraph& graph, std::string_view json) {
  std::optional<Adapted> fitting = adapt(graph, decode(graph, json, kMostGenes, Fit::adaptable));
  if (!fitting) throw Error("nothing of the derivation can stand in this grammar with these attributes");
  return std::move(*fitting);
}

class FounderReader {
 public:
  FounderReader(Setup& setup, std::string path) : setup_(setup), path_(std::move(path)) {}

  std::vector<Derivation> read(const std::string& text) {
    std::vector<Derivation> all;
    if (!path_.ends_with(kManyDerivations)) {
      all.push_back(read_document(text, path_));
    } else {
      const std::vector<std::string_view> lines = lines_of(text);
      for (std::size_t i = 0; i < lines.size(); ++i) {
        all.push_back(read_document(lines[i], fmt::format("{}:{}", path_, i + 1)));
      }
      if (all.empty()) throw Error(fmt::format("{}: holds no derivation", path_));
    }
    if (cut_ + grown_ > 0) {
      setup_.warnings.push_back(fmt::format("{} was adapted to the grammar and its attributes: {} genes were left out, "
                                            "{} are new", path_, cut_, grown_));
    }
    return all;
  }

 private:
  Derivation read_document(std::string_view json, const std::string& place) {
    try {
      Adapted one = read_one(setup_.graph(), json);
      cut_ += one.cut, grown_ += one.grown;
      return std::move(one.derivation);
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}", place, error.what()));
    }
  }

  Setup& setup_;
  std::string path_;
  std::uint64_t cut_ = 0, grown_ = 0;
};

Locks parse_locks(const GeneratorGraph& graph, const std::vector<SceneLock>& texts) {
  Locks locks;
  for (const SceneLock& text : texts) {
    try {
      locks.push_back({parse_gene_path(graph, text.path), text.scope});
    } catch (const Error& error) {
      throw Error(fmt::format("start.locks: {}", error.what()));
    }
  }
  return locks;
}

/// Empty if every lock leads to a gene; otherwise which step of which leads nowhere.
std::string find_loose_lock(const GeneratorGraph& graph, const Derivation& derivation, const Locks& locks) {
  for (const Lock& lock : locks) {
    std::vector<std::uint16_t> way;
    for (const std::uint16_t step : lock.path) {
      std::vector<std::uint16_t> longer = way;
      longer.push_back(step);
      if (!find_gene(graph, derivation, longer)) {
        const std::string whole = format_gene_path(graph, longer);
        return fmt::format("the lock on {} leads to no gene: nothing stands in slot {} of {} (`espalier inspect FILE "
                           "--genes` lists all paths)", format_gene_path(graph, lock.path),
                           whole.substr(whole.rfind('/') + 1), format_gene_path(graph, way));
      }
      way = std::move(longer);
    }
  }
  return "";
}

std::string find_objection(const Setup& setup, const Derivation& derivation) {
  const GeneLimits& genes = setup.scene.search.ga.genes;
  const bool may_be_open = setup.scene.search.engine == EngineKind::guided;
  if (!may_be_open && !is_finished(derivation)) return "it is not finished: it has open slots";
  if (derivation.size() < genes.min || derivation.size() > genes.max) {
    return fmt::format("limits.genes allows {} to {}, it has {}", genes.min, genes.max, derivation.size());
  }
  return find_loose_lock(setup.graph(), derivation, setup.locks);
}

}  // namespace

void take_founders(Setup& setup, const Scene& from) {
  if (from.start.derivation.empty()) return;
  namespace fs = std::filesystem;
  const fs::path named = from.start.derivation;
  const std::string path = named.is_absolute() ? named.string() : (fs::path(from.folder) / named).string();
  const InputFile& file = setup.inputs.add_start(path);
  setup.scene.start.derivation = file.name;
  setup.locks = parse_locks(setup.graph(), from.start.locks);
  const std::vector<Derivation> all = FounderReader(setup, path).read(file.bytes);
  const std::unique_ptr<Executor> executor = make_serial_executor();
  SceneScorer scorer(setup.graph(), setup.objective, *executor);
  std::string objection;  // the first
  for (const Derivation& derivation : all) {
    std::string why = find_objection(setup, derivation);
    Individual founder = {derivation, 0};
    const Derivation* const one = &derivation;
    if (why.empty()) scorer.score({&one, 1}, {&founder.score, 1});
    if (founder.score == kNotAcceptable) {
      why = "a hard limit does not accept it: " + scorer.explain(derivation).rejected;
    }
    if (why.empty()) setup.founders.push_back(std::move(founder));
    if (objection.empty()) objection = std::move(why);
  }
  if (setup.founders.empty()) throw Error(fmt::format("{}: cannot be started from: {}", path, objection));
  if (setup.founders.size() < all.size()) {
    setup.warnings.push_back(fmt::format("{}: {} of {} models are left out; of the first, {}", path,
                                         all.size() - setup.founders.size(), all.size(), objection));
  }
  std::stable_sort(setup.founders.begin(), setup.founders.end(),
                   [](const Individual& a, const Individual& b) { return a.score > b.score; });
}

std::string to_line(const GeneratorGraph& graph, const Derivation& derivation) {
  std::string text = encode(graph, derivation);
  std::erase(text, '\n');
  return text;
}

std::string adapted_lines(const GeneratorGraph& graph, std::string_view lines) {
  std::string result;
  for (const std::string_view line : lines_of(lines)) {
    try {
      result += to_line(graph, read_one(graph, line).derivation) + "\n";
    } catch (const Error&) {  // cannot stand here; whether any can is asked by the caller
    }
  }
  return result;
}

}  // namespace espalier
