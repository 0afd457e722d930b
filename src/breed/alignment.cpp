#include "breed/alignment.h"

namespace espalier {
namespace {

struct Child {
  std::uint32_t slot = 0;
  GenePosition gene;
};

std::vector<Child> children_of(const GeneratorGraph& graph, const Derivation& derivation, const GenePosition& gene) {
  std::vector<Child> children;
  for_each_child(graph, derivation, gene,
                 [&](std::uint32_t slot, const GenePosition& child) { children.push_back({slot, child}); });
  return children;
}

}  // namespace

std::vector<AlignedGene> align(const GeneratorGraph& graph, const Derivation& first, const Derivation& second) {
  std::vector<AlignedGene> aligned;
  const auto add = [&](const GenePosition& a, const GenePosition& b) {
    const GeneRecord &x = first.genes[a.gene], &y = second.genes[b.gene];
    if (x.edge != y.edge || x.variant != y.variant) return;
    const Variant& variant = variant_of(graph, x);
    aligned.push_back({a, b, static_cast<std::uint32_t>(variant.draws.size()), &rule_of(graph, x), &variant});
  };
  add({}, {});
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    const std::vector<Child> of_first = children_of(graph, first, aligned[i].first);
    const std::vector<Child> of_second = children_of(graph, second, aligned[i].second);
    for (std::size_t a = 0, b = 0; a < of_first.size() && b < of_second.size();) {
      if (of_first[a].slot == of_second[b].slot) {
        add(of_first[a++].gene, of_second[b++].gene);
      } else {
        of_first[a].slot < of_second[b].slot ? ++a : ++b;
      }
    }
  }
  return aligned;
}

}  // namespace espalier
