#pragma once
// GeneratorGraph: everything that a grammar can grow, known before the search starts. Nodes are rules, edges are the
// `spawn` statements of the text; every rule holds its draws, its slots, and per variant the straight-line program that
// turns a gene into geometry. Immutable once made; shared by all threads. (ShapeGenetics 2017, section 3.)

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/vec.h"
#include "grammar/material.h"
#include "grammar/program.h"

namespace espalier {

using RuleId = std::uint16_t;
using EdgeId = std::uint16_t;

/// Where a gene stands: how many genes are above it, and how many of those are of each counted rule.
struct DepthCounts {
  std::uint32_t depth = 0;
  /// Indexed like GeneratorGraph::counted_rules.
  std::span<const std::uint32_t> of_rule;
};

/// A number known from constants and depth alone: a probability, a weight, a guard (nonzero = holds).
class DepthValue {
 public:
  struct Step {
    enum class Kind : std::uint8_t { constant, depth, depth_of, apply } kind;
    Arithmetic op;         // apply: takes its operands from the stack (unary, binary or ternary)
    std::uint16_t index;   // depth_of: index into counted_rules
    double value;          // constant
  };

  DepthValue(double value = 1) : constant_(value) {}  // NOLINT: a plain number is a depth value
  explicit DepthValue(std::vector<Step> postfix) : postfix_(std::move(postfix)) {}

  bool constant() const { return postfix_.empty(); }
  const std::vector<Step>& postfix() const { return postfix_; }
  double at(const DepthCounts& counts) const { return postfix_.empty() ? constant_ : evaluate(counts); }

 private:
  double evaluate(const DepthCounts& counts) const;

  double constant_ = 1;
  std::vector<Step> postfix_;
};

/// How a component of a draw moves locally: `continuous` reflects at 0 and 1, `circular` wraps, `discrete` has `values`
/// plateaus of equal width (language.md 16).
enum class DrawShape : std::uint8_t { continuous, circular, discrete };

/// One quantile of a gene.
struct DrawComponent {
  std::string name;  // "Branch.spin", "Body.k.x"
  DrawShape shape = DrawShape::continuous;
  std::uint32_t values = 0;  // discrete only
};

/// One unrolled `spawn`: a place where a child gene may stand.
struct Slot {
  std::string name;  // the child's rule, "[i]" added where a rule has several: "Branch[2]"
  EdgeId edge = 0;
};

/// A rule with every `choose` decided. `draws` and `slots` index the rule's lists, ascending, in text order.
struct Variant {
  std::string name;        // "1,2" = the alternatives chosen, 1-based; empty where the rule has no choose
  DepthValue probability;  // product of weight / total of its choices, at the gene's depth; > 0 for some depth
  std::vector<std::uint16_t> draws;
  std::vector<std::uint16_t> slots;
  Program program;
};

struct Rule {
  std::string name;
  SourceSpan span;
  DepthValue guard;                    // of the gene to be made; nonzero = may stand there
  bool guarded = false;
  std::optional<std::uint32_t> limit;  // at most this many genes of the rule per derivation
  std::vector<DrawComponent> draws;
  std::vector<Slot> slots;
  std::vector<Variant> variants;       // 1..256
  /// Index into counted_rules, if depth(this rule) is read anywhere.
  std::optional<std::uint16_t> counted;
};

/// One `spawn` of the text. Edge 0 is the way in: it leads to the start rule and has no parent.
struct Edge {
  RuleId parent = 0;
  RuleId child = 0;
  bool required = true;
  DepthValue probability;  // optional: 0 < p < 1 at the parent gene's depth; required: 1
  std::string name;        // "Trunk/Branch"
  SourceSpan span;
};

/// A mesh that the grammar names: a primitive, or a file (path as written, relative to the grammar's folder).
enum class MeshKind : std::uint8_t { box, cylinder, cone, sphere, wedge, pyramid, quad, leaf, file };
struct MeshRef {
  MeshKind kind = MeshKind::box;
  std::uint16_t sides = 32;  // cylinder, cone: facets around the axis
  bool as_is = false;        // file: keep file coordinates instead of fitting the bounding box to the unit box
  std::string path;          // file
  SourceSpan span;
};

/// An `attr` with the value that this graph was built with.
struct Attribute {
  std::string name;
  std::string label;  // "Group/Label" or empty
  double value = 0, low = 0, high = 0, step = 0;
  bool ranged = false, boolean = false;
};

struct GeneratorGraph {
  std::string name;          // of the grammar
  std::string source_hash;   // content_hash of grammar text (imports included) and attribute values
  std::vector<Rule> rules;
  std::vector<Edge> edges;   // edges[0].child is the start rule
  std::vector<MeshRef> meshes;
  std::vector<Material> materials;  // [0] is the default
  std::vector<MaterialRecipe> recipes;  // of materials that are made with the model
  std::vector<Attribute> attributes;
  std::vector<RuleId> counted_rules;  // rules whose depth(R) is read
  std::vector<Program> details;       // per detail rule
  std::vector<std::string> detail_names;
  /// Registers that every program sees at the same place: see program.h.
  RegisterLayout registers;
  bool uses_details = false;
  bool uses_proxies = false;
  bool uses_childless = false;

  RuleId start() const { return edges[0].child; }
  const Rule& rule_of(EdgeId edge) const { return rules[edges[edge].child]; }
};

}  // namespace espalier
