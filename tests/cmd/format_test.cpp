// espalier fmt from outside: files, standard input, exit codes.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cmd/program_test.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;
using testing::ChildResult;
using testing::read_text;
using testing::write_text;

constexpr const char* kRough = "grammar g 1 start A  # c\nrule A{emit box}";
constexpr const char* kSmooth = "grammar g 1\nstart A  # c\nrule A { emit box }\n";

class Format : public testing::ProgramTest {};

TEST_F(Format, ReplacesFilesThatChange) {
  write_text(folder_ / "a.esp", kRough);
  write_text(folder_ / "b.esp", kSmooth);
  const ChildResult result = espalier({"fmt", "a.esp", "b.esp"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "a.esp: formatted\n");
  EXPECT_EQ(read_text(folder_ / "a.esp"), kSmooth);
  EXPECT_EQ(read_text(folder_ / "b.esp"), kSmooth);
}

TEST_F(Format, ChecksWithoutWriting) {
  write_text(folder_ / "a.esp", kRough);
  write_text(folder_ / "b.esp", kSmooth);
  const ChildResult result = espalier({"fmt", "--check", "b.esp", "a.esp"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "a.esp\n");
  EXPECT_EQ(read_text(folder_ / "a.esp"), kRough);
  EXPECT_EQ(espalier({"fmt", "--check", "b.esp"}).exit_code, 0);
}

TEST_F(Format, WritesToStandardOutput) {
  write_text(folder_ / "a.esp", kRough);
  EXPECT_EQ(espalier({"fmt", "--stdout", "a.esp"}).out, kSmooth);
  EXPECT_EQ(read_text(folder_ / "a.esp"), kRough);
  EXPECT_EQ(espalier({"fmt", "--stdout", "--check", "a.esp"}).exit_code, 2);
}

TEST_F(Format, ReadsStandardInput) {
  write_text(folder_ / "a.esp", kRough);
  const std::string command = std::string(ESPALIER_PROGRAM) + " fmt - < " + (folder_ / "a.esp") + " > " +
                              (folder_ / "out.esp");
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(read_text(folder_ / "out.esp"), kSmooth);
}

TEST_F(Format, LeavesBadFilesAloneAndGoesOn) {
  write_text(folder_ / "bad.esp", "grammar g 1\nrule A { mov }\n");
  write_text(folder_ / "a.esp", kRough);
  const ChildResult result = espalier({"fmt", "missing.esp", "bad.esp", "a.esp"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("missing.esp: cannot read"));
  EXPECT_THAT(result.err, HasSubstr("bad.esp:2:10: error[E0112]"));
  EXPECT_EQ(read_text(folder_ / "bad.esp"), "grammar g 1\nrule A { mov }\n");
  EXPECT_EQ(read_text(folder_ / "a.esp"), kSmooth);
}

}  // namespace
}  // namespace espalier
