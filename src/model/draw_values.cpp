#include "model/draw_values.h"

#include "derivation/sweep.h"
#include "model/expand.h"

namespace espalier {
namespace {

bool is_draw(OpCode code) {
  return code == OpCode::draw_uniform || code == OpCode::draw_uniform1 || code == OpCode::draw_uniform3 ||
         code == OpCode::draw_normal ||
         code == OpCode::draw_loguniform || code == OpCode::draw_integer;
}

bool jumps(OpCode code) {
  return code == OpCode::jump || code == OpCode::jump_if_zero || code == OpCode::jump_unless_used ||
         code == OpCode::loop_test;
}

// The program with nothing to show but its draws: each is emitted as the number `top` of an instance, whose mesh says
// which one it is. So the interpreter itself tells the values, and pays nothing for it otherwise.
Program telling(const Program& program) {
  Program told = program;
  told.ops.clear();
  std::vector<std::uint32_t> moved;
  for (const Op& op : program.ops) {
    moved.push_back(static_cast<std::uint32_t>(told.ops.size()));
    Op kept = op;
    if (op.code == OpCode::emit) {
      kept = {};
      kept.code = OpCode::load;  // of nothing: jumps may end here
      kept.dst = kZeroRegister;
    }
    told.ops.push_back(kept);
    if (!is_draw(op.code)) continue;
    for (std::uint16_t k = 0; k < (op.code == OpCode::draw_uniform3 ? 3 : 1); ++k) {
      Op tell;
      tell.code = OpCode::emit;
      tell.flags = kEmitAsIs;
      tell.x = {0, static_cast<float>(op.a + k), kZeroRegister};
      tell.y = {1, 0, static_cast<Register>(op.dst + k)};
      told.ops.push_back(tell);
    }
  }
  for (Op& op : told.ops) {
    if (jumps(op.code)) op.b = moved[op.b];
  }
  return told;
}

// The constants that a draw of `pick` or `chance` is compared with; empty where one is not constant or there are none.
std::vector<float> thresholds(const Program& program, std::uint32_t draw) {
  std::vector<float> found;
  bool seen = false;
  Register reg = 0;
  for (const Op& op : program.ops) {
    if (op.code == OpCode::draw_uniform && op.a == draw) seen = true, reg = op.dst;
    if (!seen || op.code != OpCode::binary || op.arithmetic != Arithmetic::less || op.x.reg != reg) continue;
    if (op.x.coefficient != 1 || op.x.bias != 0 || op.y.coefficient != 0) return {};
    found.push_back(op.y.bias);
  }
  return found;
}

bool chooses(const Program& program, std::uint32_t draw) {
  for (const Op& op : program.ops) {
    if (op.code == OpCode::draw_uniform && op.a == draw) return true;
  }
  return false;
}

// Of a draw with a few values: which one it is.
std::optional<float> resolved(const Variant& variant, std::uint32_t draw, float value, std::uint32_t values) {
  if (!chooses(variant.program, draw)) return value;  // integer
  std::vector<float> limits = thresholds(variant.program, draw);
  if (limits.size() + 1 < values) return std::nullopt;
  limits.resize(values - 1);  // in mirrors the same comparisons stand again
  float index = 0;
  for (const float limit : limits) index += value < limit ? 0.0f : 1.0f;
  return index;
}

}  // namespace

std::vector<std::optional<float>> draw_values(const GeneratorGraph& graph, const Derivation& derivation) {
  GeneratorGraph telling_graph = graph;
  for (Rule& rule : telling_graph.rules) {
    for (Variant& variant : rule.variants) variant.program = telling(variant.program);
  }
  Model model;
  Expander(telling_graph).expand(derivation, ExpandTo::parts, model);

  std::vector<std::uint32_t> first_draw;
  GeneSweep sweep;
  sweep.begin(graph, derivation);
  while (sweep.next()) first_draw.push_back(sweep.position().draw);

  std::vector<std::optional<float>> values(derivation.draws.size());
  for (const Instance& told : model.instances) {
    const Variant& variant = variant_of(graph, derivation.genes[told.gene]);
    std::optional<float>& value = values[first_draw[told.gene] + told.mesh];
    if (value) continue;
    const DrawComponent& draw = rule_of(graph, derivation.genes[told.gene]).draws[variant.draws[told.mesh]];
    value = draw.shape == DrawShape::discrete ? resolved(variant, told.mesh, told.top, draw.values) : told.top;
  }
  return values;
}

}  // namespace espalier
