#pragma once
// Error: bad input that ends what was asked for (a file, a setting, a full disk). The message names the file, the
// place, the rule and the value; the command line prints it and exits with 2. Bugs use CHECK, expected failures return
// values.

#include <stdexcept>
#include <string>

namespace espalier {

class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace espalier
