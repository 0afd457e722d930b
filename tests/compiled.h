#pragma once
// The graph of a grammar's text, which must be without errors.

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "grammar/compiler.h"

namespace espalier::test {

inline std::shared_ptr<const GeneratorGraph> compiled(const std::string& text) {
  const CompileResult result = compile_grammar({"test.esp", text, {}});
  EXPECT_TRUE(result.graph) << render(result.diagnostics, "test.esp", text);
  return result.graph;
}

}  // namespace espalier::test
