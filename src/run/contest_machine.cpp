#include "run/contest_machine.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "base/counted.h"

namespace espalier {

ContestMachine this_machine() {
  ContestMachine machine;
  std::ostringstream text;
  if (std::ifstream file("/proc/cpuinfo"); file) text << file.rdbuf();
  machine.cpu = cpu_of(text.str());
  // 0: not known.
  if (const unsigned cores = std::thread::hardware_concurrency(); cores > 0) machine.cores = static_cast<int>(cores);
  return machine;
}

std::optional<std::string> cpu_of(std::string_view cpuinfo) {
  constexpr std::string_view kKey = "model name";
  constexpr std::string_view kBlank = " \t\r";
  while (!cpuinfo.empty()) {
    const std::string_view line = cpuinfo.substr(0, cpuinfo.find('\n'));
    cpuinfo.remove_prefix(std::min(cpuinfo.size(), line.size() + 1));
    const std::size_t colon = line.find(':');
    if (!line.starts_with(kKey) || colon == std::string_view::npos) continue;
    if (line.substr(0, colon).find_last_not_of(kBlank) + 1 != kKey.size()) continue;
    const std::size_t begin = line.find_first_not_of(kBlank, colon + 1);
    if (begin == std::string_view::npos) continue;
    return std::string(line.substr(begin, line.find_last_not_of(kBlank) + 1 - begin));
  }
  return std::nullopt;
}

nlohmann::ordered_json json_of(const ContestMachine& machine) {
  nlohmann::ordered_json json = {{"cpu", nullptr}, {"cores", nullptr}};
  if (machine.cpu) json["cpu"] = *machine.cpu;
  if (machine.cores) json["cores"] = *machine.cores;
  return json;
}

std::string in_words(const ContestMachine& machine) {
  std::string text = machine.cpu.value_or("");
  if (!machine.cores) return text;
  return text + (text.empty() ? "" : ", ") + counted(static_cast<std::size_t>(*machine.cores), "core");
}

}  // namespace espalier
