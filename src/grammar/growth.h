#pragma once
// GrowthCheck: how many children the rules of a grammar are expected to have, and what follows: derivations that never
// end, and derivations that become too large. Private to the checker.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "grammar/check_context.h"
#include "grammar/depth_samples.h"

namespace espalier {

class GrowthCheck {
 public:
  explicit GrowthCheck(CheckContext& context) : context_(context), samples_(context) {}

  void run();

 private:
  using Rules = std::vector<std::size_t>;  // declarations

  // growth.cpp: cycles and their spectral radius
  void check_cycle(const Rules& component);
  bool has_cycle(const Rules& component) const;
  bool guard_ends(std::size_t rule, const Rules& component) const;
  double spectral_radius(const Rules& component, bool required_only) const;
  std::string name_cycle(const Rules& component, bool required_only) const;
  double mean_children(const SpawnTerm& term, const StaticScope& scope) const;
  StaticScope far_below(const Rules& component, double depth) const;

  // growth_components.cpp: strongly connected components of the rules that are not left out, each ascending
  std::vector<Rules> components(const std::vector<char>& left_out) const;

  // growth_end.cpp: required spawns
  void check_end();
  bool ends(const ast::Block& block) const;
  bool ends(const ast::Stmt& stmt) const;
  void report_endless(std::size_t rule, std::vector<char>& reported);

  // growth_size.cpp: expected size
  void check_size();

  CheckContext& context_;
  DepthSamples samples_;
  std::vector<char> ends_{};     // like ast.decls: can a gene of the rule be complete
  std::vector<char> bounded_{};  // like ast.decls: a guard that fails some day, or a limit
  std::vector<char> can_be_absent_{};
};

}  // namespace espalier
