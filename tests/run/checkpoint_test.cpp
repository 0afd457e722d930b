#include "run/checkpoint.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/hash.h"
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

constexpr std::size_t kHash = 32, kPrefix = std::string_view("espalier checkpoint\n").size() + 16 + kHash;

std::string word(std::size_t value) {
  std::string bytes;
  for (int i = 0; i < 8; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  return bytes;
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

TEST(Checkpoint, NumbersMustBeInTheirRanges) {
  const auto error_with = [](auto change) {
    Checkpoint c = some_checkpoint();
    change(c);
    return error_of(encode_checkpoint(c));
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_with([](Checkpoint& c) { c.threads = 100'000'000; }),
              HasSubstr("it is damaged: threads must be a whole number from 0 to 1024, got 100000000"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.threads = -5; }), HasSubstr("threads must be"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.refresh_seconds = -1; }), HasSubstr("refresh_seconds must be"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.refresh_seconds = 2e6; }), HasSubstr("from 0 to 1e+06, got 2000000"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.checkpoint_seconds = 0; }), HasSubstr("checkpoint_seconds must be"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.checkpoint_seconds = kNan; }), HasSubstr("checkpoint_seconds must be"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.checkpoint_seconds = 2e6; }), HasSubstr("checkpoint_seconds must be"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.seconds = -1; }), HasSubstr(" seconds must be"));
  EXPECT_THAT(error_with([](Checkpoint& c) { c.best = kNan; }), HasSubstr("best must be"));
  EXPECT_EQ(error_with([](Checkpoint& c) { c.threads = 1024, c.checkpoint_seconds = 1e6; }), "no error");
}

TEST(Checkpoint, NumbersThatOnlyFitWhenCutAreRefused) {
  const auto error_with = [](const std::string& is, const std::string& other) {
    const std::string bytes = encode_checkpoint(some_checkpoint());
    const std::size_t length = bytes.find("}", bytes.find("\"version\"")) + 1 - (kPrefix + 8);
    std::string head = bytes.substr(kPrefix + 8, length);
    EXPECT_NE(head.find(is), std::string::npos);
    head.replace(head.find(is), is.size(), other);
    const std::string body = word(head.size()) + head + bytes.substr(kPrefix + 8 + length);
    return error_of(bytes.substr(0, kPrefix - kHash - 8) + word(body.size()) + content_hash(body) + body);
  };
  EXPECT_EQ(error_with("\"threads\":2", "\"threads\":3"), "no error");
  EXPECT_THAT(error_with("\"threads\":2", "\"threads\":4294967298"),
              HasSubstr("threads must be a whole number from 0 to 1024, got 4294967298"));
  EXPECT_THAT(error_with("\"threads\":2", "\"threads\":1.9"), HasSubstr("got 1.9"));
  EXPECT_THAT(error_with("\"step\":12", "\"step\":-2"), HasSubstr("step must be a whole number"));
  EXPECT_THAT(error_with("\"step\":12", "\"step\":\"twelve\""), HasSubstr("got \"twelve\""));
}

TEST(Checkpoint, InputsLieBelowTheFolder) {
  for (const char* name : {"/etc/passwd", "../../etc/passwd", "inputs/../../x", "inputs/./x", "inputs//x", "inputs/",
                           "inputs", "", "run.toml", "inputs/.."}) {
    Checkpoint c = some_checkpoint();
    c.inputs[name] = "00";
    EXPECT_THAT(error_of(encode_checkpoint(c)), HasSubstr("inputs must be files below inputs/, got \"")) << name;
  }
  Checkpoint c = some_checkpoint();
  c.inputs["inputs/a/..b/c..d"] = "00";
  EXPECT_EQ(error_of(encode_checkpoint(c)), "no error");
}

TEST(Checkpoint, WhatItHoldsCannotSteerATerminal) {
  const testing::TemporaryFolder folder;
  Checkpoint c = some_checkpoint();
  c.inputs["\x1b[2J\n"] = "00";
  testing::write_text(folder / "checkpoint", encode_checkpoint(c));
  try {
    read_checkpoint(folder / "checkpoint");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("got \"\\x1b[2J\\x0a\""));
  }
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
