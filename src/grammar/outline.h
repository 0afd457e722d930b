#pragma once
// GrammarOutline: what a grammar says in the words of its text: the draws of its rules, guards and probabilities as
// they are written. For people; a GeneratorGraph holds only what they come to.

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "grammar/checked.h"

namespace espalier {

struct DrawOutline {
  std::string name;                       // "k"
  std::string text;                       // "uniform(vec(0.6), vec(1.5))", in one line
  std::string distribution;               // "uniform"
  std::vector<std::string> alternatives;  // pick: as written, without weights
  Kind kind = Kind::number;               // of its value
};

struct RuleOutline {
  std::vector<std::string> parameters;
  std::string guard;  // empty: none
  std::vector<DrawOutline> draws;  // in text order, each statement once
};

struct AttributeOutline {
  std::string value;  // the default
  std::string range;  // "1..3 by 0.5"; empty: none
};

struct GrammarOutline {
  std::map<std::string, RuleOutline, std::less<>> rules;
  std::map<std::string, AttributeOutline, std::less<>> attributes;
  /// Of the optional spawns, by file and offset of their statement (Edge::span).
  std::map<std::pair<std::uint16_t, std::uint32_t>, std::string> probabilities;

  /// The draw that a component of a rule ("Body.k.x", "Row.gap[2]") belongs to, or null.
  const DrawOutline* find_draw(std::string_view rule, std::string_view component) const;
};

/// `sources`: the texts that the grammar was parsed from, by SourceSpan::file.
GrammarOutline outline_of(const CheckedGrammar& grammar, std::span<const SourceText> sources);

}  // namespace espalier
