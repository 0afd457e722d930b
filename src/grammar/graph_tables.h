#pragma once
// GraphTables: what all programs of a graph share while it is compiled: meshes, materials, counted rules, numbers of
// rules and details. Equal entries are made once.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "grammar/checked.h"
#include "grammar/graph.h"
#include "grammar/value.h"

namespace espalier {

/// A number of a material or texture that is known only when the model is made.
struct OpenNumber {
  MaterialRecipe::Slot slot;
  Operand operand;
};

/// A texture as compiled: its numbers, some of them open.
struct TextureValue {
  TextureRef texture;
  std::vector<OpenNumber> open;
};

class GraphTables {
 public:
  static constexpr int kBlendSteps = 16;  // a blend of two materials is 17 materials in a row

  GraphTables(const CheckedGrammar& grammar_in, GeneratorGraph& graph_in, Diagnostics& diagnostics_in)
      : grammar(grammar_in), graph(graph_in), diagnostics(diagnostics_in) {
    graph.materials.push_back({.name = "default"});
  }

  /// A file that the text at `span` names, seen from the grammar's folder: paths are relative to the file that holds
  /// them.
  std::string path_from_grammar(const std::string& path, const SourceSpan& span) const;
  std::uint16_t mesh_index(const MeshRef& mesh);
  std::uint16_t material_index(const Material& material);
  /// Index into graph.recipes.
  std::uint16_t recipe_index(MaterialRecipe recipe);
  /// First of the blends from material a (step 0) to b (step kBlendSteps).
  std::uint16_t blend_index(std::uint16_t a, std::uint16_t b);
  std::uint16_t counted_index(const std::string& rule);

  /// The register of one float of a top-level draw or let of the start rule; the same in every variant.
  Register global_register(const void* statement, int part) {
    const auto [it, fresh] = global_registers_.try_emplace({statement, part}, next_global_);
    if (fresh) ++next_global_;
    return static_cast<Register>(kFirstDepthOfRegister + kMostCounted + it->second);
  }
  std::uint32_t global_count() const { return next_global_; }

  /// Registers kept free for depth(R) of this many rules.
  static constexpr std::uint32_t kMostCounted = 32;

  const CheckedGrammar& grammar;
  GeneratorGraph& graph;
  Diagnostics& diagnostics;
  std::map<std::string, std::uint16_t> rule_ids;
  std::map<std::string, std::uint16_t> detail_ids;
  std::map<std::string, std::size_t> edges_of_name;  // by "Rule/Child": how many so far
  std::vector<TextureValue> textures;  // of the expressions compiled so far
  NameScope globals;  // consts, attrs, meshes, materials, then the draws and lets of the start rule

 private:
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::uint16_t> blends_;
  std::map<std::pair<const void*, int>, std::uint32_t> global_registers_;
  std::uint32_t next_global_ = 0;
};

/// "box" and the other primitives; nothing for other names.
std::optional<MeshKind> primitive_named(const std::string& name);

}  // namespace espalier
