#include "derivation/encode.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "random_derivation.h"

namespace espalier {
namespace {

using namespace test;

constexpr SlotState O = SlotState::open, E = SlotState::empty, F = SlotState::filled, A = SlotState::absent;

GeneratorGraph small() {
  GraphBuilder b("small \"quoted\"");
  const RuleId root = b.rule("Root", 1), twig = b.rule("Twig", 2);
  b.maybe(root, twig, 0.5, 2);
  b.spawn(root, twig);
  b.maybe(twig, twig, 0.5);
  b.guard(twig, depth_below(2));
  b.variant(twig, 0.5, {0, 1}, {0});
  b.variant(twig, 0.5, {}, {});
  return b.build();
}

const Derivation kSmall{{{0, 0, 2, 1, 2}, {1, 1, 0, 0, 0}, {2, 0, 0, 0, 0}},
                        {F, O, F, A},
                        {4294967295u, 0, 7},
                        0x0123456789abcdefu};

const std::string kText =
    "{\"espalier_derivation\": 1, \"grammar\": \"small \\\"quoted\\\"\", \"grammar_hash\": \"hash of small "
    "\\\"quoted\\\"\", \"detail_seed\": \"0123456789abcdef\",\n \"genes\": [\n"
    "[\"Root\", \"\", \"FOF\", [4294967295]],\n"
    "[\"Root/Twig\", \"2\", \"\", []],\n"
    "[\"Root/Twig\", \"1\", \"A\", [0, 7]]]}";

TEST(Encode, IsReadable) { EXPECT_EQ(encode(small(), kSmall), kText); }
TEST(Decode, ReadsItBack) { EXPECT_EQ(decode(small(), kText), kSmall); }

TEST(Encode, RoundTripsExactly) {
  int trips = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    RandomStream random = stream(seed);
    const GeneratorGraph graph = random_graph(random);
    const std::optional<Derivation> d = random_derivation(graph, random);
    if (!d) continue;
    const std::string text = encode(graph, *d);
    const Derivation back = decode(graph, text);
    ASSERT_EQ(back, *d);
    EXPECT_EQ(hash(back), hash(*d));
    EXPECT_EQ(encode(graph, back), text);
    ++trips;
  }
  EXPECT_GT(trips, 1000);
}

TEST(Encode, VariantsOfOneNameAreToldApart) {
  GeneratorGraph graph = small();
  graph.rules[1].variants[1].name = graph.rules[1].variants[0].name;
  const std::string text = encode(graph, kSmall);
  EXPECT_NE(text.find("[\"Root/Twig\", 1, \"\", []]"), std::string::npos) << text;
  EXPECT_EQ(decode(graph, text), kSmall);
}

TEST(Decode, ReadsMembersInAnyOrderAndSkipsProvenance) {
  const std::string genes = kText.substr(kText.find("\"genes\""));
  std::string text = "{" + genes.substr(0, genes.size() - 1) +
                     ", \"provenance\": {\"by\": [1, {\"genes\": null}, -2.5e3, true, \"x\"], \"deep\": [[[{}]]]}, "
                     "\"detail_seed\": \"0123456789abcdef\", \"grammar_hash\": \"hash of small \\\"quoted\\\"\", "
                     "\"grammar\": \"small \\\"quoted\\\"\", \"espalier_derivation\": 1}";
  EXPECT_EQ(decode(small(), text), kSmall);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text, Fit fit = Fit::same_grammar, std::uint32_t most = 100) {
  try {
    decode(small(), text, most, fit);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

std::string error_after(const std::string& from, const std::string& to) { return error_of(replaced(kText, from, to)); }

TEST(Decode, RefusesAnotherGrammarUnlessAsked) {
  const std::string other = replaced(kText, "hash of small", "hash of tall");
  EXPECT_EQ(error_of(other),
            "derivation: grammar_hash: made by \"hash of tall \"quoted\"\", but the grammar at hand is \"hash of small "
            "\"quoted\"\"");
  EXPECT_EQ(error_of(other, Fit::valid), "");
  const std::string renamed = replaced(kText, "\"small", "\"big");
  EXPECT_NE(error_of(renamed), "");
  EXPECT_EQ(error_of(renamed, Fit::valid), "");
}

TEST(Decode, NamesWhatIsWrongInTheDocument) {
  EXPECT_EQ(error_after("_derivation\": 1", "_derivation\": 2"),
            "derivation: espalier_derivation: version 2 is not known, only 1");
  EXPECT_EQ(error_after("_derivation\": 1", "_derivation\": 1.0"),
            "derivation: espalier_derivation: 1.0 is not expected here");
  EXPECT_EQ(error_after("0123456789abcdef", "123456789abcdef"),
            "derivation: detail_seed: must be 16 lower-case hexadecimal digits, got \"123456789abcdef\"");
  EXPECT_EQ(error_after("0123456789abcdef", "0123456789ABCDEF").substr(0, 40),
            "derivation: detail_seed: must be 16 lowe");
  EXPECT_EQ(error_after("\"grammar\"", "\"grammars\""), "derivation: document: member \"grammars\" is not known");
  EXPECT_EQ(error_after("\"grammar_hash\"", "\"grammar\""), "derivation: document: member \"grammar\" stands twice");
  EXPECT_EQ(error_of("{}"), "derivation: document: member \"espalier_derivation\" is missing");
  EXPECT_EQ(error_of("[]"), "derivation: document: an array is not expected here");
  EXPECT_EQ(error_of("3"), "derivation: document: 3 is not expected here");
  EXPECT_EQ(error_of("").substr(0, 39), "derivation: document: not JSON at byte ");
  EXPECT_EQ(error_of(kText + "x").substr(0, 39), "derivation: document: not JSON at byte ");
  EXPECT_EQ(error_of(kText, Fit::same_grammar, 2), "derivation: gene 2 (?): more than 2 genes");
  EXPECT_EQ(error_after("\"genes\": [", "\"genes\": [], \"provenance\": ["),
            "derivation: provenance: an array is not expected here");
}

TEST(Decode, NamesWhatIsWrongInAGene) {
  EXPECT_EQ(error_after("\"Root/Twig\", \"2\"", "\"Twig/Twig\", \"2\""),
            "derivation: gene 1 (Twig): stands in a slot of \"Root/Twig\", but says \"Twig/Twig\"");
  EXPECT_EQ(error_after("\"2\"", "\"3\""), "derivation: gene 1 (Twig): the rule has no variant \"3\"");
  EXPECT_EQ(error_after("\"2\"", "2"), "derivation: gene 1 (Twig): variant 2 of 2");
  EXPECT_EQ(error_after("\"2\"", "-1"), "derivation: gene 1 (Twig): -1 is not expected here");
  EXPECT_EQ(error_after("\"2\"", "null"), "derivation: gene 1 (Twig): null is not expected here");
  EXPECT_EQ(error_after("\"A\"", "\"AA\""), "derivation: gene 2 (Twig): has 1 slots, but \"AA\" gives 2");
  EXPECT_EQ(error_after("\"A\"", "\"x\""),
            "derivation: gene 2 (Twig): slot states are F, E, O or A, not those of \"x\"");
  EXPECT_EQ(error_after("[0, 7]", "[0]"), "derivation: gene 2 (Twig): has 2 draws, but 1 are given");
  EXPECT_EQ(error_after("[0, 7]", "[0, 7, 8]"), "derivation: gene 2 (Twig): has 2 draws, but 3 are given");
  EXPECT_EQ(error_after("[0, 7]", "[0, 4294967296]"),
            "derivation: gene 2 (Twig): quantile 4294967296 is not below 2^32");
  EXPECT_EQ(error_after("[0, 7]", "[0, 0.5]"), "derivation: gene 2 (Twig): 0.5 is not expected here");
  EXPECT_EQ(error_after("[0, 7]", "[0, NaN]").substr(0, 47), "derivation: gene 2 (Twig): not JSON at byte 241");
  EXPECT_EQ(error_after(", [0, 7]", ""),
            "derivation: gene 2 (Twig): the entry ends early: edge, variant, slots and draws are expected");
  EXPECT_EQ(error_after("[0, 7]", "[0, 7], 5"), "derivation: gene 2 (Twig): 5 is not expected here");
  EXPECT_EQ(error_after("[0, 7]", "[0, [7]]"), "derivation: gene 2 (Twig): an array is not expected here");
  EXPECT_EQ(error_after("\"FOF\"", "\"FEE\""), "derivation: gene 2 (?): no filled slot is left for it");
  EXPECT_EQ(error_after("\"FOF\"", "\"FFF\""),
            "derivation: after gene 2: the gene of a filled slot (Root/Twig) is missing");
  EXPECT_EQ(error_after("\"A\"", "\"E\""),
            "derivation: gene 2 (Twig): slot Twig is not absent, but its guard fails at depth 2");
}

TEST(Decode, TruncatedTextIsAnErrorAtEveryByte) {
  for (std::size_t n = 0; n < kText.size(); ++n) EXPECT_NE(error_of(kText.substr(0, n)), "") << n;
}

TEST(Decode, SurvivesDamage) {
  int refused = 0;
  RandomStream random = stream(4);
  const std::string alphabet = "[]{},:\"0129-.eEFOAx \\nut";
  for (int i = 0; i < 20000; ++i) {
    std::string text = kText;
    for (std::uint32_t n = 1 + random.below(3); n > 0; --n) {
      const std::size_t at = random.below(static_cast<std::uint32_t>(text.size()));
      const char c = alphabet[random.below(static_cast<std::uint32_t>(alphabet.size()))];
      switch (random.below(3)) {
        case 0: text[at] = c; break;
        case 1: text.insert(at, 1, c); break;
        default: text.erase(at, 1); break;
      }
    }
    try {
      EXPECT_EQ(find_fault(small(), decode(small(), text)), "");
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 10000);
}

TEST(Decode, DeepNestingIsNoDanger) {
  const std::string deep = replaced(kText, "\"detail_seed\"", "\"provenance\": {\"x\": " + std::string(200000, '[') +
                                                                  std::string(200000, ']') + "}, \"detail_seed\"");
  EXPECT_EQ(decode(small(), deep), kSmall);
}

}  // namespace
}  // namespace espalier
