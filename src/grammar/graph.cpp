#include "grammar/graph.h"

#include "base/check.h"
#include "grammar/arithmetic.h"

namespace espalier {

double DepthValue::evaluate(const DepthCounts& counts) const {
  constexpr int kStack = 32;
  float stack[kStack];
  int top = 0;
  for (const Step& step : postfix_) {
    CHECK(top < kStack);
    switch (step.kind) {
      case Step::Kind::constant: stack[top++] = static_cast<float>(step.value); break;
      case Step::Kind::depth: stack[top++] = static_cast<float>(counts.depth); break;
      case Step::Kind::depth_of: stack[top++] = static_cast<float>(counts.of_rule[step.index]); break;
      case Step::Kind::apply: {
        top -= operand_count(step.op);
        CHECK(top >= 0);
        const float* in = stack + top;
        switch (operand_count(step.op)) {
          case 1: stack[top] = apply_unary(step.op, in[0]); break;
          case 2: stack[top] = apply_binary(step.op, in[0], in[1]); break;
          default: stack[top] = apply_ternary(step.op, in[0], in[1], in[2]); break;
        }
        ++top;
      }
    }
  }
  CHECK(top == 1);
  return stack[0];
}

}  // namespace espalier
