// Names in the expressions of an L-system are parameters or constants.

#include <algorithm>

#include <fmt/core.h>

#include "grammar/lsystem_cursor.h"

namespace espalier::lsystem {
namespace {

class NameCheck {
 public:
  NameCheck(const System& system, Diagnostics& diagnostics) : system_(system), diagnostics_(diagnostics) {}

  void run() {
    modules(system_.axiom, {});
    for (const Production& p : system_.productions) {
      if (p.guard) expr(*p.guard, p.params);
      if (p.probability) expr(*p.probability, p.params);
      modules(p.successor, p.params);
    }
  }

 private:
  void modules(const std::vector<Module>& list, const std::vector<std::string>& params) {
    for (const Module& m : list)
      for (const Expr& arg : m.args) expr(arg, params);
  }
  void expr(const Expr& e, const std::vector<std::string>& params) {
    for (const Expr& child : e.children) expr(child, params);
    if (e.op != Op::name || std::find(params.begin(), params.end(), e.name) != params.end()) return;
    for (const Constant& c : system_.constants)
      if (c.name == e.name) return;
    diagnostics_.error("L0107", e.span, fmt::format("there is no parameter or constant `{}`", e.name),
                       fmt::format("write `const {} = ...` above", e.name));
  }

  const System& system_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_names(const System& system, Diagnostics& diagnostics) { NameCheck(system, diagnostics).run(); }

}  // namespace espalier::lsystem
