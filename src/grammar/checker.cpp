#include "grammar/checker.h"

#include "grammar/check_context.h"

namespace espalier {

std::optional<CheckedGrammar> check(ast::Grammar grammar, const std::map<std::string, std::string>& attribute_overrides,
                                    Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) return std::nullopt;  // half a tree would only raise false alarms
  CheckedGrammar checked;
  checked.ast = std::move(grammar);
  CheckContext context{checked, diagnostics, attribute_overrides};

  collect_declarations(context);
  check_value_names(context);
  const bool ordered = order_values(context);
  check_body_names(context);
  if (ordered) check_kinds(context);
  check_structure(context);
  check_detail_recursion(context);
  if (diagnostics.has_errors()) return std::nullopt;
  evaluate_values(context);
  if (diagnostics.has_errors()) return std::nullopt;
  check_unrolled(context);
  if (diagnostics.has_errors()) return std::nullopt;
  check_unreachable(context);
  check_growth(context);
  if (diagnostics.has_errors()) return std::nullopt;
  return checked;
}

}  // namespace espalier
