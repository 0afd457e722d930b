#pragma once
// The base of tests that run the program in a folder of their own.

#include "cmd/child.h"
#include "run/fixtures.h"

namespace espalier::testing {

class ProgramTest : public ::testing::Test {
 protected:
  ChildResult espalier(const std::vector<std::string>& arguments, ChildOptions options = {}) {
    options.folder = folder_.path();
    return run_program(arguments, scratch_ / "child", options);
  }

  TemporaryFolder folder_, scratch_;
};

}  // namespace espalier::testing
