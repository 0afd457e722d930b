// espalier fmt: grammars in the layout of the house.
#include <cstdio>
#include <iostream>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "base/error.h"
#include "cmd/verbs.h"
#include "grammar/formatter.h"
#include "io/file.h"
#include "run/grammar_file.h"

namespace espalier {
namespace {

std::string read_input(const std::string& file) {
  if (file != "-") return read_file(file, kMostGrammarBytes);
  std::string text;
  for (std::string piece(1 << 16, '\0'); std::cin && text.size() <= kMostGrammarBytes;) {
    std::cin.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    text.append(piece, 0, static_cast<std::size_t>(std::cin.gcount()));
  }
  if (std::cin.bad()) throw Error("-: cannot read the standard input");
  return text;
}

/// One file: kDone, kDiffers where --check found it in another layout, kBadInput where it does not parse.
int format_one(const std::string& file, const FormatOptions& options) {
  const std::string text = read_input(file);
  const std::string shown = file == "-" ? "<stdin>" : file;
  Diagnostics diagnostics;
  const std::optional<std::string> formatted = format_grammar(text, diagnostics);
  if (!formatted) {
    const std::string report = render(diagnostics, shown, text);
    std::fputs(report.c_str(), stderr);
    return kBadInput;
  }
  if (options.check) {
    if (*formatted == text) return kDone;
    fmt::print("{}\n", shown);
    return kDiffers;
  }
  if (options.to_stdout || file == "-") {
    fmt::print("{}", *formatted);
  } else if (*formatted != text) {
    write_file(file, *formatted);
    fmt::print("{}: formatted\n", file);
  }
  return kDone;
}

}  // namespace

int format_verb(const FormatOptions& options) {
  if (options.check && options.to_stdout) throw Error("fmt: --check writes nothing, so it does not go with --stdout");
  int worst = kDone;
  for (const std::string& file : options.files) {
    try {
      worst = std::max(worst, format_one(file, options));
    } catch (const Error& error) {  // the other files are still worth formatting
      std::fputs(fmt::format("espalier: {}\n", error.what()).c_str(), stderr);
      worst = kBadInput;
    }
  }
  return worst;
}

}  // namespace espalier
