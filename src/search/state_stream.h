#pragma once
// State streams: how engines save and load. Little-endian words of fixed width; every length is checked against a bound
// before memory is taken, so a damaged stream ends in an Error.

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

#include "derivation/derivation.h"

namespace espalier {

class StateWriter {
 public:
  explicit StateWriter(std::ostream& out) : out_(out) {}

  void u64(std::uint64_t value);
  void f64(double value);  // bit for bit
  void text(std::string_view value);
  void derivation(const Derivation& value);

 private:
  std::ostream& out_;
};

class StateReader {
 public:
  explicit StateReader(std::istream& in) : in_(in) {}

  /// Each throws Error when the stream ends early or a length is beyond its bound.
  std::uint64_t u64();
  std::uint64_t u64_at_most(std::uint64_t most, std::string_view what);
  double f64();
  std::string text();
  Derivation derivation();

 private:
  std::istream& in_;
};

}  // namespace espalier
