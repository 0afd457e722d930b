#include "derivation/encode.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/check.h"
#include "derivation/letters.h"

namespace espalier {
namespace {

void append(fmt::memory_buffer& out, std::string_view text) { out.append(text.data(), text.data() + text.size()); }

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

/// What stands for variant v: its name, or its index where the name is empty in a choice or not its own.
std::string variant_label(const Rule& rule, std::size_t v) {
  const std::string& name = rule.variants[v].name;
  const auto first = std::find_if(rule.variants.begin(), rule.variants.end(),
                                  [&](const Variant& other) { return other.name == name; });
  return static_cast<std::size_t>(first - rule.variants.begin()) == v ? quoted(name) : fmt::format("{}", v);
}

/// The JSON of everything that genes share, made once.
struct Labels {
  explicit Labels(const GeneratorGraph& graph) {
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
      edges.push_back(quoted(edge_label(graph, static_cast<EdgeId>(e))));
    }
    for (const Rule& rule : graph.rules) {
      std::vector<std::string>& labels = variants.emplace_back();
      for (std::size_t v = 0; v < rule.variants.size(); ++v) labels.push_back(variant_label(rule, v));
    }
  }
  std::vector<std::string> edges;
  std::vector<std::vector<std::string>> variants;  // [rule][variant]
};

}  // namespace

std::string encode(const GeneratorGraph& graph, const Derivation& derivation) {
  const Labels labels(graph);
  fmt::memory_buffer out;
  fmt::format_to(fmt::appender(out),
                 "{{\"espalier_derivation\": {}, \"grammar\": {}, \"grammar_hash\": {}, \"detail_seed\": "
                 "\"{:016x}\",\n \"genes\": [",
                 kDerivationVersion, quoted(graph.name), quoted(graph.source_hash), derivation.detail_seed);
  std::size_t slot = 0, draw = 0;
  for (const GeneRecord& gene : derivation.genes) {
    const Variant& variant = variant_of(graph, gene);
    append(out, &gene == derivation.genes.data() ? "\n[" : ",\n[");
    append(out, labels.edges[gene.edge]);
    append(out, ", ");
    append(out, labels.variants[graph.edges[gene.edge].child][gene.variant]);
    append(out, ", \"");
    for (std::size_t k = 0; k < variant.slots.size(); ++k) {
      out.push_back(kSlotLetters[static_cast<std::size_t>(derivation.slots[slot++])]);
    }
    append(out, "\", [");
    for (std::size_t k = 0; k < variant.draws.size(); ++k) {
      const fmt::format_int digits(derivation.draws[draw++]);
      if (k > 0) append(out, ", ");
      append(out, {digits.data(), digits.size()});
    }
    append(out, "]]");
  }
  CHECK(slot == derivation.slots.size() && draw == derivation.draws.size());
  append(out, "]}");
  return fmt::to_string(out);
}

}  // namespace espalier
