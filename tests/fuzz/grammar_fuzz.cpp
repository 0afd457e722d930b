// Feeds the parser and the checker with any bytes. Whatever they are, there is a diagnostic or a checked grammar, all
// diagnostics lie in the text and can be shown, and a second run says the same. What parses can be formatted, once.

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "base/check.h"
#include "grammar/checker.h"
#include "grammar/formatter.h"
#include "grammar/parser.h"

namespace espalier {
namespace {

struct Outcome {
  bool accepted = false;
  std::string report;
};

Outcome run(std::string_view source) {
  Diagnostics diagnostics;
  ast::Grammar grammar = parse(source, diagnostics);
  std::map<std::string, std::string> overrides;  // the label of the first attr that has one serves as its value
  for (const ast::Decl& decl : grammar.decls)
    if (decl.kind == ast::DeclKind::attribute && !decl.label.empty() && overrides.empty())
      overrides[decl.name] = decl.label;
  const auto checked = check(std::move(grammar), overrides, diagnostics);
  for (const Diagnostic& d : diagnostics.items()) CHECK(std::size_t{d.span.offset} + d.span.length <= source.size());
  CHECK(checked.has_value() == !diagnostics.has_errors());
  return {checked.has_value(), render(diagnostics, "fuzz.esp", source)};
}

}  // namespace
}  // namespace espalier

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view source(reinterpret_cast<const char*>(data), size);
  const espalier::Outcome first = espalier::run(source);
  CHECK(first.report == espalier::run(source).report);
  espalier::Diagnostics none;
  if (const auto formatted = espalier::format_grammar(source, none))
    CHECK(espalier::format_grammar(*formatted, none) == formatted);
  return 0;
}
