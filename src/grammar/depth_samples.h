#pragma once
// DepthSamples: what probabilities, weights and guards come to at the depths where a rule may stand. Private to the
// checker.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "grammar/check_context.h"

namespace espalier {

class DepthSamples {
 public:
  explicit DepthSamples(const CheckContext& context);

  /// Whether the value depends on where the gene stands.
  bool reads_depth(const ast::Expr& expr) const;
  /// Calls `visit` with a scope for each depth at which a gene of the rule may stand (its guard holds there), from its
  /// least depth to kDeepest, until `visit` returns false. All depth(R) are taken to be `depth`, the most they can be.
  void each_depth(const ast::Decl& rule, const std::function<bool(int, const StaticScope&)>& visit) const;
  /// A scope with `depth` and each depth(R) = of(R).
  StaticScope at(double depth, const std::function<double(const std::string&)>& of) const;
  /// Rules R whose depth(R) is read somewhere.
  const std::vector<std::string>& counted() const { return counted_; }
  /// Genes above a gene of the rule, at least.
  int least_depth(std::size_t rule) const { return least_depth_[rule]; }

  static constexpr int kDeepest = 200;

 private:
  void find_counted(const ast::Block& block);
  void find_counted(const ast::Expr& expr);
  void find_least_depths();

  const CheckContext& context_;
  std::vector<std::string> counted_{};
  std::vector<int> least_depth_{};  // like ast.decls
};

}  // namespace espalier
