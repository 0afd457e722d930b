#pragma once
// GeneReader: builds a derivation from the entries of an encoded one, and knows from the slots read so far which edge
// each gene must have. Everything that is wrong throws Error naming gene, rule and value.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "derivation/writer.h"

namespace espalier {

class GeneReader {
 public:
  GeneReader(const GeneratorGraph& graph, std::uint32_t most_genes) : graph_(graph), most_genes_(most_genes) {
    writer_.begin(derivation_);
  }

  std::size_t size() const { return derivation_.size(); }
  /// "gene 12 (Branch)": the one being read.
  std::string where() const;

  void begin_gene();
  void take_text(std::string_view text);  // edge, variant or slots, whichever is next
  void take_variant_index(std::uint64_t index);
  void begin_draws();
  void take_draw(std::uint64_t quantile);
  void end_gene();

  /// All entries have been read.
  Derivation finish();

 private:
  enum class Field : std::uint8_t { edge, variant, slots, draws, end };
  struct Frame {
    std::size_t slots, slot, end;  // its own in derivation_: first, next to look at, behind
    const Rule* rule;
    const Variant* variant;
  };

  [[noreturn]] void fail(const std::string& what) const;
  bool next_filled_slot();
  void open(std::uint16_t variant);
  void take_slots(std::string_view letters);

  const GeneratorGraph& graph_;
  std::uint32_t most_genes_;
  Derivation derivation_;
  TreeWriter writer_;
  std::vector<Frame> stack_;
  Field field_ = Field::end;
  EdgeId edge_ = 0;               // of the gene being read
  const Rule* rule_ = nullptr;    // its rule
  std::size_t first_draw_ = 0;
};

}  // namespace espalier
