#include "derivation/gene_reader.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "derivation/letters.h"

namespace espalier {

std::string GeneReader::where() const {
  const std::size_t opened = field_ > Field::variant ? 1 : 0;  // it counts among the genes already
  return fmt::format("gene {} ({})", derivation_.size() - opened, rule_ ? rule_->name : "?");
}

void GeneReader::fail(const std::string& what) const {
  throw Error(fmt::format("derivation: {}: {}", where(), what));
}

/// Sets edge_ and rule_ for the next gene; closes the genes whose slots are all served.
bool GeneReader::next_filled_slot() {
  while (!stack_.empty()) {
    Frame& top = stack_.back();
    while (top.slot < top.end && derivation_.slots[top.slot] != SlotState::filled) ++top.slot;
    if (top.slot < top.end) {
      edge_ = top.rule->slots[top.variant->slots[top.slot++ - top.slots]].edge;
      rule_ = &graph_.rule_of(edge_);
      return true;
    }
    writer_.close();
    stack_.pop_back();
  }
  return false;
}

void GeneReader::begin_gene() {
  field_ = Field::edge;
  rule_ = nullptr;
  if (size() >= most_genes_) fail(fmt::format("more than {} genes", most_genes_));
  if (size() == 0) {
    edge_ = 0;
    rule_ = &graph_.rule_of(edge_);
  } else if (!next_filled_slot()) {
    fail("no filled slot is left for it");
  }
}

void GeneReader::take_text(std::string_view text) {
  switch (field_) {
    case Field::edge: {
      const std::string& expected = edge_label(graph_, edge_);
      if (text != expected) fail(fmt::format("stands in a slot of \"{}\", but says \"{}\"", expected, text));
      field_ = Field::variant;
      return;
    }
    case Field::variant: {
      const auto found = std::find_if(rule_->variants.begin(), rule_->variants.end(),
                                      [&](const Variant& variant) { return variant.name == text; });
      if (found == rule_->variants.end()) fail(fmt::format("the rule has no variant \"{}\"", text));
      return open(static_cast<std::uint16_t>(found - rule_->variants.begin()));
    }
    case Field::slots: return take_slots(text);
    default: fail(fmt::format("\"{}\" is not expected here", text));
  }
}

void GeneReader::take_variant_index(std::uint64_t index) {
  if (field_ != Field::variant) fail(fmt::format("{} is not expected here", index));
  const std::size_t variants = rule_->variants.size();
  if (index >= variants) fail(fmt::format("variant {} of {}", index, variants));
  open(static_cast<std::uint16_t>(index));
}

void GeneReader::open(std::uint16_t variant) {
  writer_.open(edge_, variant);
  stack_.push_back({derivation_.slots.size(), 0, 0, rule_, &rule_->variants[variant]});
  field_ = Field::slots;
}

void GeneReader::take_slots(std::string_view letters) {
  Frame& top = stack_.back();
  const std::size_t expected = top.variant->slots.size();
  if (letters.size() != expected) {
    fail(fmt::format("has {} slots, but \"{}\" gives {}", expected, letters, letters.size()));
  }
  for (const char letter : letters) {
    const std::size_t state = kSlotLetters.find(letter);
    if (state == std::string_view::npos) {
      fail(fmt::format("slot states are F, E, O or A, not those of \"{}\"", letters));
    }
    derivation_.slots.push_back(static_cast<SlotState>(state));
  }
  top.slot = top.slots;
  top.end = derivation_.slots.size();
  field_ = Field::draws;
}

void GeneReader::begin_draws() {
  if (field_ != Field::draws) fail("an array is not expected here");
  first_draw_ = derivation_.draws.size();
  field_ = Field::end;
}

void GeneReader::take_draw(std::uint64_t quantile) {
  if (quantile > std::numeric_limits<std::uint32_t>::max()) {
    fail(fmt::format("quantile {} is not below 2^32", quantile));
  }
  derivation_.draws.push_back(static_cast<std::uint32_t>(quantile));
}

void GeneReader::end_gene() {
  if (field_ != Field::end) fail("the entry ends early: edge, variant, slots and draws are expected");
  const std::size_t expected = stack_.back().variant->draws.size(), got = derivation_.draws.size() - first_draw_;
  if (got != expected) fail(fmt::format("has {} draws, but {} are given", expected, got));
  writer_.opened();
}

Derivation GeneReader::finish() {
  if (next_filled_slot()) {
    throw Error(fmt::format("derivation: after gene {}: the gene of a filled slot ({}) is missing", size() - 1,
                            edge_label(graph_, edge_)));
  }
  return std::move(derivation_);
}

}  // namespace espalier
