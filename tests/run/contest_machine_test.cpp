#include "run/contest_machine.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace espalier {
namespace {

TEST(ContestMachine, TheProcessorIsThatOfTheFirstLine) {
  EXPECT_EQ(cpu_of("processor\t: 0\nmodel\t\t: 85\nmodel name\t: Some CPU @ 2.00GHz \nmodel name\t: Other\n"),
            "Some CPU @ 2.00GHz");
  EXPECT_EQ(cpu_of("model name: Last line"), "Last line");
  EXPECT_EQ(cpu_of("model name\t:\nmodel name\t: Second"), "Second");
  EXPECT_EQ(cpu_of("processor\t: 0\nmodel names\t: X\nBogoMIPS\t: 48\n"), std::nullopt);
  EXPECT_EQ(cpu_of("model name without its colon\n"), std::nullopt);
  EXPECT_EQ(cpu_of(""), std::nullopt);
}

TEST(ContestMachine, WhatIsNotKnownIsNull) {
  EXPECT_EQ(json_of(ContestMachine{}).dump(), R"({"cpu":null,"cores":null})");
  EXPECT_EQ(json_of(ContestMachine{"X", 2}).dump(), R"({"cpu":"X","cores":2})");
  EXPECT_EQ(in_words(ContestMachine{"X", 2}), "X, 2 cores");
  EXPECT_EQ(in_words(ContestMachine{{}, 1}), "1 core");
  EXPECT_EQ(in_words(ContestMachine{}), "");
}

}  // namespace
}  // namespace espalier
