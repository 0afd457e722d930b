#include "grammar/graph.h"

#include "base/check.h"
#include "grammar/arithmetic.h"

namespace espalier {
namespace {

// Double precision for what probabilities are made of, so that 1/3 is a third; the rest as programs do it.
double apply(Arithmetic op, const double* in) {
  switch (op) {
    case Arithmetic::add: return in[0] + in[1];
    case Arithmetic::subtract: return in[0] - in[1];
    case Arithmetic::multiply: return in[0] * in[1];
    case Arithmetic::divide: return in[0] / in[1];
    case Arithmetic::select: return in[0] != 0 ? in[1] : in[2];
    default: break;
  }
  const float a = static_cast<float>(in[0]);
  if (operand_count(op) == 1) return apply_unary(op, a);
  const float b = static_cast<float>(in[1]);
  if (operand_count(op) == 2) return apply_binary(op, a, b);
  return apply_ternary(op, a, b, static_cast<float>(in[2]));
}

}  // namespace

double DepthValue::evaluate(const DepthCounts& counts) const {
  constexpr int kStack = 32;
  double stack[kStack];
  int top = 0;
  for (const Step& step : postfix_) {
    CHECK(top < kStack);
    switch (step.kind) {
      case Step::Kind::constant: stack[top++] = step.value; break;
      case Step::Kind::depth: stack[top++] = counts.depth; break;
      case Step::Kind::depth_of: stack[top++] = counts.of_rule[step.index]; break;
      case Step::Kind::apply: {
        top -= operand_count(step.op);
        CHECK(top >= 0);
        stack[top] = apply(step.op, stack + top);
        ++top;
      }
    }
  }
  CHECK(top == 1);
  return stack[0];
}

}  // namespace espalier
