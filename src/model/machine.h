#pragma once
// Machine: the interpreter of programs. It runs one program in one context (a gene's copy, or a call of a detail) and
// hands instances, bones, children and calls to its sinks. Internal to expansion.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "grammar/face.h"
#include "model/material_maker.h"
#include "model/model.h"
#include "model/pending.h"

namespace espalier {

/// What expansion needs of a (rule, variant), side by side in one array.
struct VariantCode {
  const Program* program = nullptr;
  std::uint32_t slots = 0;
  std::uint32_t draws = 0;
  std::int32_t counted = -1;  // index of the rule among the counted ones
};

class Machine {
 public:
  explicit Machine(const GeneratorGraph& graph);

  /// The gene's code; of a valid derivation of the graph.
  const VariantCode& code_of(const GeneRecord& gene) const { return codes_[first_code_[gene.edge] + gene.variant]; }

  /// Takes over item i of a queue: what it holds is current until the next call, so it may be popped or overwritten.
  void take(const PendingQueue& queue, std::size_t i);
  /// Runs the current item as a gene of `derivation`.
  void run_gene(const Derivation& derivation);
  /// Runs the current item as a gene by itself: all its slots that are not absent queue a child, whose `at.gene` is the
  /// slot's index. `slots` holds one state per slot, filled or absent, and nothing else that is looked at.
  void run_apart(EdgeId edge, std::uint16_t variant, const std::uint32_t* draws, const Derivation& slots);
  /// The draws and lets of the start rule, that every program sees.
  std::span<float> globals() {
    return {registers_ + graph_.registers.global_base,
            static_cast<std::size_t>(graph_.registers.local_base - graph_.registers.global_base)};
  }
  /// Runs the current item as a call of a detail.
  void run_detail();

  PendingQueue children;  // last in, first out
  PendingQueue calls;     // first in, first out
  Model* model = nullptr;
  bool parts_wanted = false;
  bool details_wanted = false;
  bool materials_wanted = true;
  std::uint32_t parts_left = 0;  // emits and calls still allowed; at 0 the model is truncated
  std::uint32_t turns_left = 0;  // turns of loops, likewise
  std::uint32_t copies_left = 0;  // children still shown, likewise: mirrors within mirrors double at every level
  std::unique_ptr<MaterialMaker> materials;  // apart: it is large, and few grammars need it

 private:
  /// True when a child took the gene's place: it is current now, and wants to be run.
  template <bool kGene>
  bool run(const Program& program, const Derivation* derivation);
  /// A quantile's upper 24 bits as a float.
  template <bool kGene>
  float high_bits(const Op& op, std::uint32_t component) const;
  template <bool kGene>
  float quantile(const Op& op, std::uint32_t component) const {
    return high_bits<kGene>(op, component) * 0x1p-24f;
  }

  float value(const Operand& o) const { return o.coefficient * registers_[o.reg] + o.bias; }
  Vec3 vector_at(std::uint32_t reg) const {
    return {registers_[reg], registers_[reg + 1], registers_[reg + 2]};
  }
  Lanes lanes_at(std::uint32_t reg) const {
    return Lanes{registers_[reg], registers_[reg + 1], registers_[reg + 2], 0};
  }
  void set_scope(int axis, float size) { registers_[kScopeRegister + axis] = size; }
  /// A size is negative or not a number: nothing is emitted, nor does anything stand below (language.md 29).
  bool broken_scope() const { return !(registers_[0] >= 0 && registers_[1] >= 0 && registers_[2] >= 0); }
  float draw_normal(const Op& op, float u) const;
  void place_children(const Derivation& derivation);
  void turn_axis(int axis, float angle);
  void turn(const Op& op);
  void aim(const Op& op);
  void enter_face(Face face);
  [[gnu::always_inline]] inline void emit(const Op& op, Layer layer);
  void make_bone(const Op& op);
  void make_bone(const Lanes& from, const Lanes& to);
  [[gnu::cold]] void make_material(const Program& program, const Op& op);  // material_maker.cpp
  void run_slot(const Program& program, const Op& op, const Derivation& derivation);
  void enter_child(const SlotCode& code, const Op& op);
  void call(const Program& program, std::uint16_t call_site);
  bool spend_part() {
    if (parts_left == 0) {
      model->truncated = true;
      return false;
    }
    --parts_left;
    return true;
  }
  bool take_turn(float counter) {
    if (counter >= kMostTurns || turns_left == 0) model->truncated = true;
    if (model->truncated) return false;
    --turns_left;
    return true;
  }

  const GeneratorGraph& graph_;
  std::uint32_t counted_;     // number of counted rules
  std::uint32_t parameters_;  // floats of arguments
  std::vector<std::uint32_t> first_code_;  // per edge
  std::vector<VariantCode> codes_;
  std::vector<float> register_file_;
  float* registers_;
  std::vector<State> saved_;
  std::vector<float> arguments_;
  // Of the item that runs; the scope's size lives in registers 0..2 meanwhile.
  Pending current_;
  const std::uint32_t* draws_ = nullptr;
  const VariantCode* code_ = nullptr;
  std::vector<GenePosition> child_at_;  // per slot of the variant; meaningful where filled
};

}  // namespace espalier
