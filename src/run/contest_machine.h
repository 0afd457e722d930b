#pragma once
// The machine that a contest ran on: its times mean little without it.

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace espalier {

struct ContestMachine {
  std::optional<std::string> cpu;  // what the maker calls it; nothing: the system does not say
  std::optional<int> cores;        // that this program may use
};

ContestMachine this_machine();
/// The first "model name" of the text of /proc/cpuinfo, if there is one.
std::optional<std::string> cpu_of(std::string_view cpuinfo);

/// {"cpu": "...", "cores": 8}; null for what is not known.
nlohmann::ordered_json json_of(const ContestMachine& machine);
/// "..., 8 cores". Empty: nothing is known.
std::string in_words(const ContestMachine& machine);

}  // namespace espalier
