// Names in the expressions of an L-system are parameters or constants; conditions and numbers do not mix.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/lsystem_cursor.h"

namespace espalier::lsystem {
namespace {

class NameCheck {
 public:
  NameCheck(const System& system, Diagnostics& diagnostics) : system_(system), diagnostics_(diagnostics) {}

  void run() {
    for (const Constant& c : system_.constants) number(c.value, "a constant");
    modules(system_.axiom, {});
    for (const Production& p : system_.productions) {
      if (p.guard) expr(*p.guard, p.params), condition(*p.guard);
      if (p.probability) expr(*p.probability, p.params), number(*p.probability, "a probability");
      modules(p.successor, p.params);
    }
  }

 private:
  void modules(const std::vector<Module>& list, const std::vector<std::string>& params) {
    for (const Module& m : list)
      for (const Expr& arg : m.args) expr(arg, params), number(arg, "an argument");
  }
  void expr(const Expr& e, const std::vector<std::string>& params) {
    for (const Expr& child : e.children) expr(child, params);
    if (e.op != Op::name || std::find(params.begin(), params.end(), e.name) != params.end()) return;
    for (const Constant& c : system_.constants)
      if (c.name == e.name) return;
    diagnostics_.error("L0107", e.span, fmt::format("there is no parameter or constant `{}`", e.name),
                       fmt::format("write `const {} = ...` above", e.name));
  }

  static bool is_condition(const Expr& e) { return e.op >= Op::logical_not && e.op <= Op::not_equal; }
  static bool joins_conditions(const Expr& e) { return e.op >= Op::logical_not && e.op <= Op::logical_and; }

  void number(const Expr& e, const char* what) {
    if (is_condition(e))
      diagnostics_.error("L0108", e.span, fmt::format("{} is a number, and this is a condition", what));
    else operands(e);
  }
  void condition(const Expr& e) {
    if (is_condition(e)) operands(e);
    else diagnostics_.error("L0108", e.span, "a guard is a condition, and this is a number", "write `.. > 0`");
  }
  void operands(const Expr& e) {
    for (const Expr& child : e.children) {
      if (joins_conditions(e)) condition(child);
      else number(child, "an operand");
    }
  }

  const System& system_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_names(const System& system, Diagnostics& diagnostics) { NameCheck(system, diagnostics).run(); }

}  // namespace espalier::lsystem
