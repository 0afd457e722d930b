#include "base/diagnostic.h"

#include <gtest/gtest.h>

namespace espalier {
namespace {

TEST(Diagnostic, PointsAtThePlace) {
  const std::string source = "rule A {\n\tmove w 2\n}\n";
  Diagnostics diagnostics;
  diagnostics.error("E0001", {15, 1, 2, 7}, "no axis 'w'", "x, y or z");
  EXPECT_EQ(render(diagnostics, "a.esp", source),
            "a.esp:2:7: error[E0001]: no axis 'w'\n"
            "    2 | \tmove w 2\n"
            "      | \t     ^\n"
            "      = help: x, y or z\n"
            "a.esp: 1 error, 0 warnings\n");
}

TEST(Diagnostic, SurvivesPlacesBeyondTheText) {
  Diagnostic d{Severity::warning, "W1", "m", {1000, 50, 9, 400}, ""};
  EXPECT_NE(render(d, "f", "short").find("warning[W1]: m"), std::string::npos);
  EXPECT_NE(render(d, "f", "").find("warning[W1]: m"), std::string::npos);
}

TEST(Diagnostic, CutsLongLines) {
  const std::string source(10'000, 'x');
  const std::string text = render({Severity::error, "E1", "m", {5000, 3, 1, 5001}, ""}, "f", source);
  EXPECT_LT(text.size(), 600u);
  EXPECT_NE(text.find("^^^"), std::string::npos);
}

TEST(Diagnostics, CountsWhatItDoesNotKeep) {
  Diagnostics diagnostics;
  for (int i = 0; i < 70; ++i) diagnostics.error("E1", {}, "m");
  EXPECT_EQ(diagnostics.error_count(), 70u);
  EXPECT_EQ(diagnostics.items().size(), Diagnostics::kMostErrors);
  EXPECT_NE(render(diagnostics, "f", "").find("20 further errors"), std::string::npos);
}

}  // namespace
}  // namespace espalier
