#pragma once
// Work that may crash, hang or eat all memory, done in a forked child: foreign parsers are not to be trusted with
// damaged files.

#include <cstdint>
#include <functional>
#include <string>

namespace espalier {

struct ChildLimits {
  std::uint64_t most_memory = 4ull << 30;  // bytes on top of what the process holds already
  unsigned most_seconds = 300;
};

/// The bytes that `work` returns. Throws the Error that `work` throws (its message), or one that says how the child
/// died.
std::string run_in_child(const std::function<std::string()>& work, const ChildLimits& limits);

}  // namespace espalier
