// espalier import: an L-system as a grammar.
#include <algorithm>
#include <cctype>
#include <cstdio>

#include <fmt/format.h>

#include "base/counted.h"
#include "base/error.h"
#include "cmd/verbs.h"
#include "grammar/compiler.h"
#include "grammar/lsystem.h"
#include "grammar/lsystem_import.h"
#include "io/file.h"

namespace espalier {
namespace {

/// "dir/my plant.lsys" -> "my_plant".
std::string grammar_name(const std::string& file) {
  std::string name = file.substr(file.rfind('/') + 1);
  name = name.substr(0, name.find('.'));
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) name = "l_system_" + name;
  return name.substr(0, 60);
}

/// One line of printable characters, for a comment.
std::string base_name(const std::string& file) {
  std::string name = file.substr(file.rfind('/') + 1);
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return name;
}

}  // namespace

int import_verb(const ImportOptions& options) {
  const std::string source = read_file(options.file, lsystem::kLargestFile);
  Diagnostics diagnostics;
  const std::optional<std::string> text = import_lsystem(
      source, {grammar_name(options.file), base_name(options.file), options.iterations}, diagnostics);
  if (!text) {
    std::fputs(render(diagnostics, options.file, source).c_str(), stderr);
    return kBadInput;
  }
  const std::string out = options.out.empty() ? "-" : options.out;
  const CompileResult compiled = compile_grammar({out, *text, {}});
  if (!compiled.diagnostics.items().empty())
    std::fputs(render(compiled.diagnostics, "the grammar made of " + options.file, *text).c_str(), stderr);
  if (!compiled.graph)
    throw Error(fmt::format("{}: the grammar made of it goes beyond what a grammar can be", options.file));
  if (out == "-") {
    fmt::print("{}", *text);
  } else {
    write_file(out, *text);
    fmt::print("{}: {}, {}\n", out, counted(compiled.graph->rules.size(), "rule"),
               counted(compiled.graph->details.size(), "detail"));
  }
  return kDone;
}

}  // namespace espalier
