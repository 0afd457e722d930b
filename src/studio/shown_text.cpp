#include "studio/shown_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/counted.h"
#include "base/error.h"
#include "derivation/locks.h"

namespace espalier::studio {
namespace {

std::vector<std::int64_t> locked_genes(const ShownModel& shown) {
  const GeneratorGraph& graph = shown.setup->graph();
  std::vector<std::int64_t> genes;
  for (const std::string& path : shown.locks) {
    try {
      if (const auto gene = find_gene(graph, shown.derivation, parse_gene_path(graph, path))) genes.push_back(*gene);
    } catch (const Error&) {  // of an earlier text of the grammar
    }
  }
  return genes;
}

}  // namespace

api::Shown shown_text(const ShownModel& shown, const Explanation& explanation, const Model& model, const SentModel& sent) {
  const GeneratorGraph& graph = shown.setup->graph();
  api::Shown text;
  text.model = shown.number;
  text.revision = shown.revision;
  text.genes = static_cast<std::int64_t>(shown.derivation.size());
  text.parts = std::count_if(model.instances.begin(), model.instances.end(), in_full);
  text.bones = static_cast<std::int64_t>(model.bones.size());
  text.score = shown.score;
  text.words = shown.words.empty() ? counted(shown.derivation.size(), "gene") : shown.words;
  for (const Explanation& target : explanation.targets) {
    for (const Term& term : target.terms) {
      text.terms.push_back({target.name, term.name, term.count, term.of, term.unit, target.weight * term.value});
    }
  }
  for (const Rule& rule : graph.rules) text.rules.push_back(rule.name);
  text.locked = locked_genes(shown);
  text.truncated = model.truncated || sent.truncated;
  return text;
}

}  // namespace espalier::studio
