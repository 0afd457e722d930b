#pragma once
// Probabilities, weights and guards: expressions of constants and depth -> DepthValue.

#include "grammar/graph_tables.h"

namespace espalier {

/// `scope` holds the constants and loop variables in sight.
DepthValue compile_depth_value(const ast::Expr& expr, const NameScope& scope, GraphTables& tables);

/// weights[chosen] / sum of weights.
DepthValue share_of(const std::vector<const ast::Expr*>& weights, std::size_t chosen, const NameScope& scope,
                    GraphTables& tables);

DepthValue product(const DepthValue& a, const DepthValue& b);

}  // namespace espalier
