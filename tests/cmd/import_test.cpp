// espalier import from outside: files and exit codes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cmd/program_test.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::ChildResult;
using testing::read_text;
using testing::write_text;

class Import : public testing::ProgramTest {};

TEST_F(Import, WritesAGrammarThatChecksAndIsFormatted) {
  write_text(folder_ / "my plant.lsys", "axiom: X\nX -> F[+X]FX\nF -> FF\n");
  const ChildResult result = espalier({"import", "my plant.lsys", "-o", "plant.esp", "--iterations", "3"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "plant.esp: 2 rules, 0 details\n");
  EXPECT_THAT(read_text(folder_ / "plant.esp"), StartsWith("grammar my_plant 1\n# Imported from my plant.lsys"));
  EXPECT_THAT(read_text(folder_ / "plant.esp"), HasSubstr("const iterations = 3\n"));
  EXPECT_EQ(espalier({"check", "plant.esp"}).exit_code, 0);
  EXPECT_EQ(espalier({"fmt", "--check", "plant.esp"}).exit_code, 0);
  EXPECT_EQ(espalier({"import", "my plant.lsys", "--iterations", "3"}).out, read_text(folder_ / "plant.esp"));
}

TEST_F(Import, SaysWhatIsRefusedAndWritesNothing) {
  write_text(folder_ / "a.lsys", "axiom: F\nA < F > B -> F\n");
  const ChildResult result = espalier({"import", "a.lsys", "-o", "a.esp"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("a.lsys:2:3: error[L0201]: context-sensitive productions"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.esp"));
  EXPECT_EQ(espalier({"import", "missing.lsys"}).exit_code, 2);
  EXPECT_EQ(espalier({"import", "a.lsys", "--iterations", "41"}).exit_code, 2);
}

TEST_F(Import, DoesNotWriteWhatIsTooLargeForAGrammar) {
  std::string source = "axiom: X\n";
  for (int i = 0; i < 300; ++i) source += "X -> F[+(" + std::to_string(i) + ")X] : 1\n";
  write_text(folder_ / "a.lsys", source);
  const ChildResult result = espalier({"import", "a.lsys", "-o", "a.esp"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("E0602"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.esp"));
}

}  // namespace
}  // namespace espalier
