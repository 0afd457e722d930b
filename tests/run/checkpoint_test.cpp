#include "run/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "run/fixtures.h"

namespace espalier {
namespace {

using ::testing::HasSubstr;

Checkpoint some_checkpoint() {
  Checkpoint c;
  c.version = "0.1.0", c.grammar = "pile", c.engine = "ga";
  c.seed = 1ull << 61, c.step = 12, c.evaluations = 3456, c.seconds = 0.1, c.best = -1.0 / 3;
  c.inputs = {{"inputs/a.esp", "00ff"}, {"inputs/targets/b \"c\".obj", "11"}};
  c.settings = "espalier = 1\n# \xc3\xa9\n";
  c.out = "out/ship", c.threads = 2, c.refresh_seconds = 5, c.checkpoint_seconds = 1e-3;
  c.population = "{}\n{}\n";
  c.state = std::string("\0\1\xff state", 9);
  return c;
}

std::string error_of(const std::string& bytes) {
  try {
    parse_checkpoint(bytes);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Checkpoint, ComesBackAsItWas) {
  const Checkpoint checkpoint = some_checkpoint();
  const std::string bytes = encode_checkpoint(checkpoint);
  EXPECT_TRUE(is_checkpoint(bytes));
  EXPECT_EQ(parse_checkpoint(bytes), checkpoint);
  EXPECT_EQ(encode_checkpoint(checkpoint), bytes);
}

TEST(Checkpoint, CutShortOrLongerIsRefused) {
  const std::string bytes = encode_checkpoint(some_checkpoint());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(error_of(bytes.substr(0, size)), "no error") << size;
  }
  EXPECT_THAT(error_of(bytes.substr(0, bytes.size() - 1)), HasSubstr("it is damaged: "));
  EXPECT_THAT(error_of(bytes + "x"), HasSubstr("it is damaged: "));
  EXPECT_THAT(error_of(""), HasSubstr("no checkpoint"));
}

TEST(Checkpoint, NoBitMayBeAnother) {
  const std::string bytes = encode_checkpoint(some_checkpoint());
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    std::string flipped = bytes;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ 1 << bit % 8);
    EXPECT_NE(error_of(flipped), "no error") << bit;
  }
}

TEST(Checkpoint, OfAnotherFormatIsToldSo) {
  std::string bytes = encode_checkpoint(some_checkpoint());
  bytes[bytes.find('\n') + 1] = 2;
  EXPECT_THAT(error_of(bytes), HasSubstr("version of the format must be 1, got 2"));
}

TEST(Checkpoint, FilesAreNamed) {
  const testing::TemporaryFolder folder;
  testing::write_text(folder / "checkpoint", "glTF");
  try {
    read_checkpoint(folder / "checkpoint");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/checkpoint: cannot be continued from: it is no checkpoint"));
  }
}

}  // namespace
}  // namespace espalier
